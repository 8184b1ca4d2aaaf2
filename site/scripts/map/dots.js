// The marks of a linked map where its chart would take too long: while they move, and where they are very many.

import { element } from "../base/dom.js";
import { reachOf } from "../database/hit-range.js";
import { FADED, FULL, Marks } from "./marks.js";
import { CHOSEN, FAINT, NORMAL } from "./scene.js";

/** From faint to chosen, so that nothing lies on what the reader looks for. */
const LEVELS = [FAINT, NORMAL, CHOSEN];

/** Among pictures, dots keep in the background. */
const FULL_AMONG_PICTURES = 0.7;

/** Pictures beyond these are forgotten: a reader who zooms for long would fill the memory. */
const MOST_PICTURES_KEPT = 1500;

export class Dots {
  #marks = new Marks({ class: "dots", hidden: true, "aria-hidden": "true" });
  #pictures = new Map();

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

  #show(drawn) {
    this.#marks.node.hidden = !drawn;
    this.view.node.style.visibility = drawn ? "hidden" : "";
  }

  /**
   * The shapes of a level of emphasis that are in view, each with its place.
   * @returns {Generator<[number, [number, number]]>}
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

  /** The stamp of a shape: each kind is looked up once, for all shapes that are of it. */
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
    const outline = view.name === "thumbnail" ? null : marks.outline;
    const found = new Map();
    return (index) => {
      const kind = kindOf(index);
      if (!found.has(kind)) {
        const [path, color] = look(kind);
        found.set(kind, this.#marks.stamp(path, color, radius, outline));
      }
      return found.get(kind);
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
