// What is shown: how many shapes, and by which filters; each filter can be taken back where it stands.

import { element } from "../base/dom.js";
import { count, grouped, shortened } from "../base/words.js";
import { numberText, valueName } from "../database/fields.js";

/** @import { Filter } from "../addresses/shapes.js" */
/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Field, Fields } from "../database/fields.js" */
/** @import { Sieve } from "./sieve.js" */

const MOST_NAMES = 3;
const LONGEST = 40;

/**
 * The filters in use, in words; the search first, then the selection.
 * @param {Fields} fields
 * @param {GalleryState} state
 * @returns {{ key: string, title: string, text: string }[]}
 */
function activeFilters(fields, state) {
  const query = state.get("query");
  const search = query === "" ? [] : [{ key: "search", title: "Search", text: `“${shortened(query, LONGEST)}”` }];
  const only = state.get("only") ? [{ key: "only", title: "Only", text: "the selected shapes" }] : [];
  return [
    ...search,
    ...only,
    ...[...state.get("filters")].map(([key, filter]) =>
      describe(/** @type {Field} */ (fields.byKey.get(key)), key, filter),
    ),
  ];
}

/**
 * @param {Field} field
 * @param {string} key
 * @param {Filter} filter
 */
function describe(field, key, filter) {
  const title = field.title;
  if (!(filter instanceof Set))
    return { key, title, text: `${numberText(filter.low, field)} to ${numberText(filter.high, field)}` };
  const names = [...filter].map((value) => shortened(nameOf(field, value), LONGEST));
  const rest = names.length - MOST_NAMES;
  return { key, title, text: names.slice(0, MOST_NAMES).join(", ") + (rest > 0 ? ` and ${rest} more` : "") };
}

/**
 * The name of a node or a value that is filtered by.
 * @param {Field} field
 * @param {number} value
 */
export function nameOf(field, value) {
  return field.tree === null || value < 0 ? valueName(field, value) : field.tree.ways[value].join(" / ");
}

export class Chips {
  /**
   * @param {Fields} fields
   * @param {Sieve} sieve
   * @param {GalleryState} state
   */
  constructor(fields, sieve, state) {
    this.fields = fields;
    this.sieve = sieve;
    this.state = state;
    this.node = document.getElementById("chips");
    this.number = document.getElementById("shown");
    this.empty = document.getElementById("empty");
    document.getElementById("clear").addEventListener("click", () => this.clear());
  }

  clear() {
    this.state.set({ query: "", only: false, filters: new Map() });
  }

  /**
   * Take one filter back.
   * @param {string} key
   */
  remove(key) {
    if (key === "search" || key === "only") {
      this.state.set(key === "search" ? { query: "" } : { only: false });
      return;
    }
    const filters = new Map(this.state.get("filters"));
    filters.delete(key);
    this.state.set({ filters });
  }

  show() {
    const { sieve } = this;
    const total = sieve.database.count;
    const filters = activeFilters(this.fields, this.state);
    this.number.textContent =
      filters.length === 0 ? count(total, "shape") : `${grouped(sieve.size)} of ${count(total, "shape")}`;
    const focused = this.node.contains(document.activeElement);
    this.node.replaceChildren(...filters.map((filter) => this.#chip(filter)));
    document.getElementById("clear").hidden = filters.length < 2;
    if (focused) (this.node.querySelector("button") ?? document.getElementById("search")).focus();
    this.empty.hidden = sieve.size > 0;
    if (sieve.size === 0) this.empty.replaceChildren(...this.#nothing(filters));
  }

  /** @param {{ key: string, title: string, text: string }} parts */
  #chip({ key, title, text }) {
    return element(
      "li",
      {},
      element(
        "span",
        { class: "in-words" },
        key !== "search" && element("bdi", { class: "of-field" }, title),
        element("bdi", {}, text),
      ),
      element(
        "button",
        {
          type: "button",
          class: "plain",
          "aria-label": `Remove the filter ${title}: ${text}`,
          onclick: () => this.remove(key),
        },
        "×",
      ),
    );
  }

  /**
   * Nothing passed: which filter to take back, and what that would bring.
   * @param {{ key: string, title: string, text: string }[]} filters
   */
  #nothing(filters) {
    const found = filters
      .map((filter) => ({ ...filter, size: this.sieve.without(filter.key) }))
      .filter(({ size }) => size > 0);
    return [
      element("h2", {}, filters.length === 1 ? "No shape has this" : "No shape has all of this"),
      filters.length === 1 &&
        filters[0].key === "search" &&
        element("p", {}, "The search looks for all words, or parts of words, in names, labels and metadata."),
      element(
        "ul",
        {},
        found.map(({ key, title, text, size }) =>
          element(
            "li",
            {},
            element(
              "button",
              { type: "button", class: "plain", onclick: () => this.remove(key) },
              "Without ",
              element("bdi", {}, `${title}: ${text}`),
              ` there are ${grouped(size)}`,
            ),
          ),
        ),
      ),
      (found.length !== 1 || filters.length > 1) &&
        element("button", { type: "button", class: "plain", onclick: () => this.clear() }, "Show all shapes"),
    ].filter(Boolean);
  }
}
