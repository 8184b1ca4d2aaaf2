// The marks of a linked map where no chart draws them: on a map that begins without one, while they move, and where they
// are very many.

import { element } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { FADED, FULL, Marks } from "./marks.js";
import { Pictures } from "./pictures.js";
import { CHOSEN, FAINT, NORMAL } from "./scene.js";

/** @import { MapView } from "./map.js" */
/** @import { Emphasis } from "./scene.js" */

/** From faint to chosen, so that nothing lies on what the reader looks for. */
/** @type {Emphasis[]} */
const LEVELS = [FAINT, NORMAL, CHOSEN];

/** The size of a dot among pictures, of that of others. */
const AMONG_PICTURES = Math.sqrt(0.6);

export class Dots {
  #marks = new Marks({ class: "dots" });

  /** @param {MapView} view */
  constructor(view) {
    this.view = view;
    this.pictures = new Pictures(view);
    this.node = element("div", { class: "drawn", hidden: true, "aria-hidden": "true" });
    this.node.append(this.#marks.node, this.pictures.node);
    view.node.after(this.node);
  }

  draw() {
    const { view } = this;
    const among = view.name === "thumbnail";
    this.#marks.begin(view.width, view.height);
    const radius = view.markRadius * (among ? AMONG_PICTURES : 1);
    for (const level of LEVELS) {
      const stampOf = this.#stamps(radius * (level === CHOSEN ? Math.sqrt(1.5) : 1));
      let laid = false;
      for (const [index, place] of this.#placesAt(level, radius)) {
        if (view.pictured[index]) continue;
        this.#marks.lay(stampOf(index), place, level === FAINT ? 1 : FULL);
        laid = true;
      }
      if (level === FAINT && laid) this.#marks.fade(FADED);
    }
    this.#marks.show();
    this.pictures.draw();
    this.#show(true);
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

  /**
   * The shapes of a level of emphasis that are in view, each with its place.
   * @returns {Generator<[number, number[]]>}
   * @param {Emphasis} level
   * @param {number} reach
   */
  *#placesAt(level, reach) {
    const { scene, width, height } = this.view;
    const placeOf = this.view.placing();
    for (let index = 0; index < scene.x.length; index += 1) {
      if (scene.emphasis[index] !== level) continue;
      const place = placeOf(index);
      const [x, y] = place;
      if (x < -reach || y < -reach || x > width + reach || y > height + reach) continue;
      yield [index, place];
    }
  }

  /**
   * The stamp of a shape: each kind is looked up once, for all shapes that are of it.
   * @param {number} radius
   * @returns {(index: number) => ImageData}
   */
  #stamps(radius) {
    const { coloring, database } = this.view;
    /** @type {Map<number | null, ImageData>} */
    const found = new Map();
    return (index) => {
      const kind = coloring.kindOf(index);
      return entry(found, kind, () => {
        const { symbol, color } = coloring.look(kind);
        return this.#marks.stamp(symbol, color, radius, database.marks.outline);
      });
    };
  }
}
