// The marks of a map as pixels, where the chart would take too long: while they move, and where they are very many.
// They look as the chart draws them, so that nobody sees the one take over from the other.

import { element } from "../base/dom.js";
import { reachOf } from "../database/hit-range.js";
import { CHOSEN, FAINT, NORMAL } from "./scene.js";

const OPACITY = { [FAINT]: 0.14, [NORMAL]: 0.92, [CHOSEN]: 0.92 };

/** Among pictures, dots keep in the background. */
const OPACITY_AMONG_PICTURES = { [FAINT]: 0.14, [NORMAL]: 0.7, [CHOSEN]: 0.7 };

const SMALLEST_OUTLINED = 2.5;

/** Pictures and stamps beyond these are forgotten: a reader who zooms for long would fill the memory. */
const MOST_PICTURES_KEPT = 1500;
const MOST_STAMPS_KEPT = 400;

export class Dots {
  constructor(view) {
    this.view = view;
    this.node = element("canvas", { class: "dots", hidden: true, "aria-hidden": "true" });
    this.pen = this.node.getContext("2d");
    view.node.after(this.node);
  }

  draw() {
    const { view, pen } = this;
    const { scene, database, pictured } = view;
    const dense = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(view.width * dense), Math.round(view.height * dense)];
    if (this.node.width !== width || this.node.height !== height) {
      Object.assign(this.node, { width, height });
      this.image = pen.createImageData(width, height);
    } else this.image.data.fill(0);
    const among = view.name === "thumbnail";
    const { scale, left, top } = view.lay();
    const radius = view.markRadius * (among ? Math.sqrt(0.4) : 1);
    // From faint to chosen, so that nothing lies on what the reader looks for.
    for (const level of [FAINT, NORMAL, CHOSEN]) {
      const opacity = (among ? OPACITY_AMONG_PICTURES : OPACITY)[level];
      const reach = dense * radius * (level === CHOSEN ? Math.sqrt(1.5) : 1);
      const stamps = this.#stamps(reach);
      for (let index = 0; index < database.count; index += 1) {
        if (scene.emphasis[index] !== level || (among && pictured[index])) continue;
        const x = dense * (left + scene.x[index] * scale);
        const y = dense * (top - scene.y[index] * scale);
        if (x < -reach || y < -reach || x > width + reach || y > height + reach) continue;
        press(this.image, stamps(index), Math.round(x), Math.round(y), opacity);
      }
    }
    pen.putImageData(this.image, 0, 0);
    if (among) this.#drawPictures(dense);
    this.#show(true);
  }

  /** The chart shows the same again. */
  clear() {
    if (!this.node.hidden) this.#show(false);
  }

  #show(drawn) {
    this.node.hidden = !drawn;
    this.view.node.style.visibility = drawn ? "hidden" : "";
  }

  // Stamps

  #cut = new Map();

  /** The marks of shapes, `radius` pixels large: each kind is drawn once, for all shapes that are of it. */
  #stamps(radius) {
    const { view } = this;
    const { database, scene } = view;
    const { marks } = database;
    const { symbols, plain } = database.data.marks;
    const none = () => [plain, marks.unlabelled];
    const kinds = {
      class: [
        (index) => database.groups[index],
        (group) => (group < 0 ? none() : [symbols[group], marks.classes[group]]),
      ],
      hit: [
        (index) => reachOf(database, database.methods[scene.target], index),
        (reach) => (reach === null ? none() : [plain, shade(marks.hit, reach)]),
      ],
      thumbnail: [() => 0, none],
    };
    const [kindOf, look] = kinds[view.name];
    // On the smallest marks there would be more outline than colour.
    const outlined = view.name !== "thumbnail" && radius > SMALLEST_OUTLINED * (window.devicePixelRatio || 1);
    const found = new Map();
    return (index) => {
      const kind = kindOf(index);
      if (!found.has(kind)) found.set(kind, this.#stamp(...look(kind), radius, outlined ? marks.outline : null));
      return found.get(kind);
    };
  }

  #stamp(...how) {
    const key = how.join(" ");
    if (!this.#cut.has(key)) {
      if (this.#cut.size >= MOST_STAMPS_KEPT) this.#cut.clear();
      this.#cut.set(key, stamp(...how));
    }
    return this.#cut.get(key);
  }

  // Pictures

  #pictures = new Map();

  #drawPictures(dense) {
    const { view, pen } = this;
    const { scene, pictured } = view;
    const { scale, left, top } = view.lay();
    const side = view.pictureSize * dense;
    pen.imageSmoothingQuality = "high";
    for (const level of [FAINT, NORMAL, CHOSEN]) {
      pen.globalAlpha = level === FAINT ? OPACITY[FAINT] : 1;
      for (const [index, shown] of pictured.entries()) {
        if (!shown || scene.emphasis[index] !== level) continue;
        const picture = this.#picture(index);
        if (!picture.complete || picture.naturalWidth === 0) continue;
        const [x, y] = [dense * (left + scene.x[index] * scale), dense * (top - scene.y[index] * scale)];
        pen.drawImage(picture, x - side / 2, y - side / 2, side, side);
      }
    }
  }

  #picture(index) {
    if (!this.#pictures.has(index)) {
      if (this.#pictures.size >= MOST_PICTURES_KEPT) this.#pictures.clear();
      this.#pictures.set(
        index,
        element("img", {
          src: this.view.database.picture(index),
          decoding: "async",
          onload: () => this.view.scene.draw(),
        }),
      );
    }
    return this.#pictures.get(index);
  }
}

/** A mark as pixels. */
function stamp(path, color, radius, outline) {
  const mark = new Path2D(path);
  // Symbols reach a little beyond their radius.
  const half = Math.ceil(1.6 * radius + 1);
  const pen = element("canvas", { width: 2 * half, height: 2 * half }).getContext("2d", { willReadFrequently: true });
  pen.setTransform(radius, 0, 0, radius, half, half);
  pen.fillStyle = color;
  pen.fill(mark);
  if (outline !== null) {
    pen.strokeStyle = outline;
    pen.lineWidth = (0.6 * (window.devicePixelRatio || 1)) / radius;
    pen.stroke(mark);
  }
  const rim = margin(pen.getImageData(0, 0, 2 * half, 2 * half));
  const side = 2 * (half - rim);
  return pen.getImageData(rim, rim, side, side);
}

/** How many pixels about a stamp are empty on all sides. */
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

/** The colour of a neighbourhood hit, between those of the ramp. */
function shade(ramp, hit) {
  const place = hit * (ramp.length - 1);
  const low = Math.min(Math.floor(place), ramp.length - 2);
  return mixed(ramp[low], ramp[low + 1], place - low);
}

/** A colour between two, which are written as #rrggbb. */
function mixed(one, other, share) {
  const part = (color, at) => Number.parseInt(color.slice(at, at + 2), 16);
  return `rgb(${[1, 3, 5].map((at) => Math.round(part(one, at) + share * (part(other, at) - part(one, at)))).join(" ")})`;
}
