// The shapes most similar to this one under any choice of features or bins, each with what makes the two alike.

import { compareAddress } from "../addresses/compare.js";
import { element, pause, swatch } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { toldAs } from "../base/snapshot.js";
import { count, figure, grouped, isolated, listed, shortened, wholePercent } from "../base/words.js";
import { LevelSimilarity } from "../database/level-similarity.js";
import { writeSelection } from "../database/selection.js";
import { Comparing, isNone } from "./comparing.js";
import { hue } from "./hue.js";
import { kind } from "../database/kind.js";

/** @import { Child } from "../base/dom.js" */
/** @import { Choice, Similar } from "../database/similarity.js" */

/**
 * What can be compared, to choose from, and whether it is.
 * @typedef {{ node: HTMLButtonElement, pressed: () => boolean }} Chip
 */

const FIRST = 12;
const MOST = 48;
const MOST_NAMED = 4;

/** Nearer than so many of all shapes, two are alike in a feature, even in the one in which they are so least. */
const ALIKE = 0.9;

export class SimilarShapes extends Comparing {
  /** @param {ConstructorParameters<typeof Comparing>[0]} known */
  constructor(known) {
    super(known);
    const { state } = known;
    this.section = document.getElementById("similar");
    this.chips = document.getElementById("compared");
    this.list = document.getElementById("similar-list");
    this.shown = FIRST;
    this.more = document.getElementById("similar-more");
    this.more.addEventListener("click", async () => {
      const first = this.shown;
      this.shown = Math.min(2 * this.shown, MOST);
      await this.render();
      this.list.children[first]?.querySelector("a").focus();
    });
    toldAs(this.section, () => ({
      title: `Shapes most similar to ${this.#called}`,
      words: `The ${count(this.found.length, "shape")} of ${grouped(known.database.count)} most similar to ${this.#called}, compared by ${this.#compared()}. The bars, one a feature, say how many of all shapes are farther away in it alone.`,
    }));
    state.listen((changed) => {
      if (changed.has("shape")) this.shown = FIRST;
      if (changed.has("theme")) this.buttons = null;
      if (["shape", "features", "bins", "neighbourhood", "theme"].some((name) => changed.has(name))) this.render();
    });
  }

  /** @type {Similar[]} */
  found = [];
  /** @type {number | null} the shape that they are like */
  #of = null;
  /** @type {symbol | null} */
  #asked = null;

  get #called() {
    return isolated(this.database.names.at(this.state.get("shape") ?? 0));
  }

  /** What is compared, in few words. */
  #compared() {
    const { bins, comparison } = this;
    const { columns, features } = comparison.choice;
    if (comparison.byNeighbourhood) return "all features and by who has the same neighbours";
    if (columns) return count(columns.length, "bin");
    if (comparison.everything) return `all ${count(bins.features.length, "feature")}`;
    return listed((features ?? []).map((feature) => bins.features[feature].title));
  }

  async render() {
    const { database, state } = this;
    const shape = state.get("shape");
    this.section.hidden = shape === null || database.count === 1;
    if (shape === null || this.section.hidden) return;
    const known = await database.details(shape);
    // Of a new one the reader sees first who it is.
    if (shape !== this.#of) await pause();
    if (state.get("shape") !== shape) return;
    this.#of = shape;
    const { choice, byNeighbourhood } = this.comparison;
    const asked = (this.#asked = Symbol("asked"));
    const found = await (known.related && byNeighbourhood
      ? this.similarity.tell(shape, known.related.slice(0, this.shown), choice)
      : this.similarity.rank(shape, choice, this.shown));
    if (asked !== this.#asked) return;
    this.found = found;
    this.#offer();
    document.getElementById("similar-words").replaceChildren(...this.#tell(shape, choice));
    this.list.replaceChildren(...this.found.map((found) => this.#card(shape, known, found)));
    this.more.hidden = this.shown >= MOST || this.found.length < this.shown;
    document.getElementById("similar-on-map").href = this.#together(shape, "index.html");
  }

  /** What can be compared, to choose from. A press must not lose the focus, so chips stay the same elements. */
  #offer() {
    if (this.buttons === null) {
      this.buttons = this.#chips();
      this.chips.replaceChildren(...this.buttons.map(({ node }) => node));
    }
    for (const { node, pressed } of this.buttons) node.setAttribute("aria-pressed", String(pressed()));
  }

  /** @type {Chip[] | null} */
  buttons = null;

  #chips() {
    const { comparison, bins } = this;
    return [
      this.#chip(
        [`All ${count(bins.features.length, "feature")}`],
        () => comparison.compareAll(),
        null,
        () => comparison.everything,
      ),
      ...(comparison.related
        ? [
            this.#chip(
              ["By neighbourhood"],
              () => comparison.compareByNeighbourhood(),
              "By all features, and by which shapes have the same neighbours",
              () => comparison.byNeighbourhood,
            ),
          ]
        : []),
      ...bins.features.map(({ title }, feature) =>
        this.#chip(
          [hue(bins.colorOf(feature)), element("bdi", {}, shortened(bins.features[feature].name, 24))],
          () => comparison.toggle(feature),
          title,
          () =>
            !comparison.everything &&
            !comparison.byNeighbourhood &&
            comparison.choice.features?.includes(feature) === true,
        ),
      ),
      ...comparison.sets.map(({ columns, words, title }) =>
        this.#chip(
          [words],
          () => comparison.compareBins(columns),
          title,
          () => same(comparison.choice.columns, columns),
        ),
      ),
    ];
  }

  /**
   * @param {Child[]} content
   * @param {() => void} onclick
   * @param {string | null | undefined} title
   * @param {() => boolean} pressed
   * @returns {Chip}
   */
  #chip(content, onclick, title, pressed) {
    return { node: element("button", { type: "button", class: "compared", title, onclick }, content), pressed };
  }

  /**
   * @param {number} shape
   * @param {Choice} choice
   */
  #tell(shape, choice) {
    const { database, bins, found } = this;
    const own = database.groups[shape];
    const words = [];
    if (choice.columns) {
      const names = choice.columns.slice(0, MOST_NAMED).map((column) => bins.names[column]);
      words.push(
        "Compared by ",
        element("bdi", {}, names.join(", ")),
        choice.columns.length > MOST_NAMED ? ` and ${count(choice.columns.length - MOST_NAMED, "more bin")}. ` : ". ",
      );
    }
    if (own >= 0 && database.separable) {
      const fellows = found.filter(({ row }) => database.groups[row] === own).length;
      words.push(element("b", {}, `${fellows} of these ${found.length}`), ` are of its ${kind(database)}. `);
    }
    if (this.comparison.byNeighbourhood)
      words.push(
        "First come shapes that are near and have the same neighbours. Such an order finds more of a kind, but no feature can be said to make it: distances and bars below are those of all features, and need not rise in step. ",
      );
    else if (this.similarity instanceof LevelSimilarity && !choice.columns)
      words.push(
        "Of so many shapes, similar ones are found by an approximation, which misses fewer than one in ten of the most similar. ",
      );
    return [
      ...words,
      `Two shapes of this database are typically ${figure(this.similarity.typical(choice))} apart. The bars, one a feature, say how many of all shapes are farther away in it alone.`,
    ];
  }

  /**
   * @param {number} shape
   * @param {Chunk.ShapeDetails} known
   * @param {Similar} similar
   */
  #card(shape, known, { row, distance, closer }) {
    const { database } = this;
    const [own, group] = [database.groups[shape], database.groups[row]];
    const differ = own >= 0 && group >= 0 && own !== group;
    const copy = this.copyInWords(known, row);
    return element(
      "li",
      { class: "similar" },
      this.links.pictured(row, 128, { stranger: own >= 0 && group !== own, tabindex: "-1", "aria-hidden": "true" }),
      element(
        "div",
        {},
        element("p", { class: "name", dir: "auto" }, this.links.link(row, {}, shortened(database.names.at(row), 60))),
        database.labelled &&
          element(
            "p",
            { class: "class-of" },
            swatch(database.symbol(group), database.color(group)),
            element("bdi", {}, shortened(database.className(group), 40)),
          ),
        copy && element("p", { class: "copy" }, copy),
        ...(isNone(distance)
          ? [copy === null && element("p", { class: "why" }, "Nothing that is compared tells the two apart.")]
          : this.#apart(row, distance, closer)),
        differ &&
          element(
            "p",
            {},
            element(
              "a",
              {
                class: "on-screen",
                href: compareAddress(database, { kind: "class", group: own }, { kind: "class", group }),
              },
              `Compare ${database.data.standIn ? "clusters" : "classes"}`,
            ),
          ),
      ),
    );
  }

  /**
   * How far another shape is from this one, in what, and where.
   * @param {number} row
   * @param {number} distance
   * @param {number[]} closer
   */
  #apart(row, distance, closer) {
    return [
      element("p", { class: "quiet" }, `distance ${figure(distance)}`),
      this.#bars(closer),
      element("p", { class: "why" }, this.#reasons(closer)),
      element(
        "button",
        { type: "button", class: "plain", onclick: () => this.state.set({ beside: row, within: "" }) },
        "See where they differ",
      ),
    ];
  }

  /** @param {number[]} closer */
  #bars(closer) {
    const { bins } = this;
    return element(
      "div",
      { class: "alike", "aria-hidden": "true" },
      closer.map((share, feature) => {
        const bar = element("i", {});
        bar.style.height = `${100 * share}%`;
        bar.style.background = bins.colorOf(feature);
        return element(
          "span",
          {
            title: `${isolated(bins.features[feature].aspect)} (${isolated(bins.features[feature].name)}): nearer than ${wholePercent(share)} of all shapes`,
          },
          bar,
        );
      }),
    );
  }

  /**
   * In what two are most alike, and in what they are not, in words.
   * @param {number[]} closer
   */
  #reasons(closer) {
    const { features } = this.bins;
    /** @param {number} feature */
    const name = (feature) => element("bdi", {}, shortened(features[feature].aspect, 24));
    const order = [...closer.keys()].sort((a, b) => closer[b] - closer[a] || a - b);
    const [first, second] = order;
    const last = order.at(-1) ?? first;
    /** @param {number} feature */
    const nearer = (feature) =>
      closer[feature] === 1 ? "nearer than all others" : `nearer than ${wholePercent(closer[feature])} of all shapes`;
    const words = ["Alike in ", name(first)];
    const two = order.length > 2;
    if (two) words.push(" and ", name(second));
    // Of both no more is said than holds of both.
    words.push(` (${nearer(two ? second : first)})`);
    if (order.length > 1 && closer[last] < ALIKE)
      words.push("; least in ", name(last), ` (${wholePercent(closer[last])})`);
    return [...words, "."];
  }

  /**
   * This shape and those found, selected on another page.
   * @param {number} shape
   * @param {string} file
   */
  #together(shape, file) {
    const query = new URLSearchParams();
    writeSelection(query, this.database, new Set([shape, ...this.found.map(({ row }) => row)]));
    return pageAddress(file, query);
  }
}

/**
 * @param {number[] | undefined} one
 * @param {number[]} other
 */
function same(one, other) {
  return one?.join() === [...other].sort((a, b) => a - b).join();
}
