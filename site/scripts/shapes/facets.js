// The filters beside the gallery: trees, values with counts, ranges. Each counts the shapes that all others let pass.

import { element, focused, swatch } from "../base/dom.js";
import { count, grouped } from "../base/words.js";
import { groupOf, NONE, numberText, valueName } from "../database/fields.js";
import { holding } from "../database/search.js";
import { Tree } from "./tree.js";

/** @import { Filter } from "../addresses/shapes.js" */
/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Database } from "../database/database.js" */
/** @import { ChoiceField, Field, Fields, RangeField, TreeField } from "../database/fields.js" */
/** @import { Sieve } from "./sieve.js" */

/**
 * What filters work with.
 * @typedef {object} Parts
 * @property {Database} database
 * @property {Sieve} sieve
 * @property {GalleryState} state
 * @property {(key: string, filter: Filter | null) => void} change takes a field's filter into use
 */

/** Values shown of a long list until one asks for more. */
const FEW = 8;
/** Values from which on one is found by typing. */
const MANY = 20;
const MOST = 200;
/** Facets that stand open at first. */
const OPEN = 3;

export class Facets {
  /**
   * @param {Database} database
   * @param {Fields} fields
   * @param {Sieve} sieve
   * @param {GalleryState} state
   */
  constructor(database, fields, sieve, state) {
    this.state = state;
    /** @type {Parts} */
    const parts = { database, sieve, state, change: (key, filter) => this.#change(key, filter) };
    this.facets = fields.filters.map((field) => new Facet(field, parts));
    const shut = new Set();
    for (const [place, facet] of this.facets.entries()) {
      facet.node.open = place < OPEN || state.get("filters").has(facet.field.key);
      if (!facet.node.open) shut.add(facet);
    }
    document.getElementById("facets").replaceChildren(...this.facets.map(({ node }) => node));
    state.listen((changed) => {
      if (changed.has("theme")) this.show();
    });
  }

  /**
   * @param {string} key
   * @param {Filter | null} filter
   */
  #change(key, filter) {
    const filters = new Map(this.state.get("filters"));
    if (filter === null) filters.delete(key);
    else filters.set(key, filter);
    this.state.set({ filters });
  }

  show() {
    for (const facet of this.facets) facet.show();
  }
}

/**
 * What a field is filtered by.
 * @param {Field} field
 * @param {Parts} parts
 * @returns {{ node: HTMLElement, show: (filter: any) => void }}
 */
function contentOf(field, parts) {
  if (field.tree !== null) return new Tree(/** @type {TreeField} */ (field), parts);
  if (field.edges === null) return new Choice(/** @type {ChoiceField} */ (field), parts);
  return new Range(/** @type {RangeField} */ (field), parts);
}

/** What folds a filter away. */
class Facet {
  /**
   * @param {Field} field
   * @param {Parts} parts
   */
  constructor(field, parts) {
    this.field = field;
    this.state = parts.state;
    this.content = contentOf(field, parts);
    this.mark = element("span", { class: "in-use" });
    this.node = element(
      "details",
      { class: "facet" },
      element("summary", {}, element("bdi", {}, field.title), this.mark),
      this.content.node,
    );
    this.node.addEventListener("toggle", () => this.show());
  }

  show() {
    const filter = this.state.get("filters").get(this.field.key);
    this.mark.textContent = filter === undefined ? "" : filter instanceof Set ? String(filter.size) : "•";
    if (this.node.open) this.content.show(filter ?? null);
  }
}

/** Values to tick. */
class Choice {
  #all = false;
  /** @type {Set<number> | null} */
  filter = null;

  /**
   * @param {ChoiceField} field
   * @param {Parts} parts
   */
  constructor(field, { database, sieve, state, change }) {
    this.field = field;
    this.database = database;
    this.sieve = sieve;
    this.state = state;
    this.change = change;
    this.values = [...field.names.keys()];
    const totals = new Int32Array(field.names.length);
    for (const value of field.of) if (value >= 0) totals[value] += 1;
    // The values that say most come first, and stay where they are while one filters.
    if (field.numbers === null && this.values.length > FEW && !field.active)
      this.values.sort((a, b) => totals[b] - totals[a]);
    if (field.of.includes(NONE)) this.values.push(NONE);
    const title = field.title;
    this.find =
      this.values.length > MANY &&
      element("input", {
        type: "search",
        class: "find-value",
        placeholder: "Find",
        "aria-label": `Find a value of ${title}`,
        oninput: () => this.show(this.filter),
      });
    this.list = element("ul", { "aria-label": title, onchange: (event) => this.#toggle(Number(event.target.value)) });
    this.more = element("button", { type: "button", class: "plain more-values", onclick: () => this.#unfold() });
    this.node = element("div", { class: "facet-values" }, this.find, this.list, this.more);
  }

  #unfold() {
    this.#all = !this.#all;
    this.show(this.filter);
  }

  /** @param {number} value */
  #toggle(value) {
    const filter = new Set(this.filter);
    if (!filter.delete(value)) filter.add(value);
    this.change(this.field.key, filter.size > 0 ? filter : null);
  }

  /** @param {Set<number> | null} filter */
  show(filter) {
    const { field, sieve } = this;
    this.filter = filter;
    const counts = sieve.counts(field);
    const typed = this.find ? this.find.value.trim() : "";
    const holds = holding(typed);
    const found = typed === "" ? this.values : this.values.filter((value) => holds(valueName(field, value)));
    const usual = typed !== "" || field.active ? MOST : FEW;
    const few = this.#all ? Infinity : usual;
    const shown = found.filter((value, place) => place < few || filter?.has(value));
    const kept = this.list.contains(focused()) ? focused().value : null;
    this.list.replaceChildren(
      ...shown.map((value) => this.#item(value, counts.at(value) ?? 0, filter?.has(value) ?? false)),
    );
    if (kept !== null) this.list.querySelector(`input[value="${kept}"]`)?.focus();
    this.more.hidden = found.length <= usual;
    this.more.textContent = this.#all ? "Fewer" : `All ${grouped(found.length)}`;
  }

  /**
   * @param {number} value
   * @param {number} number
   * @param {boolean} checked
   */
  #item(value, number, checked) {
    const { field, database } = this;
    const group = groupOf(field, value);
    const box = element("input", { type: "checkbox", value });
    box.checked = checked;
    return element(
      "li",
      { class: number === 0 && !checked ? "none" : null },
      element(
        "label",
        {},
        box,
        group !== null && swatch(database.symbol(group), database.color(group)),
        element("bdi", { class: value === NONE ? "value quiet" : "value" }, valueName(field, value)),
        element("span", { class: "size" }, grouped(number)),
      ),
    );
  }
}

/** A range of numbers below a histogram of them. */
class Range {
  /**
   * @param {RangeField} field
   * @param {Pick<Parts, "sieve" | "change">} parts
   */
  constructor(field, { sieve, change }) {
    this.field = field;
    this.sieve = sieve;
    this.change = change;
    const intervals = field.edges.length - 1;
    const title = field.title;
    /** @param {string} side */
    const thumb = (side) =>
      element("input", {
        type: "range",
        class: side,
        min: 0,
        max: intervals,
        step: 1,
        "aria-label": `${title}, ${side === "low" ? "from" : "to"}`,
        oninput: () => this.#slide(side),
      });
    this.low = thumb("low");
    this.high = thumb("high");
    this.bars = element(
      "div",
      { class: "spread", "aria-hidden": "true" },
      field.edges.slice(1).map(() => element("i")),
    );
    this.words = element("p", { class: "between" });
    this.node = element(
      "div",
      { class: "range" },
      this.bars,
      element("div", { class: "thumbs" }, this.low, this.high),
      this.words,
    );
  }

  /** @param {string} side */
  #slide(side) {
    const { edges } = this.field;
    let [low, high] = [Number(this.low.value), Number(this.high.value)];
    // The thumbs do not pass each other, and leave an interval between them.
    if (side === "low") low = Math.min(low, high - 1);
    else high = Math.max(high, low + 1);
    this.change(this.field.key, low === 0 && high === edges.length - 1 ? null : { low: edges[low], high: edges[high] });
    this.#place(low, high);
  }

  /**
   * @param {number} low
   * @param {number} high
   */
  #place(low, high) {
    const { field } = this;
    this.low.value = String(low);
    this.high.value = String(high);
    this.low.setAttribute("aria-valuetext", numberText(field.edges[low], field));
    this.high.setAttribute("aria-valuetext", numberText(field.edges[high], field));
    for (const [place, bar] of /** @type {HTMLElement[]} */ ([...this.bars.children]).entries())
      bar.classList.toggle("within", place >= low && place < high);
  }

  /** @param {{ low: number, high: number } | null} filter */
  show(filter) {
    const { field } = this;
    const { edges, unit } = field;
    const counts = this.sieve.countsOfIntervals(field);
    const most = Math.max(...counts, 1);
    for (const [place, bar] of /** @type {HTMLElement[]} */ ([...this.bars.children]).entries()) {
      // The smallest group is seen too.
      bar.style.height = counts[place] === 0 ? "0" : `${Math.max((counts[place] / most) * 100, 4)}%`;
      bar.title = `${numberText(edges[place], field)} to ${numberText(edges[place + 1], field)}: ${count(counts[place], "shape")}`;
    }
    /** @param {number} number */
    const nearest = (number) =>
      edges.reduce((best, edge, place) => (Math.abs(edge - number) < Math.abs(edges[best] - number) ? place : best), 0);
    const [low, high] = filter === null ? [0, edges.length - 1] : [nearest(filter.low), nearest(filter.high)];
    this.#place(low, Math.max(high, low));
    const [from, to] = filter === null ? [edges[0], edges.at(-1)] : [filter.low, filter.high];
    this.words.textContent = `${numberText(from, field)} to ${numberText(to, field)}${unit === "" ? "" : ` ${unit}`}`;
  }
}
