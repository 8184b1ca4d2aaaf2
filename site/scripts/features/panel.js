// The chosen subset in figures, and chips that lead to each neighbouring subset.

import { element, focused } from "../base/dom.js";
import { difference } from "../base/figures.js";
import { capitalised, figure, isolated } from "../base/words.js";
import { labels } from "../database/kind.js";
import { MEASURES, measuresOf } from "../map/measures.js";

/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Subsets } from "../database/subsets.js" */
/** @import { MeasureName } from "../map/measures.js" */
/** @import { Marks } from "./ranking.js" */

export class Panel {
  /**
   * @param {Database} database
   * @param {Subsets} subsets
   * @param {FeaturesState} state
   * @param {Marks} marks
   * @param {((place: number) => string) | null} link the address of a subset's map
   */
  constructor(database, subsets, state, marks, link) {
    this.database = database;
    this.subsets = subsets;
    this.state = state;
    this.marks = marks;
    this.link = link;
    this.node = document.getElementById("panel");
    state.listen((changed) => {
      if (["chosen", "rank", "among", "theme"].some((name) => changed.has(name))) this.render();
    });
    this.render();
  }

  render() {
    const kept = focused()?.dataset.key;
    const { subsets } = this;
    const place = this.state.get("chosen");
    this.node.replaceChildren(
      ...[
        element("h2", {}, "The chosen subset"),
        subsets.labelled && this.#headline(place),
        element("p", { class: "quiet" }, this.#hint()),
        element(
          "div",
          { class: "chips", role: "group", "aria-label": "Features of the subset" },
          subsets.data.order
            .filter((feature) => subsets.isOf(feature, this.state.get("among")) || subsets.has(place, feature))
            .map((feature) => this.#chip(place, feature)),
        ),
        this.#moves(place),
        this.#truth(place),
        this.link &&
          element(
            "p",
            {},
            element("a", { id: "open-overview", href: this.link(place) }, "Open this map in the Overview"),
          ),
      ].filter(Boolean),
    );
    if (kept !== undefined) this.node.querySelector(`[data-key="${kept}"]`)?.focus();
  }

  /** The measure that subsets are ranked by. */
  get #measure() {
    return this.subsets.measures.find(({ name }) => name === this.state.get("rank"));
  }

  /**
   * All features of what is ranked: the place of their subset, and how they are called.
   * @returns {[number, string]}
   */
  #whole() {
    const among = this.state.get("among");
    return [this.subsets.whole(among), among === "all" ? "all features" : "all of the paper’s"];
  }

  #hint() {
    const measure = this.#measure;
    if (measure === undefined)
      return element("span", { class: "on-screen" }, "Switch a feature on or off to get to another subset.");
    return [
      element("span", { class: "on-screen" }, "Switch a feature on or off. "),
      "Beside each stands by how much ",
      measure.name === "nh" ? ["NH", element("sub", {}, "s")] : MEASURES[measure.name].title.toLowerCase(),
      " would change.",
    ];
  }

  /** @param {number} place */
  #headline(place) {
    const { subsets } = this;
    const { hit, chanceBest } = subsets.data;
    const among = this.state.get("among");
    const [best] = subsets.ranked(undefined, among);
    const [whole, words] = this.#whole();
    /**
     * @param {number} other
     * @param {string} words
     */
    const against = (other, words) => [
      element("b", {}, difference(hit[other] ?? 0, hit[place] ?? 0)),
      ` against ${words}`,
    ];
    return element(
      "p",
      { class: "headline" },
      element("span", { class: "symbol" }, "NH", element("sub", {}, "s")),
      element("output", { class: "value" }, figure(hit[place])),
      element(
        "span",
        { class: "beside" },
        place === best
          ? [
              `the best of ${among === "all" ? "all" : "these"}, chosen by the ${labels(this.database)}`,
              among === "all" &&
                chanceBest !== null && ["; ", element("b", {}, figure(chanceBest)), " with random ones"],
            ]
          : against(best, among === "all" ? "the best" : "the best of these"),
        element("br"),
        place === whole ? words : against(whole, words),
        !subsets.isAmong(place, among) && [element("br"), "not one of these: it has other features"],
      ),
    );
  }

  /**
   * @param {number} place
   * @param {number} feature
   */
  #chip(place, feature) {
    const { subsets } = this;
    const name = subsets.features[feature];
    const target = subsets.toggled(place, feature);
    const pressed = subsets.has(place, feature);
    const mark = element("i", { class: "hued" });
    mark.style.background = this.marks().features[subsets.data.hues[feature]];
    const values = this.#measure?.values ?? null;
    const change = target === undefined || values === null ? "" : difference(values[place] ?? 0, values[target] ?? 0);
    const reason =
      pressed && subsets.single(place) >= 0 ? "A map needs at least one feature" : "This subset was not evaluated";
    return element(
      "button",
      {
        type: "button",
        class: "chip",
        "data-key": `feature ${feature}`,
        "aria-pressed": String(pressed),
        disabled: target === undefined,
        title: target === undefined ? reason : `${pressed ? "Without" : "With"} ${isolated(name)}`,
        onclick: () => this.state.set({ chosen: target }),
      },
      mark,
      element("span", { class: "name", dir: "auto" }, name),
      element("span", { class: "change" }, change),
    );
  }

  /**
   * How truly its map shows who is alike by these features.
   * @param {number} place
   */
  #truth(place) {
    const faith = this.subsets.faith(place);
    if (faith === null) return "";
    const names = /** @type {MeasureName[]} */ (Object.keys(MEASURES));
    return element(
      "details",
      { class: "truth", open: this.#opened, ontoggle: (event) => (this.#opened = event.target.open) },
      element("summary", {}, "Does its map show who is alike by these features?"),
      measuresOf(faith, names),
    );
  }

  /** Whether the reader has asked how true maps are. */
  #opened = true;

  /** @param {number} place */
  #moves(place) {
    const measure = this.#measure;
    const order = this.subsets.ranked(measure, this.state.get("among"));
    /**
     * @param {string} key
     * @param {string} words
     * @param {number | undefined} target
     */
    const move = (key, words, target) =>
      element(
        "button",
        {
          type: "button",
          class: "plain",
          "data-key": key,
          disabled: target === place || target === undefined,
          onclick: () => this.state.set({ chosen: target }),
        },
        words,
      );
    const position = order.indexOf(place);
    const [whole, words] = this.#whole();
    return element(
      "div",
      { class: "moves" },
      measure && move("best", "Best", order[0]),
      move("all", capitalised(words), whole),
      // What is not among these has none before or after it.
      move("previous", measure ? "‹ Better" : "‹ Previous", order[position - 1]),
      move("next", measure ? "Worse ›" : "Next ›", position < 0 ? undefined : order[position + 1]),
    );
  }
}
