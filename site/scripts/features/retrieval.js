// The Retrieval section of the Features page: how well shapes of a class are found, by each choice of what is compared.

import { chunk } from "../base/chunks.js";
import { dataLink, element, focused } from "../base/dom.js";
import { table } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { capitalised, count, figure, grouped, isolated } from "../base/words.js";
import { kind } from "../database/kind.js";
import { Curves, lineMark } from "./curves.js";
import { Ratings } from "./ratings.js";

/** @import { Children } from "../base/dom.js" */
/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { Choice } from "./ratings.js" */

/**
 * The section, which follows the theme and what is chosen in the state; null where no class has two shapes.
 * @param {Chunk.Overview} overview
 * @param {FeaturesState} state
 * @param {{ chosen: (() => string[]) | null, choose: ((names: string[]) => void) | null }} [choice]
 */
export async function openRetrieval(overview, state, choice = { chosen: null, choose: null }) {
  if (!document.getElementById("retrieval")) return null;
  const section = new RetrievalSection(await chunk("retrieval"), overview, choice.chosen, choice.choose);
  state.listen((changed) => (changed.has("chosen") || changed.has("theme")) && section.render());
  return section;
}

class RetrievalSection {
  row = 0;
  /** @type {Choice[]} */
  choices = [];

  /**
   * @param {Chunk.Retrieval} data
   * @param {Chunk.Overview} overview
   * @param {(() => string[]) | null} chosen gives the names of the chosen features; null where the page has no choice
   * @param {((names: string[]) => void) | null} choose chooses others
   */
  constructor(data, overview, chosen, choose) {
    this.ratings = new Ratings(data);
    this.classes = overview.classes;
    this.kind = kind({ data: overview });
    this.chosen = chosen;
    this.choose = choose;
    /** @type {"shapes" | "classes"} */
    this.over = "shapes";
    this.node = document.getElementById("retrieval");
    this.rows = this.node.querySelector("tbody");
    this.byClass = document.getElementById("retrieval-classes");
    this.curves = new Curves(document.getElementById("retrieval-curves"), data.recall, (key) => this.#point(key));
    for (const input of this.node.querySelectorAll("input[name=over]")) {
      input.addEventListener("change", () => {
        this.over = input.value;
        this.render();
      });
    }
    this.rows.addEventListener("pointerover", (event) => this.#point(event.target.closest("tr")?.dataset.key ?? null));
    this.rows.addEventListener("pointerleave", () => this.#point(null));
    this.rows.addEventListener("focusin", (event) => this.#point(event.target.closest("tr")?.dataset.key ?? null));
    this.rows.addEventListener("focusout", () => this.#point(null));
    this.byClass.parentElement.addEventListener("toggle", () => this.#renderClasses());
    this.render();
  }

  render() {
    const { ratings, over } = this;
    const kept = this.rows.contains(focused()) ? focused().closest("tr")?.dataset.key : undefined;
    this.row = this.chosen === null ? ratings.everything : ratings.find(this.chosen());
    this.choices = ratings.choices(this.row);
    this.curves.show(
      this.choices.map((choice) => ({
        ...choice,
        color: this.#color(choice),
        precision: ratings.curve(choice.rating, over),
      })),
    );
    this.rows.replaceChildren(...this.choices.map((choice) => this.#row(choice)));
    // What was chosen has become another row.
    if (kept !== undefined)
      (this.rows.querySelector(`[data-key="${kept}"] button`) ?? this.rows.querySelector("button"))?.focus();
    this.#renderClasses();
  }

  /** The section in figures. */
  tables() {
    const { ratings, over, choices } = this;
    const { measures, recall, queries } = ratings.data;
    const titles = measures.map(({ title }) => title);
    const mean = `mean over ${over}`;
    return [
      table(
        `Retrieval, ${mean}`,
        ["Compared", ...titles],
        choices.map((choice) => [this.#words(choice), ...ratings.scores(choice.rating, over).map(figure)]),
      ),
      table(
        `Precision at each recall, ${mean}`,
        ["Compared", ...recall.map((level) => level.toFixed(2))],
        choices.map((choice) => [this.#words(choice), ...ratings.curve(choice.rating, over).map(figure)]),
      ),
      table(
        `Retrieval of each ${this.kind} by ${ratings.names(this.row).map(isolated).join(", ")}`,
        [capitalised(this.kind), "Shapes", ...titles],
        ratings
          .each(choices[0].rating)
          .map((scores, place) => [this.#className(place), grouped(queries[place]), ...scores.map(figure)]),
      ),
      element(
        "p",
        {},
        "Every subset: ",
        dataLink("data/retrieval.csv"),
        "; by class: ",
        dataLink("data/retrieval-classes.csv"),
        ".",
      ),
    ];
  }

  /** @param {Choice} choice */
  #color({ kind, feature, row }) {
    const { data } = this.ratings;
    const single = kind === "chosen" ? data.order.find((other) => this.ratings.alone(other) === row) : feature;
    return single === undefined ? null : data.marks[currentTheme()].features[data.hues[single]];
  }

  /** @param {Choice} choice */
  #row(choice) {
    const { ratings } = this;
    const values = ratings.scores(choice.rating, this.over);
    return element(
      "tr",
      { "data-key": choice.key },
      element(
        "th",
        { scope: "row", title: this.#words(choice) },
        element("span", { class: "rating-of" }, lineMark(choice.kind, this.#color(choice)), this.#name(choice)),
      ),
      values.map((value, place) =>
        element("td", { class: place === values.length - 1 ? "number rating-main" : "number" }, figure(value)),
      ),
    );
  }

  /**
   * What a row compares; a button where it can be chosen.
   * @param {Choice} choice
   */
  #name(choice) {
    const words = this.#parts(choice);
    const { choose } = this;
    const { row } = choice;
    if (row === undefined || choice.kind === "chosen" || choose === null)
      return element("span", { class: "rating-name" }, words);
    return element(
      "button",
      {
        type: "button",
        class: "rating-name step",
        title: "Choose this subset",
        onclick: () => choose(this.ratings.names(row)),
      },
      words,
    );
  }

  /**
   * @param {Choice} choice
   * @returns {Children}
   */
  #parts(choice) {
    const { kind, row } = choice;
    const { ratings } = this;
    if (row === undefined) return this.#others(choice);
    const names = ratings.names(row);
    const listed = names.flatMap((name, place) => [place > 0 && " ", element("bdi", {}, name)]);
    const notes = [
      kind === "chosen" && this.choose !== null && "chosen",
      row === ratings.everything && "all features",
      row === ratings.data.best && ratings.choosable && "best of all",
    ].filter(Boolean);
    if (notes.length === 0) return listed;
    const note = notes.join(", ");
    return [
      element("span", {}, note[0].toUpperCase() + note.slice(1)),
      row !== ratings.everything && element("span", { class: "rating-members" }, listed),
    ];
  }

  /**
   * What is no subset, in words.
   * @param {Choice} choice
   */
  #others({ kind }) {
    if (kind === "neighbourhood") return "All features, by neighbourhood";
    return kind === "chance" ? "random order" : count(this.ratings.data.bins?.length ?? 0, "chosen bin");
  }

  /** @param {Choice} choice */
  #words(choice) {
    const { ratings } = this;
    if (choice.row === undefined) return this.#others(choice);
    return ratings.names(choice.row).map(isolated).join(", ");
  }

  /** @param {number} place */
  #className(place) {
    return this.classes[this.ratings.data.classes[place]];
  }

  #renderClasses() {
    const details = this.byClass.parentElement;
    if (!details.open) return;
    const { ratings } = this;
    const { queries, measures } = ratings.data;
    const rows = ratings.each(this.choices[0].rating).map((scores, place) => ({ scores, place }));
    rows.sort((one, other) => other.scores.at(-1) - one.scores.at(-1));
    const head = element(
      "tr",
      {},
      [capitalised(this.kind), "Shapes", ...measures.map(({ title }) => title)].map((title, place) =>
        element("th", { scope: "col", class: place > 0 && "number" }, title),
      ),
    );
    const body = rows.map(({ scores, place }) =>
      element(
        "tr",
        {},
        element("th", { scope: "row", dir: "auto" }, this.#className(place)),
        element("td", { class: "number" }, grouped(queries[place])),
        scores.map((value) => element("td", { class: "number" }, figure(value))),
      ),
    );
    this.byClass.replaceChildren(element("table", {}, element("thead", {}, head), element("tbody", {}, body)));
  }

  /** @param {string | null} key */
  #point(key) {
    this.curves.point(key);
    for (const row of this.rows.children) row.classList.toggle("pointed", row.dataset.key === key);
  }
}
