// Each class from the rest (paper, Fig. 6): a small map of few bins, the class in its colour, all others grey.

import { element, swatch } from "../base/dom.js";
import { styleColor } from "../base/theme.js";
import { count, figure } from "../base/words.js";
import { pictured } from "../bins-kit/look.js";
import { isBelowOne, ofAtMost } from "../database/hit-range.js";
import { mapOf, Plot } from "../map/plot.js";
import { kind } from "../database/kind.js";

/** @import { BinsState } from "../addresses/bins.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { BinChips } from "./bin-chip.js" */

/** The share of what NH_c can be, in the space of the bins and on their map, at which a class counts as separated. */
const SEPARATED = 0.9;

/** Of the surface, a part by which two pictures differ for everybody to see it: more shows no more. */
const ENOUGH = 0.15;

/** On paper the marks of a map are shapes of a drawing up to so many; there may be dozens of maps. */
const MOST_SHAPES = 300;

export class ClassCards {
  /**
   * @param {Database} database
   * @param {Chunk.Selection} selection
   * @param {BinChips} chips
   * @param {BinsState} state
   * @param {{ open: (columns: number[]) => string }} ways the address of bins in the Workbench
   */
  constructor(database, selection, state, chips, { open }) {
    this.database = database;
    this.selection = selection;
    this.state = state;
    this.chips = chips;
    this.open = open;
    this.list = document.getElementById("class-cards");
    const inputs = document.querySelectorAll("#sizes input");
    for (const input of inputs) {
      input.checked = input.value === state.get("size");
      input.addEventListener("change", () => state.set({ size: input.value }));
    }
    state.listen((changed) => {
      // These many maps follow a selection when it is made, not while it is.
      if (["selection", "brushing"].some((name) => changed.has(name)) && !state.get("brushing"))
        for (const plot of this.plots) plot.draw();
      if (!changed.has("size") && !changed.has("theme")) return;
      for (const input of inputs) input.checked = input.value === state.get("size");
      this.render();
    });
  }

  /** @type {Plot[]} */
  plots = [];

  render() {
    this.plots = [];
    const cards = this.selection.minimal.map((separated) => ({
      group: separated.group,
      found: chooseSet(separated, this.state.get("size")),
      separated,
    }));
    this.list.replaceChildren(
      ...cards.map(({ group, found, separated }) =>
        element("li", { class: "class-card" }, this.#card(group, found, separated)),
      ),
    );
  }

  /**
   * @param {number} group
   * @param {Chunk.BinSet} found
   * @param {Chunk.SeparatedClass} separated
   */
  #card(group, found, { highest, byChance }) {
    const random = byChance[found.bins.length - 1];
    const { database, selection } = this;
    const name = database.className(group);
    const plot = new Plot(database, {
      label: `Map of ${count(found.bins.length, "bin")}: ${name} against the rest`,
      first: (index) => database.groups[index] !== group,
      most: MOST_SHAPES,
      selection: () => this.state.get("selection"),
      /** @param {number} index */
      mark: (index) => {
        const own = database.groups[index] === group;
        return {
          path: database.symbol(own ? group : -1),
          color: own ? database.color(group) : styleColor("quiet"),
          radius: own ? 3.2 : 1.7,
          alpha: own ? 0.95 : 0.45,
        };
      },
    });
    this.plots.push(plot);
    const { rowsOfClasses: rows, coordinateSteps } = selection;
    plot.show(mapOf(found, { rows, coordinateSteps }));
    return [
      element(
        "div",
        { class: "card-head" },
        element("h3", {}, swatch(database.symbol(group), database.color(group)), element("bdi", {}, name)),
        element(
          "p",
          {
            class: "nh",
            title: `Neighbourhood hit of the ${kind(database)} on this map; ${figure(found.nhSpace)} in the space of the bins${ofAtMost(highest) && `; ${figure(highest)} at most, as many as the ${kind(database)} has others`}`,
          },
          element("span", { class: "unseen" }, "NH "),
          element("b", {}, figure(found.nh)),
          isBelowOne(highest) && element("span", { class: "quiet" }, ` / ${figure(highest)}`),
        ),
      ),
      element(
        "a",
        { class: "open-map", href: this.open(found.bins), title: "Open these bins in the Workbench" },
        plot.node,
      ),
      random &&
        element(
          "p",
          {
            class: "quiet by-chance",
            title: `What the same search reaches with ${count(found.bins.length, "bin")} for as many shapes dealt at random; ${figure(random.nhSpace)} in the space of the bins`,
          },
          `random shapes ${figure(random.nh)}`,
        ),
      element(
        "div",
        { class: "bin-chips" },
        found.bins.map((column) => this.chips.chip(column, { group })),
      ),
    ];
  }
}

/**
 * The bin to look at first, and its class: one whose pictures show it, much of it on a shape beside little on another, which
 * counts as often as its words are easily pictured.
 * @param {Chunk.Selection} selection
 * @param {Database} database
 * @param {Bins} bins
 * @returns {{ bin: number, group: number | null }}
 */
export function firstBin(selection, database, bins) {
  const found = selection.minimal.flatMap((separated) => {
    const { group } = separated;
    return chooseSet(separated, "fewest").bins.map((bin) => {
      const shares = pictured(selection, database, bin, group).map(({ share }) => share);
      const apart = shares.length > 1 ? shares[0] - /** @type {number} */ (shares.at(-1)) : 0;
      return { bin, group, worth: Math.min(apart, ENOUGH) * bins.ease(bin), ease: bins.ease(bin) };
    });
  });
  if (found.length === 0) return { bin: 0, group: null };
  const [{ bin, group }] = found.sort((one, other) => other.worth - one.worth || other.ease - one.ease);
  return { bin, group };
}

/**
 * The set of a size, or the largest below it; or the smallest that separates, else the best.
 * @param {Chunk.SeparatedClass} separated
 * @param {string} size
 */
function chooseSet({ sets, highest }, size) {
  if (size !== "fewest") return sets[Math.min(Number(size), sets.length) - 1];
  /** @param {Chunk.BinSet} found */
  const worth = ({ nh, nhSpace }) => Math.min(nh, nhSpace);
  return (
    sets.find((found) => worth(found) >= SEPARATED * highest - 1e-9) ??
    sets.reduce((best, found) => (worth(found) > worth(best) ? found : best))
  );
}
