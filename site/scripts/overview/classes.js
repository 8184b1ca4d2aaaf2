// The classes: a legend that filters; and how good the map is, for who asks: in words, and by a bar of NH for each.

import { drawChart } from "../base/chart.js";
import { element, focused, watchSize } from "../base/dom.js";
import { unstep } from "../base/place.js";
import { toldAs } from "../base/snapshot.js";
import { count, figure, grouped, wholePercent } from "../base/words.js";
import { classMark, makeupOf } from "../colors/legend.js";
import { isBelowOne, nothingTold, ofAtMost, rangeOf, shareOfRange } from "../database/hit-range.js";
import { holding } from "../database/search.js";
import { drawShepard, tellFaith } from "./faith.js";
import { tellSeparation } from "./separation.js";
import { kind, kinds, labels } from "../database/kind.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database, Method } from "../database/database.js" */

/** @param {Element} node */
const topOf = (node) => node.getBoundingClientRect().top;

export class ClassList {
  /**
   * @param {Database} database
   * @param {OverviewState} state
   */
  constructor(database, state) {
    this.database = database;
    this.state = state;
    this.list = document.getElementById("legend");
    this.node = document.getElementById("bars");
    this.all = document.getElementById("show-all");
    toldAs(this.list.closest("[data-figure]"), () => {
      const { title, neighbours, sample } = database.methods[state.get("method")];
      const kind = database.data.standIn ? "cluster" : "class";
      return {
        words: `Neighbourhood hit (NH_c) of each ${kind} on the ${title} map of ${count(sample?.length ?? database.count, "shape")}: of a shape’s ${count(neighbours, "nearest neighbour")}, the share that is of its ${kind}, on average.`,
      };
    });
    this.asked = document.getElementById("how-good");
    this.asked.open = this.#asksItself;
    this.asked.addEventListener("toggle", async () => {
      await this.start();
      // Below a long list the answer would be out of sight.
      const panel = this.asked.parentElement;
      if (this.asked.open && !this.#asksItself) panel.scrollTop += topOf(this.asked) - topOf(panel);
    });
    this.all.addEventListener("click", () => state.set({ hidden: new Set() }));
    this.finder = document.querySelector("#find-class");
    this.finder?.addEventListener("input", () => this.render());
    this.finder?.addEventListener("keydown", (event) => {
      if (event.key === "Enter" && this.buttons.size > 0) this.#showOnly([...this.buttons.keys()]);
    });
    this.list.addEventListener("pointerleave", () => state.set({ pointedGroup: null }));
    watchSize([this.node], () => this.#mark());
    state.listen((changed) => {
      if (changed.has("view") && this.#asksItself) this.asked.open = true;
      if (changed.has("method") || changed.has("coloring")) this.render();
      else if (changed.has("hidden")) this.#mark();
    });
  }

  /** @type {Map<number, HTMLButtonElement>} */
  buttons = new Map();

  /** Whether the maps in view are about how good they are. */
  get #asksItself() {
    return ["hit", "three"].includes(this.state.get("view"));
  }

  /** Draw the bars, where they are asked for, in the colours of the theme in use. */
  async start() {
    this.vega?.finalize();
    this.vega = null;
    const rated = this.asked.open && this.database.labelled;
    this.render();
    if (rated)
      this.vega = await drawChart(this.node, this.database.data.charts.bars, this.database.marks.config, "svg");
    this.list.parentElement.parentElement.toggleAttribute("data-rated", rated);
    this.#mark();
  }

  /** Groups by falling NH on the map in view; shapes without a label come last. */
  get order() {
    const { hitOfClass } = this.database.methods[this.state.get("method")];
    const groups = this.database.classes.map((_, group) => group);
    groups.sort((a, b) => (hitOfClass[b] ?? -1) - (hitOfClass[a] ?? -1) || a - b);
    return this.database.sizes.has(-1) && this.database.labelled ? [...groups, -1] : groups;
  }

  /** Those of them whose names have all the words that are looked for. */
  get listed() {
    const holds = holding(this.finder?.value ?? "");
    return this.order.filter((group) => holds(this.database.className(group)));
  }

  render() {
    const kept = focused()?.dataset.group;
    this.buttons = new Map(this.listed.map((group) => [group, this.#button(group)]));
    this.list.replaceChildren(...[...this.buttons.values()].map((button) => element("li", {}, button)));
    if (kept !== undefined) this.buttons.get(Number(kept))?.focus();
    document.getElementById("quality").replaceChildren(...this.#quality());
    drawShepard(this.database.methods[this.state.get("method")]);
    this.#mark();
  }

  /** @param {number} group */
  #button(group) {
    const { database } = this;
    const name = database.className(group);
    const coloring = this.state.get("coloring") ?? null;
    const method = database.methods[this.state.get("method")];
    const hit = group < 0 ? null : method.hitOfClass[group];
    const most = hit === null ? "" : ofAtMost(rangeOf(database, method).highestOfClass.get(group));
    /** @param {number | null} value */
    const point = (value) => () => this.state.set({ pointedGroup: value });
    return element(
      "button",
      {
        type: "button",
        "data-group": group,
        title: `${name}${most && `\nNH ${figure(hit)}${most}, as many as the ${kind(database)} has others`}\nClick hides or shows it. Double-click, or click with Alt, shows it alone.`,
        onclick: (event) => {
          if (event.detail === 2) unstep();
          if (event.altKey) this.#showOnly([group]);
          else this.#toggle(group);
        },
        ondblclick: () => {
          unstep();
          this.#showOnly([group]);
        },
        onpointerenter: point(group),
        onpointerleave: point(null),
      },
      classMark(database, coloring, group),
      element("span", { class: "name", dir: "auto" }, name),
      coloring && makeupOf(database, coloring, group),
      element("span", { class: "size" }, grouped(database.sizes.get(group) ?? 0)),
    );
  }

  /** @param {number} group */
  #toggle(group) {
    const hidden = new Set(this.state.get("hidden"));
    if (!hidden.delete(group)) hidden.add(group);
    this.state.set({ hidden, pointedGroup: null });
  }

  /**
   * Hide all others; where they are hidden already, show all.
   * @param {number[]} groups
   */
  #showOnly(groups) {
    const others = this.order.filter((other) => !groups.includes(other));
    const hidden = this.state.get("hidden");
    const alone = others.length === hidden.size && others.every((other) => hidden.has(other));
    this.state.set({ hidden: new Set(alone ? [] : others), pointedGroup: null });
  }

  /** What is hidden, on the buttons and on the bars. */
  #mark() {
    const hidden = this.state.get("hidden");
    for (const [group, button] of this.buttons) button.setAttribute("aria-pressed", String(!hidden.has(group)));
    this.all.hidden = hidden.size === 0;
    if (!this.vega || !this.asked.open) return;
    const method = this.database.methods[this.state.get("method")];
    const { hitOfClass, chance } = method;
    const { highestOfClass } = rangeOf(this.database, method);
    const rows = this.listed.map((group, row) => ({
      row,
      hit: group < 0 ? null : hitOfClass[group],
      highest: highestOfClass.get(group) ?? null,
      present: !hidden.has(group),
    }));
    const height = (this.list.firstElementChild?.getBoundingClientRect().height ?? 0) * rows.length;
    this.vega.width(this.node.clientWidth).height(height);
    this.vega.signal("chance", chance ?? -1).signal("ink", this.database.marks.ink);
    this.vega.data("classes", rows).runAsync();
  }

  /**
   * That the labels, or the clusters that stand in for them, chose a subset, and what the best one reaches by chance.
   * @param {string[]} features
   */
  #chosen(features) {
    const { best, bestByChance } = this.database.data.subsets ?? {};
    if (!best || best.join() !== features.join()) return "";
    return ` The ${labels(this.database)} chose them, the best of all subsets; with labels dealt at random the best typically reaches ${figure(bestByChance)}.`;
  }

  /**
   * What the best map would reach.
   * @param {Method} method
   */
  #best(method) {
    const { highest } = rangeOf(this.database, method);
    if (!isBelowOne(highest)) return `1 is a map whose ${kinds(this.database)} never mix.`;
    const share = shareOfRange(method.hitOfAll, method.chance, highest);
    const stands = share === null ? "" : ` This one is ${wholePercent(share)} of the way there from chance.`;
    return `Some ${kinds(this.database)} are too small to fill ${count(method.neighbours, "place")}: a map whose ${kinds(this.database)} never mix has ${figure(highest)}.${stands}`;
  }

  #quality() {
    const { database } = this;
    const method = database.methods[this.state.get("method")];
    const { title, features, base, hitOfAll, withoutCopies, chance, chanceSpread, neighbours } = method;
    if (database.count === 1) {
      return [element("p", {}, "One shape: there is nothing to compare it with yet.")];
    }
    if (!database.labelled) {
      return [
        element(
          "p",
          {},
          "This database has no labels, so there is no neighbourhood hit to tell how well classes keep together. ",
        ),
        element("p", {}, features.length > 0 && "The map needs none: it places shapes by their surfaces alone."),
        ...tellFaith(database, method, this.state),
      ];
    }
    const nothing = nothingTold(database, method);
    if (nothing !== null)
      return [
        element("p", {}, `${nothing} So the neighbourhood hit says nothing of this one.`),
        ...tellFaith(database, method, this.state),
      ];
    const headline = element(
      "p",
      { class: "headline" },
      element("span", { class: "symbol" }, "NH", element("sub", {}, "s")),
      element("output", { class: "value" }, figure(hitOfAll)),
      element(
        "span",
        { class: "beside" },
        element("b", {}, figure(chance)),
        chanceSpread !== null && ` ± ${figure(chanceSpread)}`,
        element("br"),
        "with labels dealt at random",
        isBelowOne(rangeOf(database, method).highest) && [
          element("br"),
          element("b", {}, figure(rangeOf(database, method).highest)),
          " at most",
        ],
      ),
    );
    return [
      element("h3", {}, `Do ${database.data.standIn ? "clusters" : "classes"} keep together?`),
      headline,
      element(
        "p",
        {},
        `Neighbourhood hit: of a shape’s ${count(neighbours, "nearest neighbour")} on this ${title} map, ${wholePercent(hitOfAll ?? 0)} share its ${database.data.standIn ? "cluster" : "class"} on average. `,
        database.data.standIn
          ? "The clusters come from the same features, so this says only how well the map shows them."
          : this.#best(method),
        withoutCopies &&
          ` It is ${figure(withoutCopies.hitOfAll)}${ofAtMost(withoutCopies.highest)} without ${count(withoutCopies.copies, "copy", "copies")} of other shapes.`,
        base !== this.state.get("method") && [
          ` This map is made from `,
          element("bdi", {}, features.join(", ")),
          " alone.",
          this.#chosen(features),
        ],
      ),
      ...tellSeparation(database, method),
      ...tellFaith(database, method, this.state),
    ];
  }
}
