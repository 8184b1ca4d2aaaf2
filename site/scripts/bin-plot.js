// The bars of the bins on a canvas: where each stands, which part is in view, and what is marked.

import { axisEnd, edges, paintBars, paintRows } from "./bin-bars.js";
import { BinStrip } from "./bin-strip.js";
import { calm, element, svg } from "./dom.js";
import { styleColor } from "./theme.js";

/** Pixels a bar: with few bars, and zoomed in as far as it goes. */
const WIDEST = 36;
const CLOSEST = 48;
/** Letters of a name below a bar. */
const NAME = 12;
/** From these widths on, bars have their names below them, and chosen ones a border each. */
const NAMED = 13;
const BORDERED = 5;
const ROW = 12;
const FOOT = [76, 108];
/** Room for the ticks of matches above names and rows. */
const MARKS = 9;
/** Narrower runs of chosen bins have no frame, which would look like a bar. */
const FRAMED = 6;
const MOVEMENT = 280;
const MOST_MOVING = 4000;

export class BinPlot {
  constructor(bins) {
    this.bins = bins;
    this.scores = new Float64Array(bins.count);
    this.chosen = new Set();
    this.matched = null;
    this.places = new Int32Array();
    this.placeOf = new Int32Array(bins.count).fill(-1);
    this.position = new Float32Array(bins.count);
    this.level = new Float32Array(bins.count);
    this.feature = Uint16Array.from({ length: bins.count }, (_, column) => bins.featureOf(column));
    this.features = [];
    this.view = { left: 0, step: 0 };
    this.pointed = null;
    this.range = null;
    this.canvas = element("canvas");
    this.pointer = svg("rect", { class: "column pointed", y: 0 });
    this.brush = svg("rect", { class: "brush", y: 0 });
    this.message = element("p", { class: "message" }, "No bins to show yet.");
    this.surface = element(
      "div",
      { class: "surface", tabindex: "0", role: "application", "aria-label": "Bins and their scores", "aria-describedby": "bin-keys" },
      this.canvas,
      svg("svg", { class: "overlay", "aria-hidden": "true" }, this.pointer, this.brush),
      this.message,
    );
    this.rows = element("ul");
    this.levels = element("div", { class: "levels" });
    this.strip = new BinStrip((from, to, held) => this.#frameShares(from, to, held));
    this.node = element(
      "div",
      { class: "bin-plot" },
      element("div", { class: "sides", "aria-hidden": "true" }, this.levels, this.rows),
      this.surface,
      this.strip.node,
    );
  }

  #frame = null;
  #movement = null;

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
    const whole = this.view.step <= this.#least;
    this.density = window.devicePixelRatio;
    this.width = Math.max(this.surface.clientWidth, 10);
    this.height = Math.max(this.surface.clientHeight, 10);
    const foot = Math.min(Math.max(this.features.length * ROW + MARKS, FOOT[0]), FOOT[1]);
    this.foot = Math.min(foot, Math.round(this.height * 0.48));
    this.node.style.setProperty("--foot", `${this.foot}px`);
    this.#listRows();
    Object.assign(this.canvas, { width: this.#pixels(this.width), height: this.#pixels(this.height) });
    this.look(this.view.left, whole ? 0 : this.view.step);
    this.#paint();
    this.#paintStrip();
  }

  #pixels(length) {
    return Math.round(length * this.density);
  }

  /** Show bars in an order; they move from where they were, and grow or shrink to their scores. */
  show({ scores, chosen, places }) {
    const whole = this.view.step <= this.#least;
    const first = this.places.length === 0;
    const [position, level] = [this.position.slice(), this.level.slice()];
    // New ones grow where they stand.
    places.forEach((column, place) => {
      if (this.placeOf[column] >= 0) return;
      position[column] = place;
      level[column] = 0;
    });
    this.placeOf.fill(-1);
    const features = new Set();
    places.forEach((column, place) => {
      this.placeOf[column] = place;
      features.add(this.feature[column]);
    });
    Object.assign(this, { scores, chosen, places, features: [...features].sort((a, b) => a - b) });
    this.top = axisEnd(places.reduce((most, column) => Math.max(most, scores[column]), 0));
    this.levels.replaceChildren(...[this.top, this.top / 2, 0].map((level) => element("span", {}, String(Number(level.toPrecision(3))))));
    if (first) this.resize();
    else this.#listRows();
    this.look(this.view.left, whole ? 0 : this.view.step);
    this.#travel(position, level, first || calm() || places.length > MOST_MOVING ? 0 : MOVEMENT);
  }

  #travel(position, level, duration) {
    cancelAnimationFrame(this.#movement);
    const begin = performance.now();
    const step = () => {
      const share = duration === 0 ? 1 : Math.min((performance.now() - begin) / duration, 1);
      const gone = 1 - (1 - share) ** 3;
      this.places.forEach((column, place) => {
        this.position[column] = position[column] + gone * (place - position[column]);
        this.level[column] = level[column] + gone * (this.scores[column] / this.top - level[column]);
      });
      this.#movement = share < 1 ? requestAnimationFrame(step) : null;
      this.#paint();
      this.#paintStrip();
    };
    step();
  }

  /** Mark columns among all others, or none with null. */
  match(matched) {
    this.matched = matched;
    this.#redraw();
  }

  /** Mark one column, and the places of a range. */
  mark(pointed, range) {
    Object.assign(this, { pointed, range });
    this.#placeMarks();
  }

  // The part in view

  get #least() {
    return Math.min((this.width ?? 10) / Math.max(this.places.length, 1), WIDEST);
  }

  get #most() {
    return Math.max(this.#least, CLOSEST);
  }

  /** Show the bars from a place on, with so many pixels each; as near to that as there are bars. */
  look(left, step) {
    const kept = Math.min(Math.max(step, this.#least), this.#most);
    const shown = this.width / kept;
    this.view = { left: Math.min(Math.max(left, 0), Math.max(this.places.length - shown, 0)), step: kept };
    const total = Math.max(this.places.length, 1);
    this.strip.show(this.view.left / total, Math.min((this.view.left + shown) / total, 1));
    this.#redraw();
  }

  /** Show what lies between two shares of the whole; where the zoom ends, the named end stays. */
  #frameShares(from, to, held) {
    const total = this.places.length;
    const span = Math.max((to - from) * total, this.width / this.#most);
    this.look(held === "to" ? to * total - span : from * total, this.width / span);
  }

  /** Zoom by a factor with one point of the surface held still: what is pointed at, or the middle. */
  zoom(factor, x = this.#middle()) {
    const { left, step } = this.view;
    const next = Math.min(Math.max(step * factor, this.#least), this.#most);
    this.look(left + x / step - x / next, next);
  }

  #middle() {
    const x = this.pointed === null ? -1 : this.xOf(this.placeOf[this.pointed] + 0.5);
    return x >= 0 && x <= this.width ? x : this.width / 2;
  }

  pan(pixels) {
    this.look(this.view.left + pixels / this.view.step, this.view.step);
  }

  /** How many bars are in view when they are just wide enough for their names; a round number. */
  get close() {
    return Math.max(Math.floor(this.width / NAMED / 10), 1) * 10;
  }

  lookClose() {
    this.look(0, this.width / this.close);
  }

  get whole() {
    return this.view.step <= this.#least;
  }

  /** How many bars are in view. */
  get span() {
    return Math.min(this.width / this.view.step, this.places.length);
  }

  reveal(place) {
    if (this.xOf(place) < 0 || this.xOf(place + 1) > this.width + 0.5) this.look(place + 0.5 - this.span / 2, this.view.step);
  }

  xOf(place) {
    return (place - this.view.left) * this.view.step;
  }

  /** The place under a point of the surface, or null; `nearest` takes the bar beside it where there is none. */
  at(x, nearest = false) {
    const place = Math.floor(this.view.left + x / this.view.step);
    if (nearest) return Math.min(Math.max(place, 0), this.places.length - 1);
    return place >= 0 && place < this.places.length ? place : null;
  }

  /** Where a bar stands in the window. */
  box(place) {
    const { left, top } = this.surface.getBoundingClientRect();
    return { left: left + this.xOf(place), top, width: this.view.step, height: this.height - this.foot };
  }

  // Painting

  #redraw() {
    this.#frame ??= requestAnimationFrame(() => this.#paint());
  }

  #paintStrip() {
    this.strip.paint(this.#bars(this.places), this.places.length, this.#runs(), this);
  }

  #bars(columns) {
    return { columns, position: this.position, level: this.level, feature: this.feature };
  }

  #paint() {
    cancelAnimationFrame(this.#frame);
    this.#frame = null;
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.message.hidden = this.places.length > 0;
    this.#placeMarks();
    if (this.places.length === 0) return;
    const view = { left: this.view.left, step: this.view.step * this.density };
    const base = this.#pixels(this.height - this.foot);
    const frame = { width: this.canvas.width, base, room: base - this.#pixels(4), colors: this.colors };
    const inView = this.places.subarray(Math.floor(view.left), Math.ceil(view.left + frame.width / view.step) + 1);
    const visible = this.#movement === null ? inView : this.places;
    const found = this.matched && visible.filter((column) => this.matched.has(column));
    const runs = this.#runsIn(view);
    this.#paintLevels(context, frame);
    this.#paintGround(context, runs, frame);
    context.globalAlpha = found ? 0.2 : 1;
    paintBars(context, this.#bars(visible), view, frame);
    context.globalAlpha = 1;
    if (found) paintBars(context, this.#bars(found), view, frame);
    context.fillStyle = this.ink;
    context.fillRect(0, base, frame.width, this.#line(1));
    this.#paintBorders(context, visible, runs, view, frame);
    context.fillStyle = this.ink;
    if (found) this.#paintTicks(context, found, view, frame);
    const named = this.view.step >= NAMED;
    this.rows.classList.toggle("aside", named);
    if (named) this.#paintNames(context, visible, view, frame);
    else this.#paintMatrix(context, this.#bars(found ?? visible), view, frame);
  }

  #line(width) {
    return Math.max(this.#pixels(width), 1);
  }

  #paintLevels(context, { width, base, room }) {
    context.fillStyle = this.ink;
    context.globalAlpha = 0.1;
    for (const level of [0.25, 0.5, 0.75, 1]) context.fillRect(0, base - Math.round(level * room), width, this.#line(1));
    context.globalAlpha = 1;
  }

  /** Chosen bins stand on a tinted ground. */
  #paintGround(context, runs, { base, room }) {
    context.fillStyle = this.accent;
    context.globalAlpha = 0.14;
    for (const { start, width } of runs) context.fillRect(start, base - room, width, room);
    context.globalAlpha = 1;
  }

  /** Their border; where they are too narrow for one each, those side by side share a frame. */
  #paintBorders(context, visible, runs, view, { base, room }) {
    context.fillStyle = context.strokeStyle = this.accent;
    for (const { start, width } of runs) context.fillRect(start, base, width, this.#line(3));
    const framed = this.view.step < BORDERED;
    const line = (context.lineWidth = this.#line(framed || this.view.step < 10 ? 1 : 2));
    const frame = (start, width, height) => context.strokeRect(start + line / 2, base - height + line / 2, width - line, height);
    if (framed) {
      for (const { start, width } of runs) if (width >= this.#pixels(FRAMED)) frame(start, width, room);
      return;
    }
    for (const column of visible) {
      if (!this.chosen.has(column)) continue;
      const [start, end] = edges(this.position[column], view);
      frame(start, end - start, Math.max(Math.round(this.level[column] * room), 2 * line));
    }
  }

  /** Where runs of chosen bins stand on the screen. */
  #runsIn(view) {
    return this.#runs().map(([first, last]) => {
      const start = Math.round((first - view.left) * view.step);
      return { start, width: Math.max(Math.round((last + 1 - view.left) * view.step) - start, this.#line(2)) };
    });
  }

  /** First and last places of chosen bins that stand side by side. */
  #runs() {
    const runs = [];
    const places = [...this.chosen].map((column) => this.placeOf[column]).filter((place) => place >= 0);
    for (const place of places.sort((a, b) => a - b)) {
      if (runs.at(-1)?.[1] === place - 1) runs.at(-1)[1] = place;
      else runs.push([place, place]);
    }
    return runs;
  }

  /** Ticks below matches: a bar of no height, or one among thousands, would not be seen. */
  #paintTicks(context, found, view, { base }) {
    const width = Math.max(Math.min(view.step * 0.6, this.#pixels(6)), this.#line(2));
    for (const column of found) {
      const middle = (this.position[column] + 0.5 - view.left) * view.step;
      context.fillRect(Math.round(middle - width / 2), base + this.#line(2), Math.round(width), this.#pixels(4));
    }
  }

  #paintMatrix(context, bars, view, { width, base, colors }) {
    const height = Math.max(Math.floor(this.#rowHeight * this.density), 1);
    paintRows(context, bars, view, {
      width,
      top: base + this.#pixels(MARKS),
      height,
      gap: height > 3 ? this.#line(1) : 0,
      colors,
      rows: this.features,
    });
  }

  #paintNames(context, visible, view, { base }) {
    Object.assign(context, { fillStyle: this.ink, textAlign: "right", textBaseline: "middle" });
    // On a low window, names are a little smaller rather than cut.
    const plain = `${(this.foot < FOOT[0] ? 10 : 11) * this.density}px ${this.family}`;
    for (const column of visible) {
      context.font = this.chosen.has(column) || this.matched?.has(column) ? `600 ${plain}` : plain;
      context.setTransform(0, -1, 1, 0, (this.position[column] + 0.5 - view.left) * view.step, base + this.#pixels(MARKS));
      context.fillText(this.bins.shortName(column, NAME), 0, 0);
    }
    context.resetTransform();
  }

  get #rowHeight() {
    return Math.min((this.foot - MARKS) / Math.max(this.features.length, 1), ROW);
  }

  /** The names of the features in use, where their rows are high enough for one. */
  #listRows() {
    this.node.style.setProperty("--row", `${this.#rowHeight}px`);
    const named = this.#rowHeight >= 10 ? this.features : [];
    this.rows.replaceChildren(...named.map((feature) => element("li", { dir: "auto", title: this.bins.features[feature].title }, this.bins.features[feature].name)));
  }

  #placeMarks() {
    const place = this.pointed === null ? -1 : this.placeOf[this.pointed];
    this.#span(this.pointer, place < 0 ? null : [place, place], 3);
    this.#span(this.brush, this.range, 1);
  }

  #span(node, range, least) {
    node.classList.toggle("shown", range !== null);
    if (range === null) return;
    const [first, last] = [Math.min(...range), Math.max(...range)];
    const width = Math.max((last + 1 - first) * this.view.step, least);
    node.setAttribute("x", this.xOf((first + last + 1) / 2) - width / 2);
    node.setAttribute("width", width);
    node.setAttribute("height", this.height);
  }
}
