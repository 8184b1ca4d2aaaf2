// Marks of shapes on a canvas, for all that Vega-Lite does not draw or would take too long for. They look as charts draw
// them, so that nobody sees the one take over from the other.

import { element, penOf } from "../base/dom.js";
import { entry } from "../base/entry.js";

/** Opacity of marks, and of those that others stand out from. */
export const FULL = 0.92;
export const FADED = 0.14;

/** On smaller marks there would be more outline than colour. */
export const SMALLEST_OUTLINED = 2.5;
export const OUTLINE = 0.6;

/** Beyond so many pixels stamps are forgotten: a reader who zooms for long would fill the memory. */
const MOST_PIXELS_KEPT = 2_000_000;

/** Rings and lines over marks: in pixels of the page, and how present lines are. */
export const RING = 2.5;
export const LINE = 1;
export const LINES = 0.6;

export class Marks {
  /**
   * All sizes and places are in pixels of the page.
   * @param {Attributes} attributes of the canvas
   */
  constructor(attributes) {
    this.node = element("canvas", attributes);
    this.pen = penOf(this.node);
    this.density = 1;
    /** @type {ImageData | null} */
    this.sheet = null;
  }

  /**
   * Begin a drawing of this size.
   * @param {number} width
   * @param {number} height
   * @param {number} [density] pixels of the drawing to one of the page
   */
  begin(width, height, density = window.devicePixelRatio || 1) {
    this.density = density;
    const [wide, high] = [Math.round(width * this.density), Math.round(height * this.density)];
    if (this.node.width !== wide || this.node.height !== high) Object.assign(this.node, { width: wide, height: high });
    this.sheet = emptySheet(wide, high);
  }

  /**
   * A mark to be laid anywhere: a symbol in a colour, with an outline of another or of none.
   * @param {string} path
   * @param {string} color
   * @param {number} radius
   * @param {string | null} [outline]
   */
  stamp(path, color, radius, outline = null) {
    // In steps that nobody sees, or marks that grow would need a stamp for every frame.
    const size = Math.max(Math.round(4 * radius * this.density), 1) / 4;
    return stampOf(path, color, size, radius >= SMALLEST_OUTLINED ? outline : null, OUTLINE * this.density);
  }

  /**
   * Lay a mark with its centre at a place; above those laid before.
   * @param {ImageData} stamp
   * @param {number} x
   * @param {number} y
   * @param {number} opacity
   */
  lay(stamp, x, y, opacity) {
    press(
      /** @type {ImageData} */ (this.sheet),
      stamp,
      Math.round(x * this.density),
      Math.round(y * this.density),
      opacity,
    );
  }

  /**
   * Make all that was laid fainter, as one layer: marks that lie on each other are then no darker than one.
   * @param {number} opacity
   */
  fade(opacity) {
    const { data } = /** @type {ImageData} */ (this.sheet);
    for (let alpha = 3; alpha < data.length; alpha += 4) data[alpha] *= opacity;
  }

  /** Show what was laid. What follows is drawn above it. */
  show() {
    this.pen.resetTransform();
    this.pen.putImageData(/** @type {ImageData} */ (this.sheet), 0, 0);
    this.sheet = null;
    this.pen.scale(this.density, this.density);
  }

  /**
   * A ring about a mark.
   * @param {number[]} place
   * @param {number} radius
   * @param {string} color
   */
  ring([x, y], radius, color) {
    const { pen } = this;
    Object.assign(pen, { globalAlpha: 1, lineWidth: RING, strokeStyle: color });
    pen.beginPath();
    pen.arc(x, y, radius, 0, 7);
    pen.stroke();
  }

  /**
   * Lines from one mark to others.
   * @param {number[]} from
   * @param {number[][]} others
   * @param {string} color
   */
  tie(from, others, color) {
    const { pen } = this;
    Object.assign(pen, { globalAlpha: LINES, lineWidth: LINE, strokeStyle: color });
    pen.beginPath();
    for (const other of others) {
      pen.moveTo(from[0], from[1]);
      pen.lineTo(other[0], other[1]);
    }
    pen.stroke();
  }
}

/** @type {Map<string, Uint8ClampedArray>} */
const parts = new Map();

/**
 * Red, green, blue and opacity of a colour as styles write it, each from 0 to 255.
 * @param {string} color
 */
export function rgbaOf(color) {
  return entry(parts, color, () => {
    pad ??= penOf(element("canvas"), { willReadFrequently: true });
    Object.assign(pad.canvas, { width: 1, height: 1 });
    pad.fillStyle = color;
    pad.fillRect(0, 0, 1, 1);
    return pad.getImageData(0, 0, 1, 1).data;
  });
}

// A drawing is begun and shown at once, so all share the memory of one.
let memory = new Uint8ClampedArray(0);

/**
 * @param {number} width
 * @param {number} height
 */
function emptySheet(width, height) {
  const length = 4 * width * height;
  if (memory.length < length) memory = new Uint8ClampedArray(length);
  else memory.fill(0, 0, length);
  return new ImageData(memory.subarray(0, length), width, height);
}

/** @type {Map<string, ImageData>} */
const stamps = new Map();
let pixelsKept = 0;

/**
 * @param {string} path
 * @param {string} color
 * @param {number} radius
 * @param {string | null} outline
 * @param {number} line
 */
function stampOf(path, color, radius, outline, line) {
  const key = [path, color, radius, outline, line].join(" ");
  let stamp = stamps.get(key);
  if (stamp === undefined) {
    stamp = cut(path, color, radius, outline, line);
    pixelsKept += stamp.width ** 2;
    if (pixelsKept > MOST_PIXELS_KEPT) {
      stamps.clear();
      pixelsKept = stamp.width ** 2;
    }
    stamps.set(key, stamp);
  }
  return stamp;
}

/** Where stamps are drawn. */
/** @type {CanvasRenderingContext2D | null} */
let pad = null;

/**
 * A mark as pixels.
 * @param {string} path
 * @param {string} color
 * @param {number} radius
 * @param {string | null} outline
 * @param {number} line
 */
function cut(path, color, radius, outline, line) {
  const mark = new Path2D(path);
  // Symbols reach a little beyond their radius.
  const half = Math.ceil(1.6 * radius + 1);
  pad ??= penOf(element("canvas"), { willReadFrequently: true });
  Object.assign(pad.canvas, { width: 2 * half, height: 2 * half });
  pad.setTransform(radius, 0, 0, radius, half, half);
  pad.fillStyle = color;
  pad.fill(mark);
  if (outline !== null) {
    pad.strokeStyle = outline;
    pad.lineWidth = line / radius;
    pad.stroke(mark);
  }
  const rim = margin(pad.getImageData(0, 0, 2 * half, 2 * half));
  const side = 2 * (half - rim);
  return pad.getImageData(rim, rim, side, side);
}

/**
 * Symbols beside each other, each in the middle of a square: two bytes a pixel, how far the symbol covers it, and how far
 * its outline.
 * @param {string[]} symbols
 * @param {number} radius
 * @param {number} side
 * @param {number} line
 */
export function coverage(symbols, radius, side, line) {
  const width = side * symbols.length;
  const found = new Uint8Array(2 * width * side);
  for (const [part, how] of /** @type {const} */ (["fill", "stroke"]).entries()) {
    const pen = penOf(element("canvas", { width, height: side }), { willReadFrequently: true });
    for (const [place, symbol] of symbols.entries()) {
      pen.setTransform(radius, 0, 0, radius, (place + 0.5) * side, side / 2);
      pen.lineWidth = line / radius;
      pen[how](new Path2D(symbol));
    }
    const { data } = pen.getImageData(0, 0, width, side);
    for (let pixel = 0; pixel < width * side; pixel += 1) found[2 * pixel + part] = data[4 * pixel + 3];
  }
  return found;
}

/**
 * How many pixels about a stamp are empty on all sides.
 * @param {ImageData} stamp
 */
function margin({ data, width }) {
  let least = width / 2 - 1;
  for (let place = 0; place < width * width; place += 1) {
    if (data[4 * place + 3] === 0) continue;
    const [x, y] = [place % width, Math.floor(place / width)];
    least = Math.min(least, x, y, width - 1 - x, width - 1 - y);
  }
  return least;
}

/**
 * Lay a stamp over an image. By hand, because this is done ten thousand times a frame: a canvas takes tens of
 * milliseconds to draw as many little pictures, and this takes a few.
 * @param {ImageData} image
 * @param {ImageData} stamp
 * @param {number} x
 * @param {number} y
 * @param {number} opacity
 */
function press({ data: below, width, height }, { data: above, width: side }, x, y, opacity) {
  const [left, top] = [x - side / 2, y - side / 2];
  const firstRow = Math.max(-top, 0);
  const lastRow = Math.min(height - top, side);
  const firstColumn = Math.max(-left, 0);
  const lastColumn = Math.min(width - left, side);
  for (let row = firstRow; row < lastRow; row += 1) {
    let from = 4 * (row * side + firstColumn);
    let to = 4 * ((top + row) * width + left + firstColumn);
    for (let column = firstColumn; column < lastColumn; column += 1, from += 4, to += 4) {
      const alpha = above[from + 3] * opacity;
      if (alpha === 0) continue;
      if (below[to + 3] === 0) {
        below[to] = above[from];
        below[to + 1] = above[from + 1];
        below[to + 2] = above[from + 2];
        below[to + 3] = alpha;
        continue;
      }
      const rest = (below[to + 3] * (255 - alpha)) / 255;
      const all = alpha + rest;
      below[to] = (above[from] * alpha + below[to] * rest) / all;
      below[to + 1] = (above[from + 1] * alpha + below[to + 1] * rest) / all;
      below[to + 2] = (above[from + 2] * alpha + below[to + 2] * rest) / all;
      below[to + 3] = all;
    }
  }
}
