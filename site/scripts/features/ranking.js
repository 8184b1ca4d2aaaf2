// Fig. 4: a bar a subset, its features below it; the greedy path and what is chosen above them.

import { drawChart } from "../base/chart.js";
import { element, pause, svg } from "../base/dom.js";
import { toldAs } from "../base/snapshot.js";
import { count, figure, grouped, isolated, lowered } from "../base/words.js";
import { isBelowOne, ofAtMost } from "../database/hit-range.js";
import { change } from "../base/figures.js";
import { MEASURES } from "../map/measures.js";

/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { SubsetMeasure, Subsets } from "../database/subsets.js" */

const BARS = 150;
const ROW = 15;
/** Of the height of its row, how much a cell takes. */
const CELL = 0.86;
const WIDEST = 36;
const TOUCHABLE = 3;
const LEAP = 10;
const CLOSEST = 10;

/**
 * The colours of the theme in use, for charts and what is drawn beside them.
 * @typedef {() => Chunk.FeatureMarks & { config: Record<string, any>, ink: string, accent: string, ground: string }} Marks
 */

export class Ranking {
  /** @type {any} Vega's view of the features of the subsets, once it is there */
  matrix = null;
  /** @type {any} and of their bars, where there are any */
  bars = null;
  width = 0;
  step = 0;
  /** @type {number[]} the places of subsets, from left to right, and where each stands */
  order = [];
  /** @type {number[]} */
  position = [];

  /**
   * @param {Subsets} subsets
   * @param {FeaturesState} state
   * @param {Marks} marks
   * @param {(text: string) => void} announce
   */
  constructor(subsets, state, marks, announce) {
    this.subsets = subsets;
    this.state = state;
    this.marks = marks;
    this.announce = announce;
    this.surface = document.getElementById("ranking");
    this.scroll = this.surface.parentElement;
    this.reading = document.getElementById("reading");
    toldAs(this.surface.closest("[data-figure]"), () => ({
      words: `${count(this.order.length, "subset")} of ${count(this.features.length, "feature")}${this.measure ? `, by ${this.measure.name === "nh" ? "NH_s" : measureTitle(this.measure.name)}, the best first` : ""}: a column a subset, with a mark for each of its features.`,
    }));
    this.top = subsets.measures.length > 0 ? BARS : 0;
    this.overlay = svg("svg", { class: "overlay", "aria-hidden": "true" });
    this.levels = this.overlay.appendChild(svg("g", { class: "levels" }));
    this.pointed = this.overlay.appendChild(svg("rect", { class: "column pointed", y: 0 }));
    this.chosen = this.overlay.appendChild(svg("rect", { class: "column chosen", y: 0.5 }));
    this.path = this.overlay.appendChild(svg("g", { class: "path" }));
    this.surface.append(this.overlay);
    if (subsets.labelled) document.getElementById("chance-best").textContent = figure(subsets.data.chanceBest);
    this.#offer();
    this.#rank();
    this.#listen();
  }

  /** The measure that subsets are ranked by; undefined where nothing is known of any. */
  get measure() {
    return this.subsets.measures.find(({ name }) => name === this.state.get("rank"));
  }

  get among() {
    return this.state.get("among");
  }

  /** The features of what is ranked, as rows from above. */
  get features() {
    const { subsets, among } = this;
    return subsets.data.order.filter((feature) => subsets.isOf(feature, among));
  }

  /** Of the bars and the rows of features below them. */
  get height() {
    return this.top + ROW * this.features.length;
  }

  /** What subsets can be ranked by. */
  #offer() {
    const select = document.getElementById("rank");
    if (!select) return;
    select.replaceChildren(
      ...this.subsets.measures.map(({ name }) => element("option", { value: name }, measureTitle(name))),
    );
    select.addEventListener("change", () => this.state.set({ rank: select.value }));
  }

  /** Put the subsets in their order, and say what it is. */
  #rank() {
    const { subsets, measure } = this;
    this.order = subsets.ranked(measure, this.among);
    this.position = [];
    for (const [position, place] of this.order.entries()) this.position[place] = position;
    for (const input of document.querySelectorAll("#among input")) input.checked = input.value === this.among;
    for (const node of document.querySelectorAll("[data-among]")) node.hidden = node.dataset.among !== this.among;
    if (measure === undefined) return;
    const labelled = measure.name === "nh";
    document.getElementById("rank").value = measure.name;
    document.getElementById("rank-words").textContent =
      measure.name === "nh"
        ? ""
        : `The height of a bar: ${lowered(MEASURES[measure.name].meaning)}. The map of each subset is held to distances by its own features: whether these are worth comparing, it does not say.`;
    /** @type {Record<string, boolean>} */
    const known = { nh: labelled, best: labelled && this.chanceBest !== null, chance: measure.chance !== null };
    for (const rule of document.querySelectorAll("[data-rule]")) rule.hidden = !known[rule.dataset.rule ?? ""];
    document.getElementById("chance").textContent = figure(measure.chance);
    document.querySelector("[data-rule=chance] > span").textContent = labelled ? "random labels" : "a map at random";
  }

  #listen() {
    const { surface, state } = this;
    surface.addEventListener("pointermove", (event) => state.set({ pointedPlace: this.#at(event) }));
    surface.addEventListener("pointerleave", () => state.set({ pointedPlace: null }));
    surface.addEventListener("blur", () => state.set({ pointedPlace: null }));
    surface.addEventListener("click", (event) => state.set({ chosen: this.#at(event) ?? state.get("chosen") }));
    surface.addEventListener("keydown", (event) => this.#key(event));
    for (const input of document.querySelectorAll("#greedy input")) {
      input.addEventListener("change", () => state.set({ s: input.value === "none" ? null : Number(input.value) }));
    }
    for (const input of document.querySelectorAll("#among input")) {
      input.addEventListener("change", () => state.set({ among: input.value }));
    }
    state.listen((changed) => {
      if (changed.has("chosen") || changed.has("pointedPlace")) this.#point();
      if (changed.has("s")) this.#trace();
      if (changed.has("rank") || changed.has("among")) this.#reorder();
    });
  }

  /** Draw with the colours of the theme in use. */
  async start() {
    const { subsets } = this;
    const { charts } = subsets.data;
    const matrix = await drawChart(
      document.getElementById("feature-matrix"),
      charts.matrix,
      this.marks().config,
      "svg",
    );
    this.matrix?.finalize();
    this.matrix = matrix;
    if (subsets.measures.length > 0) {
      const bars = await drawChart(document.getElementById("subset-bars"), charts.bars, this.marks().config, "svg");
      this.bars?.finalize();
      this.bars = bars.signal("bar", this.marks().bar).height(BARS).data("subsets", this.#rows());
    }
    await this.#lay();
  }

  #rows() {
    return this.order.map((place, position) => ({
      place: position,
      hit: this.measure?.values?.[place] ?? null,
      feature: this.#hue(place),
    }));
  }

  async #reorder() {
    this.#rank();
    if (!this.step) return;
    this.bars?.data("subsets", this.#rows());
    await this.#lay();
  }

  /** The rows of the features, and all that has their height. */
  async #lay() {
    const { subsets, features, height } = this;
    this.matrix.height(ROW * features.length);
    this.surface.style.height = `${height}px`;
    this.pointed.setAttribute("height", height);
    this.chosen.setAttribute("height", height - 1);
    document
      .getElementById("rows")
      .replaceChildren(
        ...features.map((feature) =>
          element("li", { dir: "auto", title: subsets.features[feature] }, subsets.features[feature]),
        ),
      );
    this.step = 0;
    await this.resize();
  }

  /** @param {number} place */
  #hue(place) {
    const single = this.subsets.single(place);
    return single < 0 ? -1 : this.subsets.data.hues[single];
  }

  /** Bars are whole pixels wide, so that all are equally sharp; where that is too narrow for a finger, they scroll. */
  async resize() {
    const room = this.scroll.clientWidth;
    const least = room < 600 ? TOUCHABLE : 1;
    const step = Math.min(Math.max(Math.floor(room / this.order.length), least), WIDEST);
    if (step === this.step || this.matrix === null) return;
    this.step = step;
    this.width = step * this.order.length;
    this.surface.style.width = `${this.width}px`;
    this.overlay.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    this.#level();
    this.#point();
    this.#trace();
    const wide = step > 2 ? step - 1 : step;
    await this.matrix.width(this.width).data("rows", this.#cells(wide)).runAsync();
    await pause();
    await this.bars
      ?.width(this.width)
      .signal("count", this.order.length)
      .signal("fill", wide / step)
      .runAsync();
  }

  /**
   * The cells of each feature, as one shape: Vega takes little longer for it than for one cell.
   * @param {number} wide
   */
  #cells(wide) {
    const { subsets, step } = this;
    return this.features.map((feature, row) => {
      const [top, foot] = [row * ROW, (row + CELL) * ROW];
      const coordinates = this.order
        .filter((place) => subsets.has(place, feature))
        .map((place) => {
          const left = this.position[place] * step;
          const right = left + wide;
          return [
            [
              [left, top],
              [right, top],
              [right, foot],
              [left, foot],
              [left, top],
            ],
          ];
        });
      return { type: "Feature", feature: subsets.data.hues[feature], geometry: { type: "MultiPolygon", coordinates } };
    });
  }

  /** What the best of the maps in view reaches with random labels; null where that is not known. */
  get chanceBest() {
    return this.among === "all" ? this.subsets.data.chanceBest : null;
  }

  #level() {
    const { measure } = this;
    const { highest } = this.subsets.data;
    /**
     * @param {number | null} value
     * @param {string} kind
     */
    const rule = (value, kind) =>
      value !== null && svg("line", { class: kind, x1: 0, x2: this.width, y1: this.#y(value), y2: this.#y(value) });
    if (measure === undefined) return;
    const labelled = measure.name === "nh";
    this.levels.replaceChildren(
      ...[
        rule(0.25, "grid"),
        rule(0.5, "grid"),
        rule(0.75, "grid"),
        rule(1, "grid"),
        rule(measure.chance, "rule"),
        labelled && rule(this.chanceBest, "rule strong"),
        labelled && isBelowOne(highest) && rule(highest, "rule most"),
      ].filter(Boolean),
    );
  }

  /** @param {number} place */
  #x(place) {
    return (this.position[place] + 0.5) * this.step;
  }

  /** @param {number | null | undefined} value */
  #y(value) {
    return BARS * (1 - (value ?? 0));
  }

  /** @param {PointerEvent & Targeted} event */
  #at(event) {
    const position = Math.floor((event.clientX - this.surface.getBoundingClientRect().left) / this.step);
    return this.order[position] ?? null;
  }

  /** @param {KeyboardEvent & Targeted} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    /** @type {Record<string, number>} */
    const steps = { ArrowLeft: -1, ArrowRight: 1, PageUp: -LEAP, PageDown: LEAP, Home: -Infinity, End: Infinity };
    const from = this.state.get("pointedPlace") ?? this.state.get("chosen");
    if (event.key in steps) {
      const position = Math.min(Math.max((this.position[from] ?? 0) + steps[event.key], 0), this.order.length - 1);
      const place = this.order[position];
      this.state.set({ pointedPlace: place });
      this.#reveal(place);
      this.announce(this.#words(place));
    } else if (event.key === "Enter" || event.key === " ") this.state.set({ chosen: from });
    else if (event.key === "Escape") this.state.set({ pointedPlace: null });
    else return;
    event.preventDefault();
  }

  /** @param {number} place */
  #reveal(place) {
    const [x, left, width] = [this.#x(place), this.scroll.scrollLeft, this.scroll.clientWidth];
    if (x < left + 20 || x > left + width - 20) this.scroll.scrollLeft = x - width / 2;
  }

  /** @param {number} place */
  #words(place) {
    const { measure } = this;
    const rank =
      measure === undefined
        ? ""
        : `Rank ${grouped(this.position[place] + 1)} of ${grouped(this.order.length)}, ${measureTitle(measure.name)} ${figure(measure.values?.[place])}: `;
    return `${rank}${this.subsets.names(place).map(isolated).join(", ")}`;
  }

  #point() {
    if (!this.step) return;
    const [pointed, chosen] = [this.state.get("pointedPlace"), this.state.get("chosen")];
    this.pointed.classList.toggle("shown", pointed !== null);
    if (pointed !== null) {
      this.pointed.setAttribute("x", this.position[pointed] * this.step - 1);
      this.pointed.setAttribute("width", this.step + 1);
    }
    // What is chosen need not be among what is ranked.
    this.chosen.style.display = chosen in this.position ? "" : "none";
    this.chosen.setAttribute("x", (this.position[chosen] ?? 0) * this.step - 1);
    this.chosen.setAttribute("width", this.step + 1);
    const place = pointed ?? chosen;
    const { subsets, measure } = this;
    /** @param {SubsetMeasure} by */
    const scored = ({ name, values }) => [
      place in this.position &&
        element(
          "span",
          {},
          "rank ",
          element("b", {}, grouped(this.position[place] + 1)),
          ` of ${grouped(this.order.length)}`,
        ),
      element(
        "span",
        {},
        name === "nh" ? ["NH", element("sub", {}, "s")] : measureTitle(name),
        " ",
        element("b", {}, figure(values?.[place])),
        name === "nh" && ofAtMost(subsets.data.highest),
      ),
    ];
    this.reading.replaceChildren(
      element("span", { class: "which" }, pointed === null ? "Chosen" : "Pointed at"),
      ...(measure === undefined ? [] : scored(measure).filter(Boolean)),
      element(
        "span",
        { class: "members" },
        subsets.names(place).map((name) => this.#member(name)),
      ),
    );
  }

  /** @param {string} name */
  #member(name) {
    const mark = element("i", { class: "hued" });
    mark.style.background = this.marks().features[this.subsets.data.hues[this.subsets.features.indexOf(name)]];
    return element("span", {}, mark, element("bdi", {}, name));
  }

  /** The steps of the greedy search, in order, on the bars and in words. */
  #trace() {
    const s = this.state.get("s");
    for (const input of document.querySelectorAll("#greedy input")) input.checked = input.value === String(s ?? "none");
    const greedy = this.subsets.data.greedy.find((search) => search.s === s);
    const words = document.getElementById("trace");
    if (!this.step || words === null) return;
    this.path.replaceChildren();
    words.replaceChildren();
    // It went among all subsets.
    if (!greedy || this.among !== "all") return;
    const { hit } = this.subsets.data;
    const places = greedy.path.map((place) => [this.#x(place), this.#y(this.measure?.values?.[place])]);
    // Numbers that would touch an earlier one are left out; the words below have them all.
    /** @type {number[]} */
    const numbered = [];
    for (const [index, [x]] of places.entries())
      if (numbered.every((other) => Math.abs(x - places[other][0]) >= CLOSEST)) numbered.push(index);
    this.path.append(
      svg("polyline", { points: places.map((place) => place.join()).join(" ") }),
      ...places.map(([x, y]) => svg("circle", { cx: x, cy: y, r: 3.5 })),
      ...numbered.map((index) => {
        const [x, y] = places[index];
        return svg("text", { x, y: Math.max(y - 8, 10), "text-anchor": "middle" }, String(index + 1));
      }),
    );
    const steps = greedy.path.map((place, index) => [
      index > 0 && " → ",
      element(
        "button",
        {
          type: "button",
          class: "step",
          title: `Choose ${this.subsets.names(place).map(isolated).join(", ")}`,
          onclick: () => this.state.set({ chosen: place }),
        },
        `${index + 1}. ${this.subsets.names(place).map(isolated).join(" ")} `,
        element("b", {}, figure(hit[place])),
      ),
    ]);
    const last = greedy.path.at(-1);
    const behind = change(hit[last] ?? 0, hit[0] ?? 0);
    words.append(
      `Greedy search, s = ${s}: `,
      .../** @type {any[]} */ (steps).flat().filter(Boolean),
      ` with ${count(greedy.runs, "map")} of ${grouped(this.subsets.count)}; ${(hit[0] ?? 0) > (hit[last] ?? 0) ? `rank ${grouped(last + 1)}, ${figure(behind)} below the best.` : "the best of all."}`,
    );
  }
}

/**
 * @param {SubsetMeasure["name"]} name
 */
export function measureTitle(name) {
  return name === "nh" ? "NH" : MEASURES[name].title;
}
