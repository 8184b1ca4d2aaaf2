// The bars of the bins on a canvas: where each stands, which part is in view, and what is marked.

import { calm, element, penOf, svg } from "../base/dom.js";
import { styleColor } from "../base/theme.js";
import { axisEnd, edges, paintBars, paintRows } from "../bins-kit/bin-bars.js";
import { BinScale } from "../bins-kit/bin-scale.js";
import { BinStrip } from "./bin-strip.js";

/** @import { Bars } from "../bins-kit/bin-bars.js" */
/** @import { Bins } from "../database/bins.js" */

/**
 * Where bars are painted: the width, where they stand, how high they may rise, and colours by feature.
 * @typedef {{ width: number, base: number, room: number, colors: string[] }} Frame
 * @typedef {{ start: number, width: number }} Run chosen bins that stand side by side, in pixels of the screen
 */

/** Letters of a name below a bar. */
const NAME = 12;
/** From these widths on, bars have their names below them, and chosen ones a border each. */
const NAMED = 13;
const BORDERED = 5;
/**
 * Room for names of bars, or for so many rows with the names of their features; more rows are lower, down to nameless.
 * What the one or the other leaves is the bars'.
 */
const NAMES = 76;
const ROW = 11;
const NAMED_ROW = 9;
/** Bars are this high at least, whatever number of rows is below them. */
const LEAST_BARS = 36;
/** Room for the ticks of matches above names and rows. */
const MARKS = 9;
/** Narrower runs of chosen bins have no frame, which would look like a bar. */
const FRAMED = 6;
const MOVEMENT = 280;
const MOST_MOVING = 4000;

export class BinPlot {
  width = 10;
  height = 10;
  density = 1;
  foot = NAMES;
  top = 1;
  /** @type {string[]} */
  colors = [];
  ink = "";
  accent = "";
  family = "";

  /** @param {Bins} bins */
  constructor(bins) {
    this.bins = bins;
    /** @type {Float64Array} */
    this.scores = new Float64Array(bins.count);
    /** @type {Set<number>} */
    this.chosen = new Set();
    /** @type {Set<number> | null} */
    this.matched = null;
    /** @type {Int32Array} */
    this.places = new Int32Array();
    this.placeOf = new Int32Array(bins.count).fill(-1);
    this.position = new Float32Array(bins.count);
    this.level = new Float32Array(bins.count);
    this.feature = Uint16Array.from({ length: bins.count }, (_, column) => bins.featureOf(column));
    /** @type {number[]} */
    this.features = [];
    this.from = new Float32Array(bins.count);
    this.to = new Float32Array(bins.count);
    this.scale = new BinScale();
    /** @type {number[]} */
    this.taken = [];
    /** @type {number | null} */
    this.pointed = null;
    /** @type {[number, number] | null} */
    this.range = null;
    this.canvas = element("canvas");
    this.pointer = svg("rect", { class: "column pointed" });
    this.brush = svg("rect", { class: "brush" });
    this.message = element("p", { class: "message" }, "No bins to show yet.");
    this.surface = element(
      "div",
      {
        class: "surface",
        tabindex: "0",
        role: "application",
        "aria-label": "Bins and their scores",
        "aria-describedby": "bin-keys",
      },
      this.canvas,
      svg("svg", { class: "overlay", "aria-hidden": "true" }, this.pointer, this.brush),
      this.message,
    );
    this.rows = element("ul");
    this.levels = element("div", { class: "levels" });
    this.strip = new BinStrip((from, to, last) => {
      this.scale.frame(from * this.places.length, to * this.places.length, last);
      this.#moved();
    });
    this.node = element(
      "div",
      { class: "bin-plot" },
      element("div", { class: "sides", "aria-hidden": "true" }, this.levels, this.rows),
      this.surface,
      this.strip.node,
    );
  }

  /** @type {number | undefined} */
  #frame;
  /** @type {number | undefined} */
  #movement;

  /** Take the colours of the theme in use. */
  start() {
    // Where the system forces its colours, they stand in for those of the theme.
    const forced = window.matchMedia("(forced-colors: active)").matches;
    this.colors = this.bins.features.map((_, feature) => this.bins.colorOf(feature));
    this.ink = forced ? "CanvasText" : styleColor("ink");
    this.accent = forced ? "Highlight" : styleColor("accent");
    this.family = getComputedStyle(this.surface).fontFamily;
    this.resize();
  }

  resize() {
    this.density = window.devicePixelRatio;
    this.width = Math.max(this.surface.clientWidth, 10);
    this.height = Math.max(this.surface.clientHeight, 10);
    this.#listRows();
    Object.assign(this.canvas, { width: this.#pixels(this.width), height: this.#pixels(this.height) });
    this.#fit();
    this.#paint();
    this.#paintStrip();
  }

  /** @param {number} length */
  #pixels(length) {
    return Math.round(length * this.density);
  }

  /**
   * Show bars in an order; they move from where they were, and grow or shrink to their scores.
   * @param {{ scores: Float64Array, chosen: Set<number>, places: Int32Array }} bars
   */
  show({ scores, chosen, places }) {
    const first = this.places.length === 0;
    const [position, level] = [this.position.slice(), this.level.slice()];
    // New ones grow where they stand.
    places.forEach((column, place) => {
      if (this.placeOf[column] >= 0) return;
      position[column] = place;
      level[column] = 0;
    });
    this.placeOf.fill(-1);
    /** @type {Set<number>} */
    const features = new Set();
    places.forEach((column, place) => {
      this.placeOf[column] = place;
      features.add(this.feature[column]);
    });
    this.scores = scores;
    this.chosen = chosen;
    this.places = places;
    this.features = [...features].sort((a, b) => a - b);
    this.top = axisEnd(places.reduce((most, column) => Math.max(most, scores[column]), 0));
    this.levels.replaceChildren(
      ...[this.top, this.top / 2, 0].map((level) => element("span", {}, String(Number(level.toPrecision(3))))),
    );
    if (first) {
      // The best bars with their names are what one can read; the strip below says how many more there are.
      this.resize();
      this.lookClose();
    } else {
      this.#listRows();
      this.#fit();
    }
    this.#travel(position, level, first || calm() || places.length > MOST_MOVING ? 0 : MOVEMENT);
  }

  /**
   * @param {Float32Array} position
   * @param {Float32Array} level
   * @param {number} duration
   */
  #travel(position, level, duration) {
    if (this.#movement !== undefined) cancelAnimationFrame(this.#movement);
    const begin = performance.now();
    const step = () => {
      const share = duration === 0 ? 1 : Math.min((performance.now() - begin) / duration, 1);
      const gone = 1 - (1 - share) ** 3;
      this.places.forEach((column, place) => {
        this.position[column] = position[column] + gone * (place - position[column]);
        this.level[column] = level[column] + gone * (this.scores[column] / this.top - level[column]);
      });
      this.#movement = share < 1 ? requestAnimationFrame(step) : undefined;
      this.#paint();
      this.#paintStrip();
    };
    step();
  }

  /**
   * Mark columns among all others, or none with null.
   * @param {Set<number> | null} matched
   */
  match(matched) {
    this.matched = matched;
    this.#redraw();
  }

  /**
   * Mark one column, and the places of a range.
   * @param {number | null} pointed
   * @param {[number, number] | null} range
   */
  mark(pointed, range) {
    this.pointed = pointed;
    this.range = range;
    this.#placeMarks();
  }

  // The part in view

  #fit() {
    const chosen = [...this.chosen].map((column) => this.placeOf[column]).filter((place) => place >= 0);
    this.taken = chosen.sort((a, b) => a - b);
    this.scale.fit(this.places.length, this.taken, this.width);
    this.#moved();
  }

  #moved() {
    const total = Math.max(this.places.length, 1);
    this.strip.show(this.scale.left / total, Math.min(this.scale.placeOf(this.width) / total, 1));
    this.#redraw();
  }

  lookAtAll() {
    this.scale.look(0, 0);
    this.#moved();
  }

  /** How many bars are in view when they are just wide enough for their names; a round number. */
  get close() {
    return Math.max(Math.floor(this.width / NAMED / 10), 1) * 10;
  }

  lookClose() {
    this.scale.look(0, this.width / this.close);
    this.#moved();
  }

  /**
   * Zoom by a factor with one point of the surface held still: what is pointed at, the best bars, or the middle.
   * @param {number} factor
   * @param {number} [x]
   */
  zoom(factor, x = this.#centre()) {
    this.hold(this.scale.placeOf(x), x, this.scale.step * factor);
  }

  #centre() {
    const x = this.pointed === null ? -1 : this.scale.xOf(this.placeOf[this.pointed] + 0.5);
    if (x >= 0 && x <= this.width) return x;
    return this.scale.left === 0 ? 0 : this.width / 2;
  }

  /**
   * Show a place, which may have a fraction, at a point of the surface.
   * @param {number} place
   * @param {number} x
   * @param {number} [step]
   */
  hold(place, x, step) {
    this.scale.hold(place, x, step);
    this.#moved();
  }

  /** @param {number} pixels */
  pan(pixels) {
    this.hold(this.scale.left, -pixels);
  }

  /** How many bars are in view. */
  get span() {
    return Math.min(this.scale.placeOf(this.width), this.places.length) - this.scale.left;
  }

  /** @param {number} place */
  reveal(place) {
    if (this.scale.xOf(place) < -0.5 || this.scale.xOf(place + 1) > this.width + 0.5)
      this.hold(place + 0.5, this.width / 2);
  }

  /**
   * The place under a point of the surface, or null; `nearest` takes the bar beside it where there is none.
   * @template {boolean} [Nearest=false]
   * @param {number} x
   * @param {Nearest} [nearest]
   * @returns {Nearest extends true ? number : number | null}
   */
  at(x, nearest) {
    const place = Math.floor(this.scale.placeOf(x));
    if (nearest) return Math.min(Math.max(place, 0), this.places.length - 1);
    return /** @type {any} */ (place >= 0 && place < this.places.length ? place : null);
  }

  /**
   * Where a bar stands in the window.
   * @param {number} place
   */
  box(place) {
    const { left, top } = this.surface.getBoundingClientRect();
    const x = this.scale.xOf(place);
    return { left: left + x, top, width: this.scale.xOf(place + 1) - x, height: this.height - this.foot };
  }

  // Painting

  #redraw() {
    this.#frame ??= requestAnimationFrame(() => this.#paint());
  }

  #paintStrip() {
    const { places, position, level, feature } = this;
    this.strip.paint({ columns: places, position, level, feature }, places.length, this.#runs(), this);
  }

  #paint() {
    if (this.#frame !== undefined) cancelAnimationFrame(this.#frame);
    this.#frame = undefined;
    const context = penOf(this.canvas);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.message.hidden = this.places.length > 0;
    this.#placeMarks();
    if (this.places.length === 0) return;
    const { named } = this;
    this.rows.classList.toggle("aside", named);
    this.foot = named ? NAMES : this.#footOfRows;
    this.node.style.setProperty("--foot", `${this.foot}px`);
    const base = this.#pixels(this.height - this.foot);
    const frame = { width: this.canvas.width, base, room: base - this.#pixels(4), colors: this.colors };
    const { scale, density } = this;
    const inView = this.places.subarray(Math.floor(scale.left), Math.ceil(scale.placeOf(this.width)));
    const visible = this.#movement === undefined ? inView : this.places;
    for (const column of visible) {
      this.from[column] = scale.xOf(this.position[column]) * density;
      this.to[column] = scale.xOf(this.position[column] + 1) * density;
    }
    const bars = { columns: visible, from: this.from, to: this.to, level: this.level, feature: this.feature };
    const { matched } = this;
    const found = matched && visible.filter((column) => matched.has(column));
    const runs = this.#runsInView();
    this.#paintLevels(context, frame);
    this.#paintGround(context, runs, frame);
    context.globalAlpha = found ? 0.2 : 1;
    paintBars(context, bars, frame);
    context.globalAlpha = 1;
    if (found) paintBars(context, { ...bars, columns: found }, frame);
    context.fillStyle = this.ink;
    context.fillRect(0, base, frame.width, this.#line(1));
    this.#paintBorders(context, bars, runs, frame);
    context.fillStyle = this.ink;
    if (found) this.#paintTicks(context, found, frame);
    if (named) this.#paintNames(context, visible, frame);
    else this.#paintMatrix(context, { ...bars, columns: found ?? visible }, frame);
  }

  /** @param {number} width */
  #line(width) {
    return Math.max(this.#pixels(width), 1);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Frame} frame
   */
  #paintLevels(context, { width, base, room }) {
    context.fillStyle = this.ink;
    context.globalAlpha = 0.1;
    for (const level of [0.25, 0.5, 0.75, 1])
      context.fillRect(0, base - Math.round(level * room), width, this.#line(1));
    context.globalAlpha = 1;
  }

  /**
   * Chosen bins stand on a tinted ground.
   * @param {CanvasRenderingContext2D} context
   * @param {Run[]} runs
   * @param {Frame} frame
   */
  #paintGround(context, runs, { base, room }) {
    context.fillStyle = this.accent;
    context.globalAlpha = 0.14;
    for (const { start, width } of runs) context.fillRect(start, base - room, width, room);
    context.globalAlpha = 1;
  }

  /**
   * Their border; where they are too narrow for one each, those side by side share a frame.
   * @param {CanvasRenderingContext2D} context
   * @param {Bars} bars
   * @param {Run[]} runs
   * @param {Frame} frame
   */
  #paintBorders(context, bars, runs, { base, room }) {
    context.fillStyle = context.strokeStyle = this.accent;
    for (const { start, width } of runs) context.fillRect(start, base, width, this.#line(3));
    const framed = this.scale.chosenWidth < BORDERED;
    const line = (context.lineWidth = this.#line(this.scale.chosenWidth < 10 ? 1 : 2));
    /**
     * @param {number} start
     * @param {number} width
     * @param {number} height
     */
    const frame = (start, width, height) =>
      context.strokeRect(start + line / 2, base - height + line / 2, width - line, height);
    if (framed) {
      for (const { start, width } of runs) if (width >= this.#pixels(FRAMED)) frame(start, width, room);
      return;
    }
    for (const column of bars.columns) {
      if (!this.chosen.has(column)) continue;
      const [start, end] = edges(bars, column);
      frame(start, end - start, Math.max(Math.round(this.level[column] * room), 2 * line));
    }
  }

  /** Where runs of chosen bins stand on the screen. */
  #runsInView() {
    return this.#runs().map(([first, last]) => {
      const start = this.#pixels(this.scale.xOf(first));
      return { start, width: Math.max(this.#pixels(this.scale.xOf(last + 1)) - start, this.#line(2)) };
    });
  }

  /** First and last places of chosen bins that stand side by side. */
  #runs() {
    /** @type {[number, number][]} */
    const runs = [];
    for (const place of this.taken) {
      if (runs.length > 0 && runs.at(-1)[1] === place - 1) runs.at(-1)[1] = place;
      else runs.push([place, place]);
    }
    return runs;
  }

  /**
   * Ticks below matches: a bar of no height, or one among thousands, would not be seen.
   * @param {CanvasRenderingContext2D} context
   * @param {Int32Array} found
   * @param {Frame} frame
   */
  #paintTicks(context, found, { base }) {
    for (const column of found) {
      const [from, to] = [this.from[column], this.to[column]];
      const width = Math.max(Math.min((to - from) * 0.6, this.#pixels(6)), this.#line(2));
      context.fillRect(Math.round((from + to - width) / 2), base + this.#line(2), Math.round(width), this.#pixels(4));
    }
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Bars} bars
   * @param {Frame} frame
   */
  #paintMatrix(context, bars, { base, colors }) {
    const height = Math.max(Math.floor(this.#rowHeight * this.density), 1);
    paintRows(context, bars, {
      top: base + this.#pixels(MARKS),
      height,
      gap: height > 3 ? this.#line(1) : 0,
      colors,
      rows: this.features,
    });
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Int32Array} visible
   * @param {Frame} frame
   */
  #paintNames(context, visible, { base }) {
    Object.assign(context, { fillStyle: this.ink, textAlign: "right", textBaseline: "middle" });
    const plain = `${11 * this.density}px ${this.family}`;
    // What is too long for its room is drawn narrower, and no letter is lost.
    const longest = this.canvas.height - base - this.#pixels(MARKS + 2);
    for (const column of visible) {
      context.font = this.chosen.has(column) || this.matched?.has(column) ? `600 ${plain}` : plain;
      context.setTransform(0, -1, 1, 0, (this.from[column] + this.to[column]) / 2, base + this.#pixels(MARKS));
      context.fillText(this.bins.shortName(column, NAME), 0, 0, longest);
    }
    context.resetTransform();
  }

  /** Whether bars are wide enough for their names. */
  get named() {
    return this.scale.step >= NAMED;
  }

  get #footOfRows() {
    return Math.min(MARKS + Math.max(this.features.length, 1) * ROW, Math.max(this.height - LEAST_BARS, NAMES));
  }

  get #rowHeight() {
    return Math.min((this.#footOfRows - MARKS) / Math.max(this.features.length, 1), ROW);
  }

  /** The names of the features in use, where their rows are high enough for one. */
  #listRows() {
    this.node.style.setProperty("--row", `${this.#rowHeight}px`);
    const named = this.#rowHeight >= NAMED_ROW ? this.features : [];
    this.rows.replaceChildren(
      ...named.map((feature) =>
        element("li", { dir: "auto", title: this.bins.features[feature].title }, this.bins.features[feature].name),
      ),
    );
  }

  #placeMarks() {
    const place = this.pointed === null ? -1 : this.placeOf[this.pointed];
    this.#span(this.pointer, place < 0 ? null : [place, place], 3);
    this.#span(this.brush, this.range, 1);
  }

  /**
   * @param {Element} frame
   * @param {[number, number] | null} range
   * @param {number} least
   */
  #span(frame, range, least) {
    frame.classList.toggle("shown", range !== null);
    if (range === null) return;
    const [start, end] = [this.scale.xOf(Math.min(...range)), this.scale.xOf(Math.max(...range) + 1)];
    const width = Math.max(end - start, least);
    const box = { x: (start + end - width) / 2, y: 0, width, height: this.height };
    for (const [name, value] of Object.entries(box)) frame.setAttribute(name, value);
  }
}
