// Shapes that fit their class least: where they would rather belong, and what sets them apart.

import { compareAddress } from "../addresses/compare.js";
import { element, picture, swatch } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { pageAddress } from "../base/place.js";
import { toldAs } from "../base/snapshot.js";
import { count, figure, grouped, isolated } from "../base/words.js";
import { inWords } from "../bins-kit/bin-name.js";
import { highestOf, ofAtMost } from "../database/hit-range.js";
import { kind } from "../database/kind.js";
import { RowValues } from "../database/group-values.js";
import { LevelBins } from "../database/level-bins.js";
import { CountedValues } from "../database/level-counts.js";
import { sampled } from "../database/sample.js";
import { distribution } from "./distribution.js";
import { groupName } from "./groups.js";
import { wholeValues } from "./whole-values.js";

/** @import { CompareState } from "../addresses/compare.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { GroupValues } from "../database/group-values.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Neighbours } from "./neighbours.js" */

/**
 * What is usual in a class, and by column the mean and the spread of its compared values.
 * @typedef {{ values: RowValues | CountedValues, means: Float64Array, spreads: Float64Array }} Usual
 */

const PAGE = 12;
const NEAREST = 5;
const REASONS = 2;

/** Of a large class, so many shapes tell what is usual. */
const MOST_USUAL = 400;

/** A share of the surface has to differ by so much from what is usual to be worth telling. */
const TELLING = 0.03;

/** A bin in which a class has less spread than this part of that of all shapes is taken to have so much. */
const LEAST_SPREAD = 0.2;

export class Outliers {
  /** @type {Map<number, Promise<Usual>>} */
  #usual = new Map();

  /**
   * @param {Database} database
   * @param {Chunk.Comparison} data
   * @param {Neighbours} neighbours
   * @param {CompareState} state
   * @param {{ bins: () => Promise<Bins>, announce: (text: string) => void }} ways
   */
  constructor(database, data, neighbours, state, { bins, announce }) {
    this.database = database;
    this.data = data;
    this.neighbours = neighbours;
    this.state = state;
    this.announce = announce;
    this.load = bins;
    this.list = document.getElementById("outlier-list");
    this.more = document.getElementById("more-outliers");
    this.filter = document.getElementById("outliers-of");
    this.shown = PAGE;
    if (this.list === null) return;
    const own = kind(database);
    toldAs(document.getElementById("outliers"), () => ({
      words: `The ${count(this.list.childElementCount, "shape")} that fit their ${own} least, of ${grouped(this.ranked().length)}. ${document.getElementById("fit-words").textContent}`,
    }));
    this.#offer();
    this.filter.addEventListener("change", () =>
      state.set({ of: this.filter.value === "" ? null : Number(this.filter.value) }),
    );
    this.more.addEventListener("click", () => {
      const first = this.shown;
      this.shown += PAGE;
      this.render();
      this.list.children[first]?.querySelector("a")?.focus();
    });
    state.listen((changed) => {
      if (changed.has("of")) this.shown = PAGE;
      if (["view", "of", "theme"].some((name) => changed.has(name))) this.render();
    });
  }

  /**
   * Shapes by rising fit, of one class or of all.
   * @param {number | null} of
   */
  ranked(of = this.state.get("of")) {
    const { database, data } = this;
    return [...database.ids.keys()]
      .filter((index) => data.fit[index] !== null && (of === null || database.groups[index] === of))
      .sort((a, b) => this.#fit(a) - this.#fit(b) || a - b);
  }

  /** @param {number} index of a shape that has a fit */
  #fit(index) {
    return /** @type {number} */ (this.data.fit[index]);
  }

  #offer() {
    const { database, data } = this;
    const below = database.classes.map(() => 0);
    for (const [index, fit] of data.fit.entries()) if (fit !== null && fit < 0) below[database.groups[index]] += 1;
    this.filter.replaceChildren(
      element("option", { value: "" }, "all shapes"),
      ...database.classes.map((name, group) =>
        element("option", { value: group }, below[group] > 0 ? `${name} (${below[group]} closer to another)` : name),
      ),
    );
  }

  async render() {
    const { database, data, state, list } = this;
    if (state.get("view") !== "outliers" || list === null) return;
    const of = state.get("of");
    this.filter.value = of === null ? "" : String(of);
    const ranked = this.ranked();
    const closer = ranked.filter((index) => this.#fit(index) < 0).length;
    document
      .getElementById("outlier-words")
      .replaceChildren(
        ...(ranked.length === 0
          ? [`Each shape here is the only one of its ${kind(this.database)}: there is no other that it could be like.`]
          : [
              element("b", {}, `${closer === 0 ? "No shape" : count(closer, "shape")} of ${grouped(ranked.length)}`),
              closer > 1
                ? ` are closer to another ${kind(this.database)} than to their own.`
                : ` is closer to another ${kind(this.database)} than to its own.`,
            ]),
      );
    const shown = ranked.slice(0, this.shown);
    this.more.hidden = ranked.length <= shown.length;
    list.replaceChildren(...shown.map((index) => this.#item(index)));
    this.announce(document.getElementById("outlier-words").textContent);
    const bins = await this.load();
    for (const item of list.children) {
      const node = item.querySelector(".reasons");
      const index = Number(item.dataset.index);
      if (node.childElementCount > 0) continue;
      const [own, rival] = await Promise.all(
        [database.groups[index], data.rival[index]].map((group) => this.#usualOf(group, bins)),
      );
      await bins.know([
        index,
        ...[own, rival].flatMap(({ values }) => (values instanceof RowValues ? values.rows : [])),
      ]);
      node.replaceChildren(...this.#reasons(index, bins, own, rival));
    }
  }

  /** @param {number} index */
  #item(index) {
    const { database, data, neighbours } = this;
    const [own, rival] = [database.groups[index], data.rival[index]];
    const near = [...neighbours.of(index)];
    const fit = this.#fit(index);
    return element(
      "li",
      { class: "outlier", "data-index": index },
      element(
        "a",
        {
          class: "face",
          href: pageAddress("shape.html", { id: database.ids.at(index) }),
          "aria-label": database.names.at(index),
        },
        picture(database, index, 128),
      ),
      element(
        "div",
        { class: "whereabouts" },
        element(
          "p",
          { class: "name" },
          element(
            "a",
            { href: pageAddress("shape.html", { id: database.ids.at(index) }) },
            element("bdi", {}, database.names.at(index)),
          ),
          " ",
          name(database, own),
        ),
        element(
          "p",
          {},
          fit < 0
            ? ["Closer to ", name(database, rival), ` than to its own ${kind(database)}.`]
            : [`Closest to its own ${kind(database)}, with `, name(database, rival), " next."],
        ),
        element(
          "p",
          { class: "quiet" },
          "Fit ",
          element("b", { class: "figure" }, signed(fit)),
          database.methods.map(
            (method) =>
              method.hit[index] !== null && [
                ", NH on ",
                method.title,
                " ",
                figure(method.hit[index]),
                ofAtMost(highestOf(database, method, index)),
              ],
          ),
        ),
        element("p", { class: "quiet" }, this.#census(near)),
        element(
          "div",
          { class: "near" },
          near.slice(0, NEAREST).map((other) =>
            element(
              "a",
              {
                href: pageAddress("shape.html", { id: database.ids.at(other) }),
                title: `${isolated(database.names.at(other))}, ${isolated(database.className(database.groups[other]))}`,
                "aria-label": `${database.names.at(other)}, ${database.className(database.groups[other])}`,
              },
              picture(database, other, 56),
              element("i", {}, swatch(database.symbol(database.groups[other]), database.color(database.groups[other]))),
            ),
          ),
        ),
        element(
          "p",
          { class: "ways" },
          element(
            "a",
            {
              class: "on-screen",
              href: compareAddress(
                database,
                { kind: "shapes", shapes: new Set([index]) },
                { kind: "class", group: own },
              ),
            },
            `Compare with its ${kind(database)}`,
          ),
          " ",
          element(
            "a",
            {
              class: "on-screen",
              href: compareAddress(database, { kind: "class", group: own }, { kind: "class", group: rival }),
            },
            `Compare the two ${database.data.standIn ? "clusters" : "classes"}`,
          ),
        ),
      ),
      element("div", { class: "reasons", "aria-live": "off" }),
    );
  }

  /** @param {number[]} near */
  #census(near) {
    const { database } = this;
    const parts = database
      .census(near)
      .slice(0, 3)
      .map(([group, number], place) => [
        place > 0 && ", ",
        group < 0 ? `${number} without label` : [`${number} of `, element("bdi", {}, groupName(database, group))],
      ]);
    return [`Its ${count(near.length, "nearest neighbour")}: `, parts];
  }

  /**
   * Bins in which a shape is unlike its class and like the other one.
   * @param {number} index
   * @param {Bins} bins
   * @param {Usual} own
   * @param {Usual} rival
   */
  #reasons(index, bins, own, rival) {
    const { values } = own;
    const size = values.count - 1;
    const counted = !(values instanceof RowValues) || values.rows.includes(index);
    /** @type {[number, number][]} */
    const scored = [];
    for (let column = 0; column < bins.count; column += 1) {
      const value = bins.value(column, index);
      // The class without the shape itself.
      const usual = counted ? (own.means[column] * (size + 1) - value) / size : own.means[column];
      const spread = Math.max(own.spreads[column], LEAST_SPREAD * Math.sqrt(bins.variance(column)), 1e-9);
      const [away, near] = [(value - usual) / spread, (value - rival.means[column]) / spread];
      if ((value - usual) * (rival.means[column] - usual) <= 0) continue;
      if (bins.isShare(column) && Math.abs(bins.share(column, index) - values.mean(column)) < TELLING) continue;
      const gain = Math.abs(away) - Math.abs(near);
      if (gain > 0) scored.push([gain, column]);
    }
    scored.sort((a, b) => b[0] - a[0] || a[1] - b[1]);
    const features = new Set();
    // What can be pictured goes first where it says nearly as much.
    const simple = scored.filter(([gain, column]) => bins.ease(column) > 1 && gain >= scored[0][0] / 3);
    const chosen = [...simple, ...scored]
      .filter(([, column]) => !features.has(bins.featureOf(column)) && features.add(bins.featureOf(column)))
      .slice(0, REASONS);
    if (chosen.length === 0)
      return [
        element(
          "p",
          { class: "quiet" },
          `No single bin sets it apart from its ${kind(this.database)}: it is unlike in many ways, a little in each.`,
        ),
      ];
    const fellows = !counted ? values : without(values, index);
    return chosen.map(([, column]) => this.#reason(index, column, bins, fellows, rival.values));
  }

  /**
   * @param {number} index
   * @param {number} column
   * @param {Bins} bins
   * @param {GroupValues} fellows the others of its class
   * @param {GroupValues} others those of the closest other class
   */
  #reason(index, column, bins, fellows, others) {
    const { database, data } = this;
    const [group, other] = [database.groups[index], data.rival[index]];
    const share = bins.isShare(column);
    /**
     * @param {number} of
     * @param {GroupValues} values
     */
    const row = (of, values) => ({
      mark: swatch(database.symbol(of), database.color(of)),
      name: database.className(of),
      color: database.color(of),
      points: values.points(column),
      each: values.each,
      mean: values.mean(column),
    });
    const own = bins.share(column, index);
    const rows = [{ ...row(group, fellows), at: own }, row(other, others)];
    const means = rows.map(({ mean }) => mean);
    const [itself, usual] = bins.tell(column, [own, means[0]]);
    const words = share
      ? [element("b", {}, itself), ` of its ${data.whole.replace("the ", "")} ${data.clauses[column]}`]
      : ["Its ", element("bdi", {}, bins.called[column] || bins.names[column]), " is ", element("b", {}, itself)];
    const hue = element("i", { class: "hued" });
    hue.style.background = bins.color(column);
    return element(
      "div",
      { class: "reason" },
      element(
        "p",
        {},
        words,
        `, against ${usual} on average in `,
        element("bdi", {}, groupName(database, group)),
        ` and ${bins.telling(column)(means[1])} in `,
        element("bdi", {}, groupName(database, other)),
        ".",
      ),
      distribution(rows, bins.inPercent(column)),
      element("p", { class: "quiet" }, hue, element("bdi", {}, bins.shortName(column, 18)), inWords(bins, column)),
    );
  }

  /**
   * Means and spreads of a class in every bin.
   * @param {number} group
   * @param {Bins} bins
   */
  #usualOf(group, bins) {
    return entry(this.#usual, group, async () => {
      const values = await this.#valuesOf(group, bins);
      const { means, variances } = values.moments();
      return { values, means, spreads: variances.map(Math.sqrt) };
    });
  }

  /**
   * @param {number} group
   * @param {Bins} bins
   */
  async #valuesOf(group, bins) {
    const { database } = this;
    const own = [...database.groups.keys()].filter((index) => database.groups[index] === group);
    const whole = bins instanceof LevelBins ? await wholeValues(bins, own, database) : null;
    return whole ?? new RowValues(bins, [...sampled(own, database.groups, MOST_USUAL)]);
  }
}

/**
 * The values of a group without one of its shapes, which is at hand.
 * @param {RowValues | CountedValues} values
 * @param {number} index
 */
function without(values, index) {
  return values instanceof CountedValues
    ? values.without(CountedValues.of(new RowValues(values.bins, [index]), values.bins))
    : new RowValues(
        values.bins,
        values.rows.filter((shape) => shape !== index),
      );
}

/**
 * @param {Database} database
 * @param {number} group
 */
function name(database, group) {
  return element(
    "span",
    { class: "called" },
    swatch(database.symbol(group), database.color(group)),
    element("bdi", {}, groupName(database, group)),
  );
}

/**
 * A fit, or a difference, with its sign.
 * @param {number | null} value
 */
export function signed(value) {
  if (value === null) return "–";
  return `${value < 0 ? "−" : ""}${Math.abs(value).toFixed(3)}`;
}
