// The marks of a linked map where its chart would take too long: while they move, and where they are very many.

import { element } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { reachOf } from "../database/hit-range.js";
import { FADED, FULL, Marks } from "./marks.js";
import { CHOSEN, FAINT, NORMAL } from "./scene.js";

/** @import { MapView } from "./map.js" */
/** @import { Emphasis } from "./scene.js" */

/** From faint to chosen, so that nothing lies on what the reader looks for. */
/** @type {Emphasis[]} */
const LEVELS = [FAINT, NORMAL, CHOSEN];

/** Among pictures, dots keep in the background. */
const FULL_AMONG_PICTURES = 0.7;

/** Pictures beyond these are forgotten: a reader who zooms for long would fill the memory. */
const MOST_PICTURES_KEPT = 1500;

export class Dots {
  #marks = new Marks({ class: "dots", hidden: true, "aria-hidden": "true" });
  /** @type {Map<number, HTMLImageElement>} */
  #pictures = new Map();

  /** @param {MapView} view */
  constructor(view) {
    this.view = view;
    view.node.after(this.#marks.node);
  }

  draw() {
    const { view } = this;
    const among = view.name === "thumbnail";
    this.#marks.begin(view.width, view.height);
    const radius = view.markRadius * (among ? Math.sqrt(0.4) : 1);
    for (const level of LEVELS) {
      const full = among ? FULL_AMONG_PICTURES : FULL;
      const stampOf = this.#stamps(radius * (level === CHOSEN ? Math.sqrt(1.5) : 1));
      for (const [index, place] of this.#placesAt(level, radius)) {
        if (among && view.pictured[index]) continue;
        this.#marks.lay(stampOf(index), place, level === FAINT ? FADED : full);
      }
    }
    this.#marks.show();
    if (among) this.#drawPictures();
    this.#show(true);
  }

  /** The chart shows the same again. */
  clear() {
    if (!this.#marks.node.hidden) this.#show(false);
  }

  /** @param {boolean} drawn */
  #show(drawn) {
    this.#marks.node.hidden = !drawn;
    this.view.node.style.visibility = drawn ? "hidden" : "";
  }

  /**
   * The shapes of a level of emphasis that are in view, each with its place.
   * @returns {Generator<[number, [number, number]]>}
   * @param {Emphasis} level
   * @param {number} reach
   */
  *#placesAt(level, reach) {
    const { scene, width, height } = this.view;
    const { scale, left, top } = this.view.lay();
    for (let index = 0; index < scene.x.length; index += 1) {
      if (scene.emphasis[index] !== level) continue;
      const [x, y] = [left + scene.x[index] * scale, top - scene.y[index] * scale];
      if (x < -reach || y < -reach || x > width + reach || y > height + reach) continue;
      yield [index, [x, y]];
    }
  }

  /**
   * The stamp of a shape: each kind is looked up once, for all shapes that are of it.
   * @param {number} radius
   * @returns {(index: number) => ImageData}
   */
  #stamps(radius) {
    const { view } = this;
    const { database, scene } = view;
    const { marks } = database;
    const { symbols, plain } = database.data.marks;
    /** @returns {[string, string]} */
    const none = () => [plain, marks.unlabelled];
    /** @type {Record<MapView["name"], [(index: number) => number | null, (kind: any) => [string, string]]>} */
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
    const outline = view.name === "thumbnail" ? null : marks.outline;
    /** @type {Map<number | null, ImageData>} */
    const found = new Map();
    return (index) => {
      const kind = kindOf(index);
      return entry(found, kind, () => this.#marks.stamp(...look(kind), radius, outline));
    };
  }

  #drawPictures() {
    const { pictured, pictureSize } = this.view;
    for (const level of LEVELS) {
      for (const [index, place] of this.#placesAt(level, pictureSize)) {
        if (!pictured[index]) continue;
        const picture = this.#picture(index);
        if (!picture.complete || picture.naturalWidth === 0) continue;
        this.#marks.picture(picture, place, pictureSize, level === FAINT ? FADED : 1);
      }
    }
  }

  /** @param {number} index */
  #picture(index) {
    if (this.#pictures.size >= MOST_PICTURES_KEPT && !this.#pictures.has(index)) this.#pictures.clear();
    return entry(this.#pictures, index, () =>
      element("img", {
        src: this.view.database.picture(index),
        decoding: "async",
        onload: () => this.view.scene.draw(),
      }),
    );
  }
}

/**
 * The colour of a neighbourhood hit, between those of the ramp.
 * @param {string[]} ramp
 * @param {number} hit
 */
function shade(ramp, hit) {
  const place = hit * (ramp.length - 1);
  const low = Math.min(Math.floor(place), ramp.length - 2);
  return mixed(ramp[low], ramp[low + 1], place - low);
}

/**
 * A colour between two, which are written as #rrggbb.
 * @param {string} one
 * @param {string} other
 * @param {number} share
 */
function mixed(one, other, share) {
  /**
   * @param {string} color
   * @param {number} at
   */
  const part = (color, at) => Number.parseInt(color.slice(at, at + 2), 16);
  return `rgb(${[1, 3, 5].map((at) => Math.round(part(one, at) + share * (part(other, at) - part(one, at)))).join(" ")})`;
}
