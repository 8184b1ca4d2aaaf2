// Pointer, wheel, fingers and keys on the bars.

import { count } from "../base/words.js";
import { Brush } from "../map/brush.js";

/** @import { Fingers, Place } from "../map/brush.js" */
/** @import { BinChart } from "./bin-chart.js" */
/** @import { BinPlot } from "./bin-plot.js" */

/**
 * What stands under a press as it begins: a place, where exactly, and how wide bars are.
 * @typedef {{ place: number, point: number, step: number }} Held
 */

const LEAP = 10;

export class BinGestures extends Brush {
  /**
   * @param {BinPlot} plot
   * @param {BinChart} chart is asked to point, to mark a range and to choose
   */
  constructor(plot, chart) {
    super(plot.surface);
    this.plot = plot;
    this.chart = chart;
    const { surface } = plot;
    surface.addEventListener("pointerenter", (event) => chart.hold(event.pointerType === "mouse"));
    surface.addEventListener("pointerleave", (event) => {
      if (event.pointerType === "mouse") chart.point(null);
      chart.hold(false);
    });
    surface.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    surface.addEventListener("keydown", (event) => this.#key(event));
    surface.addEventListener("blur", () => this.#letGo());
  }

  /** One choice on the page says what dragging does, on the maps and here. */
  moves() {
    return this.surface.closest("[data-drag='move']") !== null;
  }

  /**
   * Bars stand side by side: only what goes along them counts.
   * @param {[number, number]} to
   * @param {[number, number]} from
   */
  distance([x], [fromX]) {
    return Math.abs(x - fromX);
  }

  /** @param {Place} at */
  hold([x]) {
    const { scale } = this.plot;
    return { place: this.plot.at(x, true), point: scale.placeOf(x), step: scale.step };
  }

  /**
   * @param {Place} at
   * @param {PointerEvent} event
   */
  hover([x], { pointerType }) {
    if (pointerType === "mouse") this.chart.point(this.#columnAt(x));
  }

  /**
   * @param {Place} at
   * @param {PointerEvent} event
   */
  click([x], { pointerType, button }) {
    const column = this.#columnAt(x);
    if (button === 1 || column === null) return;
    // A finger cannot point without touching, so its first touch points and the next one chooses.
    if (pointerType === "mouse" || this.chart.pointed === column) {
      this.chart.toggle(column);
      // What the choice does to the maps is to be seen.
      this.chart.onPoint(null, null);
    } else this.chart.point(column);
  }

  begin() {
    this.chart.point(null);
  }

  /**
   * @param {Place} _from
   * @param {Place} to
   * @param {Held} held
   */
  draw(_from, [x], { place }) {
    const { plot } = this;
    if (plot.places.length === 0) return;
    if (x < 0 || x > plot.width) plot.pan(x < 0 ? x : x - plot.width);
    this.chart.mark([place, plot.at(x, true)]);
  }

  end() {
    this.chart.apply(this.chart.marked);
  }

  giveUp() {
    this.chart.mark(null);
  }

  /**
   * @param {Place} _from
   * @param {Place} to
   * @param {Held} held
   */
  move(_from, [x], { point }) {
    this.chart.point(null);
    this.plot.hold(point, x);
  }

  /**
   * What was between the fingers stays between them.
   * @param {Fingers} before
   * @param {Fingers} now
   * @param {Held} held
   */
  pinch(before, now, { point, step }) {
    this.plot.hold(point, now.middle[0], (step * now.spread) / before.spread);
  }

  /** @param {number} x */
  #columnAt(x) {
    const place = this.plot.at(x);
    return place === null ? null : this.plot.places[place];
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    const lines = event.deltaMode === 1 ? 18 : 1;
    const sideways = event.shiftKey ? event.deltaX || event.deltaY : event.deltaX;
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      if (this.plot.scale.whole) return;
      this.plot.pan(sideways * lines);
    } else {
      // Where the page itself scrolls, the wheel belongs to it unless the reader asks for zoom.
      const scrolls = document.documentElement.scrollHeight > window.innerHeight + 1;
      if (scrolls && !event.ctrlKey && !event.metaKey) return;
      this.plot.zoom(Math.exp((-event.deltaY * lines * (event.ctrlKey ? 4 : 1)) / 500), this.placeOf(event)[0]);
    }
    event.preventDefault();
    this.chart.point(null);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { plot, chart } = this;
    const leap = Math.max(LEAP, Math.floor(plot.span / 10));
    /** @type {Record<string, number>} */
    const steps = {
      ArrowLeft: -1,
      ArrowRight: 1,
      PageUp: -leap,
      PageDown: leap,
      Home: -plot.places.length,
      End: plot.places.length,
    };
    if (event.key in steps) this.#walk(steps[event.key], event.shiftKey);
    else if (event.key === "Enter" || event.key === " ") {
      if (chart.range) chart.apply(chart.marked);
      else if (chart.pointed !== null) chart.toggle(chart.pointed);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      chart.giveUp(chart.range ? chart.marked : chart.pointed === null ? [] : [chart.pointed]);
    } else if (event.key === "+" || event.key === "=") plot.zoom(1.5);
    else if (event.key === "-") plot.zoom(1 / 1.5);
    else if (event.key === "0") plot.lookAtAll();
    else if (event.key === "Escape" && (chart.range || chart.pointed !== null)) this.#letGo();
    else return;
    event.preventDefault();
  }

  /**
   * @param {number} number
   * @param {boolean} extend
   */
  #walk(number, extend) {
    const { plot, chart } = this;
    const { places, placeOf } = plot;
    if (!extend || chart.pointed === null) {
      if (chart.range) chart.mark(null);
      chart.step(number);
      return;
    }
    const [from, to] = chart.range ?? [placeOf[chart.pointed], placeOf[chart.pointed]];
    const end = Math.min(Math.max(to + number, 0), places.length - 1);
    plot.reveal(end);
    chart.point(places[end]);
    chart.mark([from, end]);
    chart.announce(`${count(chart.marked.length, "bin")} marked, to ${chart.bins.names[places[end]]}`);
  }

  #letGo() {
    this.chart.mark(null);
    this.chart.point(null);
  }
}
