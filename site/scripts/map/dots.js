// The marks of a linked map where no chart draws them: on a map that begins without one, while they move, and where they
// are very many.

import { element } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { FADED, FULL, Marks, rgbaOf } from "./marks.js";
import { Pictures } from "./pictures.js";
import { Points } from "./points.js";
import { CHOSEN, crowded, FAINT, HIDDEN, NORMAL } from "./scene.js";

/** @import { Coloring, Look } from "./coloring.js" */
/** @import { MapView } from "./map.js" */
/** @import { Layer, Paint } from "./points.js" */

/** The level of a shape that nothing is known of, where very many of them would cover the others. */
const BARE = CHOSEN + 1;

/** From faint to chosen, so that nothing lies on what the reader looks for. */
const LEVELS = [FAINT, BARE, NORMAL, CHOSEN];

/** The size of a dot among pictures, of that of others; and of one that is chosen. */
const AMONG_PICTURES = Math.sqrt(0.6);
const STANDING_OUT = Math.sqrt(1.5);

const CLASS = "dots";

export class Dots {
  /** @type {Marks | Points} */
  #marks;

  /** @param {MapView} view */
  constructor(view) {
    this.view = view;
    this.pictures = new Pictures(view);
    this.node = element("div", { class: "drawn", hidden: true, "aria-hidden": "true" });
    const { database } = view;
    // To start WebGL takes longer than to draw few marks without it.
    const points = crowded(database)
      ? Points.made(database.count, { class: CLASS }, () => this.#draw(new Marks({ class: CLASS })))
      : null;
    this.#marks = points ?? new Marks({ class: CLASS });
    this.node.append(this.#marks.node, this.pictures.node);
    view.node.after(this.node);
  }

  /** @param {Marks} marks in place of those that are lost */
  #draw(marks) {
    this.#marks.node.replaceWith(marks.node);
    this.#marks = marks;
    this.draw();
  }

  draw() {
    const { levels, layers } = this.#layers();
    if (this.#marks instanceof Points) this.#drawPoints(this.#marks, levels, layers);
    else this.#drawMarks(this.#marks, levels, layers);
    this.pictures.draw();
    this.#show(true);
  }

  /** The marks as an image, which is drawn without WebGL: what that has drawn cannot be read later. */
  image() {
    const { levels, layers } = this.#layers();
    const marks = new Marks({});
    this.#drawMarks(marks, levels, layers);
    return marks.node.toDataURL();
  }

  /** How present each shape is that has a mark, and what is drawn of as present ones, from below. */
  #layers() {
    const { view } = this;
    const radius = view.markRadius * (view.name === "thumbnail" ? AMONG_PICTURES : 1);
    const bare = crowded(view.database) ? this.#looks().bare : [];
    const levels = view.scene.emphasis.map((level, index) =>
      view.pictured[index] ? HIDDEN : level === NORMAL && bare[index] ? BARE : level,
    );
    const layers = LEVELS.filter((level) => levels.includes(level)).map((level) => ({
      level,
      radius: radius * (level === CHOSEN ? STANDING_OUT : 1),
      faint: level === FAINT,
    }));
    return { levels, layers };
  }

  /**
   * @param {Points} points
   * @param {Uint8Array} levels
   * @param {Layer[]} layers
   */
  #drawPoints(points, levels, layers) {
    const { view } = this;
    const lay = { ...view.lay(), width: view.width, height: view.height };
    points.draw(view.scene, levels, layers, this.#looks().paint, view.database.marks.outline, lay);
  }

  /**
   * @param {Marks} marks
   * @param {Uint8Array} levels
   * @param {Layer[]} layers
   */
  #drawMarks(marks, levels, layers) {
    const { coloring, database, width, height } = this.view;
    marks.begin(width, height);
    for (const { level, radius, faint } of layers) {
      /** @type {Map<number | null, ImageData>} each kind is looked up once, for all shapes that are of it */
      const stamps = new Map();
      this.view.each((index, x, y) => {
        if (levels[index] !== level || x < -radius || y < -radius || x > width + radius || y > height + radius) return;
        const kind = coloring.kindOf(index);
        const stamp = entry(stamps, kind, () => {
          const { symbol, color } = coloring.look(kind);
          return marks.stamp(symbol, color, radius, database.marks.outline);
        });
        marks.lay(stamp, x, y, faint ? 1 : FULL);
      });
      if (faint) marks.fade(FADED);
    }
    marks.show();
  }

  /** @type {{ key: string, coloring: Coloring | null, paint: Paint, bare: Uint8Array } | null} */
  #known = null;

  /** How the marks look, as WebGL takes it, and of which shapes nothing is known. */
  #looks() {
    const { name, scene, database, theme, chosenColoring } = this.view;
    const key = [name, scene.target, database.revision, theme].join(" ");
    if (this.#known?.key !== key || this.#known.coloring !== chosenColoring)
      this.#known = { key, coloring: chosenColoring, ...this.#mix(this.view.coloring) };
    return this.#known;
  }

  /** @param {Coloring} coloring */
  #mix({ kindOf, look }) {
    const { count } = this.view.database;
    /** @type {Map<string, number>} */
    const symbols = new Map();
    /** @param {Look} look */
    const mixed = ({ symbol, color }) => {
      const [red, green, blue] = rgbaOf(color);
      return new Uint32Array(
        Uint8Array.of(
          red,
          green,
          blue,
          entry(symbols, symbol, () => symbols.size),
        ).buffer,
      )[0];
    };
    /** @type {Map<number | null, number>} */
    const kinds = new Map();
    const [paint, bare] = [new Uint32Array(count), new Uint8Array(count)];
    for (let index = 0; index < count; index += 1) {
      const kind = kindOf(index);
      let known = kinds.get(kind);
      if (known === undefined) {
        known = mixed(look(kind));
        kinds.set(kind, known);
      }
      paint[index] = known;
      bare[index] = Number(kind === null);
    }
    return { paint: { paint: new Uint8Array(paint.buffer), symbols: [...symbols.keys()] }, bare };
  }

  /** The chart shows the same again. */
  clear() {
    if (!this.node.hidden) this.#show(false);
  }

  /** @param {boolean} drawn */
  #show(drawn) {
    this.node.hidden = !drawn;
    this.view.node.style.visibility = drawn ? "hidden" : "";
  }
}
