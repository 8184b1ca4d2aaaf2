// The selected shapes as pictures, the same on every page: to look through, take to another page, export, or drop.

import { compareAddress } from "../addresses/compare.js";
import { galleryOf } from "../addresses/shapes.js";
import { element, focused, picture, swatch } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { count, grouped, shortened } from "../base/words.js";
import { writeSelection } from "../database/selection.js";
import { follow } from "./carry.js";
import { saveCsv, saveJson } from "./export.js";
import { Pair } from "./pair.js";

/** @import { GroupSpec } from "../addresses/compare.js" */
/** @import { Child } from "../base/dom.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Side } from "./pair.js" */

const PAGE = 200;
const MOST_CLASSES = 8;

export class Tray {
  /**
   * @param {Database} database
   * @param {State<Shared & { opened?: number | null }>} state
   * @param {object} options
   * @param {(index: number) => void} options.open is called with the shape whose picture is clicked
   * @param {(index: number | null) => void} [options.point] with the one under the pointer
   * @param {Child} [options.hint] said while nothing is selected; without one the tray is then not there
   * @param {() => void} [options.zoom] zooms the map of the page to the selected shapes
   * @param {(side: Side, group: GroupSpec) => void} [options.take] on the page that compares them, takes the shapes as
   *   one of its groups
   */
  constructor(database, state, { open, point = () => {}, hint = null, zoom, take }) {
    this.database = database;
    this.state = state;
    this.open = open;
    this.point = point;
    this.hint = hint;
    this.zoom = zoom;
    this.take = take;
    this.pair = new Pair(database);
    this.node = document.getElementById("tray");
    this.here = document.body.className;
    state.listen((changed) => {
      if (["selection", "brushing", "theme"].some((name) => changed.has(name))) this.#fillSoon();
      if (changed.has("opened")) this.#markOpened();
    });
    this.#fill();
  }

  /** @type {number | null} */
  #pending = null;

  // A brush changes the selection with every movement of the pointer; once a frame is enough.
  #fillSoon() {
    this.#pending ??= requestAnimationFrame(() => {
      this.#pending = null;
      this.#fill();
    });
  }

  #fill() {
    const selection = this.state.get("selection");
    // The tray unfolds when the brush is let go, not under it; nor does it fold, which would let a page scroll.
    const letGo = !this.state.get("brushing");
    if (!letGo && this.node.classList.contains("filled")) {
      this.node.firstElementChild.replaceWith(this.#head(selection, true));
      return;
    }
    const unfolded = selection.size > 0 && letGo;
    this.node.classList.toggle("filled", unfolded);
    this.node.hidden = selection.size === 0 && this.hint === null;
    if (selection.size === 0) this.node.replaceChildren(element("p", { class: "hint" }, this.hint ?? ""));
    else if (!unfolded) this.node.replaceChildren(this.#head(selection, letGo));
    else this.node.replaceChildren(this.#head(selection, true), this.#strip(this.#sorted(selection)));
    this.#markOpened();
  }

  /**
   * Class by class.
   * @param {Set<number>} selection
   */
  #sorted(selection) {
    const { groups } = this.database;
    return [...selection].sort((a, b) => groups[a] - groups[b] || a - b);
  }

  /**
   * @param {Set<number>} selection
   * @param {boolean} ways whether it is said what can be done with them
   */
  #head(selection, ways) {
    const { database } = this;
    const census = database.census(selection);
    /** @param {string} name */
    const save = (/** @type {string} */ name, /** @type {typeof saveCsv} */ to) =>
      plain(name, () => to(database, this.#sorted(selection)), `Save the selection as a ${name} file`);
    return element(
      "div",
      { class: "tray-head" },
      element("h2", {}, `${count(selection.size, "shape")} selected`),
      database.labelled &&
        element(
          "p",
          { class: "census" },
          census
            .slice(0, MOST_CLASSES)
            .map(([group, number]) =>
              element(
                "span",
                {},
                swatch(database.symbol(group), database.color(group)),
                element("bdi", {}, shortened(database.className(group), 20)),
                " ",
                element("b", {}, grouped(number)),
              ),
            ),
          census.length > MOST_CLASSES && element("span", {}, `and ${grouped(census.length - MOST_CLASSES)} more`),
        ),
      ways &&
        element(
          "div",
          { class: "tray-ways" },
          this.#links(selection).map(([words, address]) => element("a", { href: address }, words)),
          this.#taking("a", selection),
          this.#taking("b", selection),
          this.zoom && plain("Zoom to them", this.zoom, "Zoom the map to the selected shapes (Z)"),
          save("CSV", saveCsv),
          save("JSON", saveJson),
          plain("Clear", () => this.state.set({ selection: new Set() })),
        ),
    );
  }

  /**
   * Takes the selected shapes as one of two groups to compare, which stand beside each other when both are taken; a group
   * that is taken is let go.
   * @param {Side} side
   * @param {Set<number>} selection
   */
  #taking(side, selection) {
    const { pair, take } = this;
    const letter = side.toUpperCase();
    if (!take && pair.taken?.side === side)
      return plain(
        `${letter}: ${count(pair.taken.shapes.size, "shape")} ×`,
        () => this.#keep(null),
        `Let go of group ${letter}`,
      );
    const title = take
      ? `Compare them as group ${letter}`
      : pair.taken
        ? `Compare them with group ${pair.taken.side.toUpperCase()}`
        : `Keep them as group ${letter}, then select the other group and take it: the two are compared`;
    return plain(`Take as ${letter}`, () => this.#take(side, selection), title);
  }

  /**
   * @param {Side} side
   * @param {Set<number>} selection
   */
  #take(side, selection) {
    /** @param {Set<number>} shapes */
    const groupOf = (shapes) => ({ kind: /** @type {const} */ ("shapes"), shapes });
    const { taken } = this.pair;
    if (this.take) this.take(side, groupOf(selection));
    else if (taken === null) this.#keep({ side, shapes: selection });
    else {
      const [a, b] = side === "b" ? [taken.shapes, selection] : [selection, taken.shapes];
      this.pair.keep(null);
      follow(compareAddress(this.database, groupOf(a), groupOf(b)));
    }
  }

  /** @param {Pair["taken"]} taken */
  #keep(taken) {
    this.pair.keep(taken);
    this.#fill();
  }

  /**
   * Where else these shapes can be looked at.
   * @param {Set<number>} selection
   * @returns {string[][]} words, and the address
   */
  #links(selection) {
    const { database, here } = this;
    const query = new URLSearchParams();
    writeSelection(query, database, selection);
    const rest = selection.size < database.count;
    return [
      here !== "page-shapes" && ["Open in Shapes", galleryOf(database, selection)],
      here !== "page-overview" && ["Show on the map", pageAddress("index.html", query)],
      here !== "page-compare" &&
        rest && [
          "Compare with the rest",
          compareAddress(database, { kind: "shapes", shapes: selection }, { kind: "rest" }),
        ],
    ].filter(Boolean);
  }

  /** @param {number[]} chosen */
  #strip(chosen) {
    const strip = element("div", {
      class: "strip",
      role: "group",
      "aria-label": "Selected shapes; arrow keys go through them",
      onkeydown: (event) => this.#key(event),
    });
    const more = element("button", { type: "button", class: "plain more" });
    let shown = 0;
    const extend = () => {
      const next = chosen.slice(shown, shown + PAGE);
      more.before(...next.map((index) => this.#item(index)));
      shown += next.length;
      more.hidden = shown >= chosen.length;
      more.textContent = `${grouped(chosen.length - shown)} more`;
    };
    more.addEventListener("click", extend);
    strip.append(more);
    extend();
    /** @type {HTMLElement} */ (strip.firstElementChild).tabIndex = 0;
    return strip;
  }

  /** @param {number} index */
  #item(index) {
    const { database } = this;
    const name = database.labelled
      ? `${database.names.at(index)}, ${database.className(database.groups[index])}`
      : database.names.at(index);
    return element(
      "button",
      {
        type: "button",
        class: "shape",
        tabindex: "-1",
        "data-index": index,
        "aria-label": name,
        title: name,
        onclick: () => this.open(index),
        onpointerenter: () => this.point(index),
        onpointerleave: () => this.point(null),
      },
      picture(database, index, 72),
    );
  }

  /** @param {KeyboardEvent & Targeted} event */
  #key(event) {
    /** @type {Record<string, number>} */
    const steps = { ArrowRight: 1, ArrowLeft: -1, Home: -Infinity, End: Infinity };
    if (!(event.key in steps)) return;
    event.preventDefault();
    const items = [...event.currentTarget.querySelectorAll(".shape")];
    const here = items.indexOf(focused());
    const next = Math.min(Math.max(here + steps[event.key], 0), items.length - 1);
    for (const item of items) item.tabIndex = -1;
    items[next].tabIndex = 0;
    items[next].focus();
  }

  #markOpened() {
    const opened = String(this.state.get("opened"));
    for (const item of this.node.querySelectorAll(".shape"))
      item.classList.toggle("opened", item.dataset.index === opened);
  }
}

/**
 * @param {string} words
 * @param {() => void} onclick
 * @param {string | null} [title]
 */
function plain(words, onclick, title = null) {
  return element("button", { type: "button", class: "plain", title, onclick }, words);
}

/**
 * Escape drops the selection, unless it closes something first.
 * @param {State} state
 */
export function clearOnEscape(state) {
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented && !document.querySelector("dialog[open]"))
      state.set({ selection: new Set() });
  });
}
