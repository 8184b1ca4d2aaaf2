// A map of shapes on one canvas: the Bins page shows dozens, each of few marks, and none needs more than a picture.

import { calm, svg, watchSize } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { drawnAs } from "../base/snapshot.js";
import { bounds } from "../database/database.js";
import { MOST_SHAPES, markAt } from "./figure.js";
import { FADED, LINE, LINES, Marks, RING } from "./marks.js";

/** @import { Database } from "../database/database.js" */

/**
 * How a shape is drawn.
 * @typedef {{ path: string, color: string, radius: number, alpha: number }} Mark
 *
 * Where shapes are: all of them, with no numbers for who has no place, or those of `rows` in their order.
 * @typedef {{ x: ArrayLike<number>, y: ArrayLike<number>, rows?: ArrayLike<number> | null }} Places
 *
 * @typedef {object} Options
 * @property {(index: number) => Mark} mark
 * @property {(index: number) => boolean} [first] puts shapes below the others
 * @property {() => Set<number>} [selection] the shapes that stand out, all where there are none
 * @property {number} [margin]
 * @property {number} [most] of more shapes than this a drawing is a picture
 * @property {string | null} [label]
 * @property {(over: Over) => void} [drawn] is called after every drawing, and may draw more
 *
 * What draws over marks.
 * @typedef {Pick<Marks, "ring" | "tie">} Over
 */

const DURATION = 450;

/** As fine as a sheet of paper shows it. */
const PRINTED = 3;

/**
 * The map of a step or a class from the chunk "selection", of the shapes that took part.
 * @param {{ x: number[], y: number[] }} steps
 * @param {Pick<Chunk.Selection, "rows" | "coordinateSteps">} selection
 */
export function mapOf({ x, y }, { rows, coordinateSteps }) {
  return {
    x: Float64Array.from(x, (step) => step / coordinateSteps),
    y: Float64Array.from(y, (step) => step / coordinateSteps),
    rows: rows ?? null,
  };
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
    {
      mark,
      first = () => false,
      selection = () => NOBODY,
      margin = 8,
      most = MOST_SHAPES,
      label = null,
      drawn = () => {},
    },
  ) {
    this.database = database;
    this.mark = mark;
    this.first = first;
    this.selection = selection;
    this.margin = margin;
    this.most = most;
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
   * Where a shape is, in pixels; no numbers where it has no place.
   * @param {number} index
   */
  screen(index) {
    return this.#at(placeOf(/** @type {Places} */ (this.map), index));
  }

  /** @param {number} place */
  #at(place) {
    const { x, y, scale, width, height } = this.view;
    const map = /** @type {Places} */ (this.map);
    return [width / 2 + (map.x[place] - x) * scale, height / 2 - (map.y[place] - y) * scale];
  }

  /**
   * The shapes on the map, and where they are in pixels.
   * @returns {{ index: number, x: number, y: number }[]}
   */
  placed() {
    const { map } = this;
    if (map === null) return [];
    return Array.from({ length: map.x.length }, (_, place) => {
      const [x, y] = this.#at(place);
      return { index: map.rows ? map.rows[place] : place, x, y };
    }).filter(({ x }) => !Number.isNaN(x));
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
    for (const { index, x, y } of this.placed()) {
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
    return this.placed().flatMap(({ index, x, y }) => (holds(x, y) ? [index] : []));
  }

  /**
   * Shapes from the lowest to the highest, with whether they are faded.
   * @returns {Generator<{ shape: { index: number, x: number, y: number }, faded: boolean }>}
   */
  *#stacked() {
    const chosen = this.selection();
    const placed = this.placed();
    /** @param {number} index */
    const layer = (index) => (chosen.size > 0 && !chosen.has(index) ? 0 : this.first(index) ? 1 : 2);
    for (const now of [0, 1, 2])
      for (const shape of placed) if (layer(shape.index) === now) yield { shape, faded: now === 0 };
  }

  /** The map as a drawing of SVG; null where there is none. */
  figure() {
    const { width, height } = this.view;
    if (this.map === null || width === 0) return null;
    const viewBox = `0 0 ${width} ${height}`;
    if (this.map.x.length > this.most) {
      const marks = new Marks({});
      this.#paint(marks, PRINTED);
      const image = svg("image", { width, height, href: marks.node.toDataURL() });
      return { node: svg("svg", { viewBox }, image, this.#over()) };
    }
    const below = svg("g", { opacity: FADED });
    const above = svg("g");
    for (const { shape, faded } of this.#stacked()) {
      const { path, color, radius, alpha } = this.mark(shape.index);
      const mark = markAt(path, color, [shape.x, shape.y], radius, this.database.marks.outline);
      if (!faded) mark.setAttribute("opacity", String(alpha));
      (faded ? below : above).append(mark);
    }
    return { node: svg("svg", { viewBox }, below, above, this.#over()) };
  }

  /** What is drawn over the marks. */
  #over() {
    const node = svg("g", { fill: "none" });
    this.drawn({
      ring([cx, cy], r, stroke) {
        node.append(svg("circle", { cx, cy, r, stroke, "stroke-width": RING }));
      },
      tie(from, others, stroke) {
        const d = others.map((other) => `M${from}L${other}`).join("");
        node.append(svg("path", { d, stroke, "stroke-width": LINE, opacity: LINES }));
      },
    });
    return node;
  }

  draw() {
    const { node, map } = this;
    const [width, height] = [node.clientWidth, node.clientHeight];
    if (map === null || width === 0 || height === 0) return;
    const extent = bounds(map);
    const scale = Math.min((width - 2 * this.margin) / extent.width, (height - 2 * this.margin) / extent.height);
    this.view = { x: extent.x, y: extent.y, scale, width, height };
    this.#paint(this.#marks);
    this.drawn(this.#marks);
  }

  /**
   * @param {Marks} marks
   * @param {number} [density]
   */
  #paint(marks, density) {
    const { outline } = this.database.marks;
    marks.begin(this.view.width, this.view.height, density);
    let fading = false;
    for (const { shape, faded } of this.#stacked()) {
      if (fading && !faded) marks.fade(FADED);
      fading = faded;
      const { path, color, radius, alpha } = this.mark(shape.index);
      marks.lay(marks.stamp(path, color, radius, outline), shape.x, shape.y, faded ? 1 : alpha);
    }
    if (fading) marks.fade(FADED);
    marks.show();
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
  const radius = Math.min(Math.max(24 / Math.sqrt(map.x.length), 0.8), 2);
  /** @type {Map<number, ImageData>} each looked up once, for all shapes of a class */
  const stamps = new Map();
  marks.begin(size, size);
  for (let place = 0; place < map.x.length; place += 1) {
    const group = database.groups[map.rows ? map.rows[place] : place];
    if (Number.isNaN(map.x[place]) || hidden.has(group)) continue;
    const stamp = entry(stamps, group, () => marks.stamp(database.data.marks.plain, database.color(group), radius));
    marks.lay(stamp, size / 2 + (map.x[place] - x) * scale, size / 2 - (map.y[place] - y) * scale, 1);
  }
  marks.show();
  return marks.node;
}

/** @type {WeakMap<object, Map<number, number>>} */
const places = new WeakMap();

/**
 * Where a shape stands among those of a map; nowhere, -1, if it is not there.
 * @param {Places} map
 * @param {number} index
 */
function placeOf({ rows }, index) {
  if (!rows) return index;
  const own = entry(places, rows, () => new Map(Array.from(rows, (row, place) => [row, place])));
  return own.get(index) ?? -1;
}

/**
 * Two maps of the same shapes, and what lies between them.
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
  return { x: mix(from.x, to.x), y: mix(from.y, to.y), rows: to.rows };
}
