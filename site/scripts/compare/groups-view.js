// Two groups beside each other: the answer in sentences, then bins, features and shapes.

import { shortNames } from "../addresses/bin-names.js";
import { besideAddress } from "../addresses/shape.js";
import { galleryOf } from "../addresses/shapes.js";
import { element, pause, picture } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { count, grouped } from "../base/words.js";
import { writeSelection } from "../database/selection.js";
import { Inquiry } from "../engine/inquiry.js";
import { answer, kinship } from "./answer.js";
import { binCard } from "./bin-cards.js";
import { Chooser } from "./chooser.js";
import { Contrasts, varied } from "./contrasts.js";
import { hasDots } from "./distribution.js";
import { featureRows } from "./feature-rows.js";
import { Groups, isSame } from "./groups.js";
import { OnShapes } from "./on-shapes.js";
import { tellFigures } from "./told.js";
import { called } from "./words.js";

/** @import { CompareState } from "../addresses/compare.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Standing } from "../engine/inquiry.js" */
/** @import { Contrast } from "./contrasts.js" */
/** @import { Group } from "./groups.js" */
/** @import { Neighbours } from "./neighbours.js" */

/**
 * Two groups beside each other, as the page shows them.
 * @typedef {object} View
 * @property {Contrast} contrast
 * @property {Group} a
 * @property {Group} b
 * @property {Bins} bins
 * @property {Chunk.Comparison} data
 * @property {Pick<Group, "name" | "label" | "color"> & { side: "rest", mark: () => null, count: number }} rest all other shapes
 * @property {(column: number) => void} look
 * @property {number} best
 * @property {number} bin the one that is looked at
 */

const FIRST = 6;
const MORE = 12;
const SHARED = 4;
const FACES = 5;

export class GroupsView {
  /** @type {View | null} */
  view = null;
  shown = FIRST;

  /**
   * @param {Database} database
   * @param {Chunk.Comparison} data
   * @param {Chunk.Clusters | null} clusters
   * @param {Neighbours} neighbours
   * @param {CompareState} state
   * @param {{ bins: () => Promise<Bins>, announce: (text: string) => void }} ways
   */
  constructor(database, data, clusters, neighbours, state, { bins, announce }) {
    this.database = database;
    this.data = data;
    this.neighbours = neighbours;
    this.state = state;
    this.announce = announce;
    this.groups = new Groups(database, clusters);
    this.chooser = new Chooser(database, clusters, state);
    this.contrasts = new Contrasts(database, data, bins);
    this.seen = new OnShapes(database, state, announce);
    tellFigures(() => this.view, this.seen);
    this.status = document.getElementById("status");
    this.result = document.getElementById("result");
    this.inquiry = new Inquiry((told) => this.#tell(told));
    document.getElementById("more-bins").addEventListener("click", () => {
      this.shown += MORE;
      this.#bins();
    });
    state.listen((changed) => {
      if (changed.has("theme") && this.pair) this.#heads(this.pair);
      if (changed.has("theme") && this.view) this.#render();
      else if (changed.has("a") || changed.has("b") || changed.has("view")) this.compare();
      else if ((changed.has("bin") || changed.has("reading")) && this.view) this.#look();
    });
  }

  /** @type {{ a: Group | null, b: Group | null, common: number } | null} */
  pair = null;

  /** Compare the groups that are chosen, if they are in view. */
  async compare() {
    const { state } = this;
    if (state.get("view") !== "groups") return;
    this.chooser.render();
    const asked = (this.latest = Symbol("asked"));
    const pair = await this.groups.resolve(state.get("a"), state.get("b"));
    if (asked !== this.latest) return;
    this.pair = pair;
    const problem = this.#problem(pair);
    if (problem === null) this.#ask(/** @type {{ a: Group, b: Group }} */ (pair));
    else {
      this.inquiry.rest();
      this.#blank(problem);
    }
    // Pictures are asked for after what the answer needs.
    await pause();
    if (asked === this.latest) this.#heads(pair);
  }

  /** @param {{ a: Group, b: Group }} groups */
  #ask({ a, b }) {
    const key = JSON.stringify([a.shapes, b.shapes]);
    this.inquiry.ask(
      key,
      (report) => this.contrasts.start(a.shapes, b.shapes, report),
      (contrast) => this.#answered(contrast, { a, b }),
    );
  }

  /**
   * Why these groups cannot be compared, in words; or null.
   * @param {{ a: Group | null, b: Group | null, common: number }} parts
   */
  #problem({ a, b }) {
    const { database } = this;
    if (database.count < 2) return ["This database has one shape: there is nothing to compare it with yet."];
    if (a === null || b === null) {
      return database.labelled
        ? ["Choose a group on each side: a class, shapes that a search finds, or all other shapes."]
        : [
            "This database has no labels. Find shapes by words above, or select some on the ",
            element("a", { href: pageAddress("index.html") }, "Overview"),
            " and choose “Compare with the rest” there.",
          ];
    }
    if (isSame(a.spec, b.spec))
      return ["Both sides are ", called(a, ":"), " choose another group on one of them, or all other shapes."];
    for (const group of [a, b]) {
      if (group.shapes.length > 0) continue;
      if (group.spec.kind === "search") return ["No shape is found by ", called(group, ":"), " try another word."];
      if (group.spec.kind === "rest")
        return ["All shapes are in ", called(group === a ? b : a, ":"), " there are no others."];
      return ["There is no shape in ", called(group), " that the other group does not have."];
    }
    if (a.shapes.length + b.shapes.length < 3)
      return [
        "Two single shapes: here at least one group needs two. ",
        element("a", { href: besideAddress(database, a.shapes[0], b.shapes[0]) }, "See where the two differ"),
        ".",
      ];
    return null;
  }

  /** @param {(string | HTMLElement)[] | string[]} words */
  #blank(words) {
    this.view = null;
    this.result.hidden = true;
    this.status.replaceChildren(element("p", { class: "notice" }, words));
    this.announce(this.status.textContent);
  }

  /**
   * Counts and faces of both groups.
   * @param {{ a: Group | null, b: Group | null, common: number }} parts
   */
  #heads({ a, b, common }) {
    const { database } = this;
    for (const [side, group] of Object.entries({ a, b })) {
      const node = document.getElementById(`head-${side}`);
      node.replaceChildren();
      if (!group || group.shapes.length === 0) continue;
      const query = new URLSearchParams();
      writeSelection(query, database, new Set(group.shapes));
      node.replaceChildren(
        element(
          "p",
          {},
          group.mark(),
          element("b", {}, count(group.shapes.length, "shape")),
          " ",
          element("a", { href: galleryOf(database, new Set(group.shapes)) }, "Show in Shapes"),
          " ",
          element("a", { href: pageAddress("index.html", query) }, "on the map"),
        ),
        element(
          "div",
          { class: "faces" },
          faces(group.shapes).map((index) => picture(database, index, 64)),
        ),
      );
    }
    document.getElementById("common").textContent =
      common > 0 && !(a && b && isSame(a.spec, b.spec))
        ? `${count(common, "shape")} would be in both groups; the smaller one keeps ${common === 1 ? "it" : "them"}.`
        : this.chooser.moved;
  }

  /** @param {Standing} standing */
  #tell({ kind, progress = 0, message }) {
    const { database, status } = this;
    document.getElementById("groups").setAttribute("aria-busy", String(kind === "working"));
    if (kind === "working") {
      const words =
        progress > 0
          ? "Dealing the shapes out at random, to know what chance does …"
          : `Reading the bins of ${count(database.count, "shape")} …`;
      if (!this.bar) {
        this.bar = { words: element("p", {}), progress: element("progress", { max: 1, "aria-label": "Comparing" }) };
        status.replaceChildren(element("div", { class: "working" }, this.bar.words, this.bar.progress));
      }
      this.bar.words.textContent = words;
      this.bar.progress.value = progress;
      return;
    }
    this.bar = null;
    if (kind === "failed") this.#blank([`The comparison failed: ${message}`]);
    else if (kind === "answered") status.replaceChildren();
  }

  /**
   * @param {Contrast} contrast
   * @param {{ a: Group, b: Group }} groups
   */
  #answered(contrast, { a, b }) {
    const { database } = this;
    const { bins } = contrast;
    const named = bins.names.indexOf(this.state.get("bin") ?? "");
    // The first that can be seen on shapes.
    const best = contrast.told.find((column) => bins.isShare(column)) ?? contrast.told[0] ?? 0;
    /** @type {View["rest"]} */
    const rest = {
      side: "rest",
      name: "the others",
      label: "the others",
      color: () => "var(--quiet)",
      mark: () => null,
      count: database.count - a.shapes.length - b.shapes.length,
    };
    /** @param {number} column */
    const look = (column) =>
      // Who asks for a bin asks for its colours, not for those of all features together.
      this.state.set({
        bin: bins.names[column],
        ...(this.state.get("reading") === "apart" ? { reading: "value" } : {}),
      });
    this.view = {
      contrast,
      a,
      b,
      bins,
      data: this.data,
      rest,
      look,
      best,
      bin: named >= 0 ? named : best,
    };
    this.shown = FIRST;
    this.result.hidden = false;
    this.#render();
    this.announce(`${database.count > 0 ? document.querySelector("#answer h2").textContent : ""}`);
    this.seen.show(this.view);
  }

  #render() {
    const { data, neighbours } = this;
    const view = /** @type {View} */ (this.view);
    const { contrast, a, b, bins } = view;
    const kin = neighbours === null ? null : kinship(a, b, neighbours);
    const sampled = [a, b]
      .filter(({ side, shapes }) => contrast.values[side].count < shapes.length)
      .map((group) => [
        called(group),
        ` by ${grouped(contrast.values[group.side].count)} of ${count(group.shapes.length, "shape")}`,
      ]);
    document.getElementById("answer").replaceChildren(
      ...answer(contrast, a, b, data, kin),
      ...(sampled.length > 0
        ? [
            element(
              "p",
              { class: "quiet" },
              "Compared by samples: ",
              sampled.flatMap((words, place) => [place > 0 ? ", " : "", words].flat()),
              ".",
            ),
          ]
        : []),
    );
    this.#bins();
    this.#shared();
    document.getElementById("feature-rows").replaceChildren(...featureRows(view));
    const groups = [a, b].flatMap(({ spec }) => (spec.kind === "class" ? [spec.group] : []));
    const classes = groups.length === 2 ? groups.map((group) => ["class", this.database.classes[group]]) : [];
    const columns = varied(contrast.ranked, bins, FIRST);
    document.getElementById("to-workbench").href = pageAddress("workbench.html", [
      ...classes,
      ["bins", shortNames(columns, bins.features)],
    ]);
    if (this.seen.view === view) this.seen.draw();
  }

  #bins() {
    const view = /** @type {View} */ (this.view);
    const { contrast, bins } = view;
    const columns =
      this.shown === FIRST ? varied(contrast.told, bins, FIRST) : oneOfDimension(contrast.told, bins, this.shown);
    const within = contrast.beyond.length === 0;
    document.getElementById("apart-words").textContent = within
      ? "These bins differ most between the two groups, but no more than bins do when the shapes are dealt out at random."
      : `Ranked by the difference of the means in relation to the spread within the groups; those that are easily pictured first. Each mark is a shape${[contrast.values.a, contrast.values.b].every(hasDots) ? "" : ", or each bar how many shapes of a large group lie there"}; the line is the mean.`;
    const list = document.getElementById("apart-bins");
    list.classList.toggle("within", within);
    list.replaceChildren(...columns.map((column) => binCard(column, view)));
    document.getElementById("more-bins").hidden =
      oneOfDimension(contrast.told, bins, columns.length + 1).length <= columns.length;
  }

  #shared() {
    const view = /** @type {View} */ (this.view);
    const { contrast, bins, a, b } = view;
    const columns = varied(contrast.shared, bins, SHARED);
    const nobody = contrast.values.rest.count < 2;
    document
      .getElementById("shared-words")
      .replaceChildren(
        ...(nobody
          ? ["Every shape is in one of the two groups, so there are no others that they could be alike against."]
          : columns.length === 0
            ? [
                "No bin sets ",
                called(a),
                " and ",
                called(b),
                " together apart from the other shapes: what they have in common, others have too.",
              ]
            : ["Here both are unlike the other shapes of the database, and like each other."]),
      );
    document
      .getElementById("shared-bins")
      .replaceChildren(...columns.map((column) => binCard(column, view, { shared: true })));
  }

  #look() {
    const view = /** @type {View} */ (this.view);
    const place = view.bins.names.indexOf(this.state.get("bin") ?? "");
    view.bin = place >= 0 ? place : view.best;
    for (const chip of this.result.querySelectorAll(".bin-chip"))
      chip.setAttribute("aria-pressed", String(Number(chip.dataset.column) === view.bin));
    this.seen.draw();
    if (place >= 0 && document.activeElement?.matches("#result .bin-chip"))
      document.getElementById("seen").scrollIntoView({ block: "nearest" });
  }
}

/**
 * The best bin of each dimension.
 * @param {number[]} columns
 * @param {Bins} bins
 * @param {number} most
 */
function oneOfDimension(columns, bins, most) {
  const dimensions = new Set();
  return columns
    .filter((column) => !dimensions.has(column - bins.binOf(column)) && dimensions.add(column - bins.binOf(column)))
    .slice(0, most);
}

/**
 * A few shapes from all over a group.
 * @param {number[]} shapes
 */
function faces(shapes) {
  if (shapes.length <= FACES) return shapes;
  return Array.from({ length: FACES }, (_, place) => shapes[Math.floor(((place + 0.5) * shapes.length) / FACES)]);
}
