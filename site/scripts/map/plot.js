// A map of shapes on one canvas: the Bins page shows dozens, each of few marks, and none needs more than a picture.

import { calm, element } from "../base/dom.js";
import { bounds } from "../database/database.js";

const DURATION = 450;

/** Opacity of a shape that is not selected while others are, as on all maps. */
const FAINT = 0.14;

/** The map of a step or a class from the chunk "selection": shapes that took no part have no place. */
export function mapOf({ x, y }, { rows, coordinateSteps }, count) {
  const map = { x: new Float64Array(count).fill(NaN), y: new Float64Array(count).fill(NaN) };
  for (let place = 0; place < x.length; place += 1) {
    const row = rows === null ? place : rows[place];
    map.x[row] = x[place] / coordinateSteps;
    map.y[row] = y[place] / coordinateSteps;
  }
  return map;
}

export class Plot {
  /**
   * `mark(index)` says how a shape is drawn: `{ color, path, radius, faint }`; `first(index)` puts shapes below the
   * others; `selection()` are the shapes that stand out, all where there are none; `drawn` is called after every drawing.
   */
  constructor(
    database,
    { mark, first = (_) => false, selection = () => NOBODY, margin = 8, label = null, drawn = () => {} },
  ) {
    this.database = database;
    this.mark = mark;
    this.first = first;
    this.selection = selection;
    this.margin = margin;
    this.drawn = drawn;
    this.node = element("canvas", {
      class: "few-plot",
      role: label === null ? null : "img",
      "aria-label": label,
      "aria-hidden": label === null ? "true" : null,
    });
    this.pen = this.node.getContext("2d");
    this.map = null;
    new ResizeObserver(() => this.draw()).observe(this.node);
  }

  /** Show a map; shapes go there from where they are, unless that would be too much movement. */
  show(map, { travel = false } = {}) {
    cancelAnimationFrame(this.#frame);
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

  #frame = null;

  /** Where a shape is, in pixels. */
  screen(index) {
    const { x, y, scale, width, height } = this.view;
    return [width / 2 + (this.map.x[index] - x) * scale, height / 2 - (this.map.y[index] - y) * scale];
  }

  /** The shape at a point, or null. */
  at(left, top, reach) {
    let [best, least] = [null, reach];
    for (let index = 0; index < this.database.count; index += 1) {
      if (Number.isNaN(this.map.x[index])) continue;
      const [x, y] = this.screen(index);
      const distance = Math.hypot(x - left, y - top);
      if (distance < least) [best, least] = [index, distance];
    }
    return best;
  }

  /** The shapes in a rectangle. */
  inside(left, top, right, bottom) {
    return [...this.database.ids.keys()].filter((index) => {
      const [x, y] = this.screen(index);
      return x >= left && x <= right && y >= top && y <= bottom;
    });
  }

  draw() {
    const { node, pen, map, database } = this;
    const [width, height] = [node.clientWidth, node.clientHeight];
    if (map === null || width === 0 || height === 0) return;
    const dense = window.devicePixelRatio || 1;
    Object.assign(node, { width: Math.round(width * dense), height: Math.round(height * dense) });
    const extent = bounds(map);
    const scale = Math.min((width - 2 * this.margin) / extent.width, (height - 2 * this.margin) / extent.height);
    this.view = { x: extent.x, y: extent.y, scale, width, height };
    pen.strokeStyle = database.marks.outline;
    const chosen = this.selection();
    const faint = (index) => chosen.size > 0 && !chosen.has(index);
    for (const below of [true, false]) {
      for (let index = 0; index < database.count; index += 1) {
        if (Number.isNaN(map.x[index]) || (this.first(index) || faint(index)) !== below) continue;
        const { color, path, radius, alpha } = this.mark(index);
        const [x, y] = this.screen(index);
        pen.setTransform(dense * radius, 0, 0, dense * radius, dense * x, dense * y);
        pen.globalAlpha = faint(index) ? FAINT : alpha;
        pen.fillStyle = color;
        const shape = pathOf(path);
        pen.fill(shape);
        if (radius < 2.5) continue;
        pen.lineWidth = 0.6 / radius;
        pen.stroke(shape);
      }
    }
    pen.setTransform(1, 0, 0, 1, 0, 0);
    this.drawn();
  }
}

const NOBODY = new Set();

const paths = new Map();

function pathOf(text) {
  if (!paths.has(text)) paths.set(text, new Path2D(text));
  return paths.get(text);
}

function between(from, to, share) {
  const mix = (a, b) =>
    b.map((value, index) => (Number.isNaN(a[index]) ? value : a[index] + share * (value - a[index])));
  return { x: mix(from.x, to.x), y: mix(from.y, to.y) };
}
