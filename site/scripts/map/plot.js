// A map of shapes on one canvas: the Bins page shows dozens, each of few marks, and none needs more than a picture.

import { calm, svg, watchSize } from "../base/dom.js";
import { drawnAs } from "../base/snapshot.js";
import { bounds } from "../database/database.js";
import { markAt } from "./figure.js";
import { FADED, Marks } from "./marks.js";

/** @import { Database } from "../database/database.js" */

/**
 * How a shape is drawn.
 * @typedef {{ path: string, color: string, radius: number, alpha: number }} Mark
 *
 * Where shapes are.
 * @typedef {{ x: ArrayLike<number>, y: ArrayLike<number> }} Places
 *
 * @typedef {object} Options
 * @property {(index: number) => Mark} mark
 * @property {(index: number) => boolean} [first] puts shapes below the others
 * @property {() => Set<number>} [selection] the shapes that stand out, all where there are none
 * @property {number} [margin]
 * @property {string | null} [label]
 * @property {(marks: Marks) => void} [drawn] is called after every drawing, and may draw more
 */

const DURATION = 450;

/**
 * The map of a step or a class from the chunk "selection": shapes that took no part have no place.
 * @param {{ x: number[], y: number[] }} steps
 * @param {Pick<Chunk.Selection, "rows" | "coordinateSteps">} selection
 * @param {number} count
 */
export function mapOf({ x, y }, { rows, coordinateSteps }, count) {
  const map = { x: new Float64Array(count).fill(NaN), y: new Float64Array(count).fill(NaN) };
  for (let place = 0; place < x.length; place += 1) {
    const row = rows ? rows[place] : place;
    map.x[row] = x[place] / coordinateSteps;
    map.y[row] = y[place] / coordinateSteps;
  }
  return map;
}

export class Plot {
  #marks;

  /** @type {number | undefined} */
  #frame;
  view = { x: 0, y: 0, scale: 1, width: 0, height: 0 };

  /**
   * @param {Database} database
   * @param {Options} options
   */
  constructor(
    database,
    { mark, first = () => false, selection = () => NOBODY, margin = 8, label = null, drawn = () => {} },
  ) {
    this.database = database;
    this.mark = mark;
    this.first = first;
    this.selection = selection;
    this.margin = margin;
    this.drawn = drawn;
    this.#marks = new Marks({
      class: "few-plot",
      role: label === null ? null : "img",
      "aria-label": label,
      "aria-hidden": label === null ? "true" : null,
    });
    this.node = this.#marks.node;
    drawnAs(this.node, () => this.figure());
    /** @type {Places | null} */
    this.map = null;
    watchSize([this.node], () => this.draw());
  }

  /**
   * Show a map; shapes go there from where they are, unless that would be too much movement.
   * @param {Places} map
   * @param {{ travel?: boolean }} [how]
   */
  show(map, { travel = false } = {}) {
    if (this.#frame !== undefined) cancelAnimationFrame(this.#frame);
    const from = this.map;
    if (!travel || from === null || calm()) {
      this.map = map;
      this.draw();
      return;
    }
    const started = performance.now();
    const step = () => {
      const share = Math.min((performance.now() - started) / DURATION, 1);
      this.map = share < 1 ? between(from, map, 1 - (1 - share) ** 3) : map;
      this.draw();
      if (share < 1) this.#frame = requestAnimationFrame(step);
    };
    step();
  }

  /**
   * Where a shape is, in pixels.
   * @param {number} index
   */
  screen(index) {
    const { x, y, scale, width, height } = this.view;
    const map = /** @type {Places} */ (this.map);
    return [width / 2 + (map.x[index] - x) * scale, height / 2 - (map.y[index] - y) * scale];
  }

  /**
   * The shape at a point, or null.
   * @param {number} left
   * @param {number} top
   * @param {number} reach
   */
  at(left, top, reach) {
    /** @type {[number | null, number]} */
    let [best, least] = [null, reach];
    for (let index = 0; index < this.database.count; index += 1) {
      if (!this.map || Number.isNaN(this.map.x[index])) continue;
      const [x, y] = this.screen(index);
      const distance = Math.hypot(x - left, y - top);
      if (distance < least) [best, least] = [index, distance];
    }
    return best;
  }

  /**
   * The shapes whose place an area holds.
   * @param {(x: number, y: number) => boolean} holds
   */
  inside(holds) {
    return [...this.database.ids.keys()].filter((index) => {
      const [x, y] = this.screen(index);
      return holds(x, y);
    });
  }

  /**
   * Shapes from the lowest to the highest, with whether they are faded.
   * @returns {Generator<{ index: number, faded: boolean }>}
   */
  *#stacked() {
    const chosen = this.selection();
    const map = /** @type {Places} */ (this.map);
    /** @param {number} index */
    const layer = (index) => (chosen.size > 0 && !chosen.has(index) ? 0 : this.first(index) ? 1 : 2);
    for (const now of [0, 1, 2]) {
      for (let index = 0; index < this.database.count; index += 1)
        if (!Number.isNaN(map.x[index]) && layer(index) === now) yield { index, faded: now === 0 };
    }
  }

  /** The map as a drawing of SVG; null where there is none. */
  figure() {
    const { width, height } = this.view;
    if (this.map === null || width === 0) return null;
    const below = svg("g", { opacity: FADED });
    const above = svg("g");
    for (const { index, faded } of this.#stacked()) {
      const { path, color, radius, alpha } = this.mark(index);
      const mark = markAt(path, color, this.screen(index), radius, this.database.marks.outline);
      if (!faded) mark.setAttribute("opacity", String(alpha));
      (faded ? below : above).append(mark);
    }
    return { node: svg("svg", { viewBox: `0 0 ${width} ${height}` }, below, above) };
  }

  draw() {
    const { node, map, database } = this;
    const marks = this.#marks;
    const [width, height] = [node.clientWidth, node.clientHeight];
    if (map === null || width === 0 || height === 0) return;
    const extent = bounds(map);
    const scale = Math.min((width - 2 * this.margin) / extent.width, (height - 2 * this.margin) / extent.height);
    this.view = { x: extent.x, y: extent.y, scale, width, height };
    const { outline } = database.marks;
    marks.begin(width, height);
    let fading = false;
    for (const { index, faded } of this.#stacked()) {
      if (fading && !faded) marks.fade(FADED);
      fading = faded;
      const { path, color, radius, alpha } = this.mark(index);
      const [x, y] = this.screen(index);
      marks.lay(marks.stamp(path, color, radius, outline), x, y, faded ? 1 : alpha);
    }
    if (fading) marks.fade(FADED);
    marks.show();
    this.drawn(marks);
  }
}

/** @type {Set<number>} */
const NOBODY = new Set();

/**
 * A map as a small square picture, without the shapes of `hidden` classes.
 * @param {Database} database
 * @param {Places} map
 * @param {number} size
 * @param {Set<number>} [hidden]
 */
export function pictureOfMap(database, map, size, hidden = NOBODY) {
  const marks = new Marks({ class: "few-plot", "aria-hidden": "true" });
  const { x, y, width, height } = bounds(map);
  const scale = (size - 8) / Math.max(width, height);
  const radius = Math.min(Math.max(24 / Math.sqrt(database.count), 0.8), 2);
  marks.begin(size, size);
  for (let index = 0; index < database.count; index += 1) {
    const group = database.groups[index];
    if (Number.isNaN(map.x[index]) || hidden.has(group)) continue;
    const stamp = marks.stamp(database.data.marks.plain, database.color(group), radius);
    marks.lay(stamp, size / 2 + (map.x[index] - x) * scale, size / 2 - (map.y[index] - y) * scale, 1);
  }
  marks.show();
  return marks.node;
}

/**
 * @param {Places} from
 * @param {Places} to
 * @param {number} share
 */
function between(from, to, share) {
  /**
   * @param {ArrayLike<number>} a
   * @param {ArrayLike<number>} b
   */
  const mix = (a, b) =>
    Float64Array.from(b, (value, index) => (Number.isNaN(a[index]) ? value : a[index] + share * (value - a[index])));
  return { x: mix(from.x, to.x), y: mix(from.y, to.y) };
}
