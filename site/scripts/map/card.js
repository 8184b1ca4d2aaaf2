// The card at the pointer: picture, name, class, and who the neighbours are.

import { element, picture, swatch } from "../base/dom.js";
import { capitalised, figure, numberWord, shortened } from "../base/words.js";
import { highestOf, ofAtMost } from "../database/hit-range.js";
import { partedNeighbours } from "./lines.js";

/** @import { State } from "../base/state.js" */
/** @import { Database, Method, ShapeMap } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Parted } from "./lines.js" */
/** @import { MapView } from "./map.js" */
/** @import { MapValues } from "./scene.js" */

const MOST_CLASSES = 4;

export class Card {
  /** @param {State<MapValues & Shared>} state */
  constructor(state) {
    this.state = state;
    this.node = document.getElementById("card");
    /** @type {number | null} */
    this.shown = null;
    /** @type {ShapeMap | null} */
    this.map = null;
    state.listen((changed) => {
      if (["theme", "by", "view", "color", "coloring", "alike"].some((name) => changed.has(name))) this.shown = null;
      const camera = state.get("pointedFrom")?.scene.cameraName;
      if (
        ["pointed", camera, "method", "theme", "coloring", "alike"].some(
          (name) => name !== undefined && changed.has(name),
        )
      )
        this.#show();
    });
  }

  #show() {
    /** @type {number | null} */
    const index = this.state.get("pointed");
    /** @type {MapView | null} */
    const view = this.state.get("pointedFrom");
    this.node.hidden = index === null || !view?.scene.visible(index);
    if (index === null || !view || this.node.hidden) return;
    const map = view.database.methods[view.scene.target];
    if (this.shown !== index || this.map !== map) this.#fill(index, view, map);
    this.#place(index, view);
  }

  /**
   * @param {number} index
   * @param {MapView} view
   * @param {Method} map
   */
  #fill(index, view, map) {
    const { database } = view;
    const coloring = view.chosenColoring && view.coloring;
    const parted = partedNeighbours(view, index);
    [this.shown, this.map] = [index, map];
    const group = database.groups[index];
    const neighbours =
      database.count > 1 ? database.census(database.neighbours(index, database.methods.indexOf(map))) : [];
    this.node.replaceChildren(
      picture(database, index, 112),
      element(
        "div",
        {},
        element("p", { class: "name", dir: "auto" }, shortened(database.names.at(index), 48)),
        database.labelled && classLine(database, group),
        coloring &&
          element("p", {}, `${coloring.title}: `, element("b", { dir: "auto" }, shortened(coloring.textOf(index), 60))),
        map.hit[index] !== null &&
          element("p", {}, "NH ", element("b", {}, figure(map.hit[index])), ofAtMost(highestOf(database, map, index))),
        neighbours.length > 0 &&
          database.labelled &&
          element(
            "p",
            { class: "census" },
            "near it: ",
            neighbours
              .slice(0, MOST_CLASSES)
              .map(([other, number], place) => [
                `${place > 0 ? ", " : ""}${number} `,
                element("bdi", {}, shortened(database.className(other), 18)),
              ]),
            neighbours.length > MOST_CLASSES && " …",
          ),
        parted !== null && parted.missing.length + parted.kept.length > 0 && element("p", {}, missingWords(parted)),
      ),
    );
  }

  /**
   * Whether more of the lines from a shape lead to the right than to the left.
   * @param {number} index
   * @param {MapView} view
   */
  #covers(index, view) {
    const parted = this.state.get("lines") ? partedNeighbours(view, index) : null;
    const [x] = view.screen(index);
    const ends = Object.values(parted ?? {}).flat();
    return ends.filter((other) => view.screen(other)[0] > x).length > ends.length / 2;
  }

  /**
   * @param {number} index
   * @param {MapView} view
   */
  #place(index, view) {
    const box = view.surface.getBoundingClientRect();
    const [x, y] = view.screen(index);
    const { offsetWidth: width, offsetHeight: height } = this.node;
    const gap = Math.max(view.markRadius, view.pictured[index] ? view.pictureSize / 2 : 0) + 12;
    const [right, back] = [box.left + x + gap, box.left + x - gap - width];
    const fits = right + width < window.innerWidth - 8;
    const left = fits && !(back > 8 && this.#covers(index, view)) ? right : back;
    const top = Math.min(Math.max(box.top + y - height / 2, 8), window.innerHeight - height - 8);
    this.node.style.transform = `translate(${Math.round(Math.max(left, 8))}px, ${Math.round(top)}px)`;
  }
}

/**
 * How many of those most alike to a shape are elsewhere on the map.
 * @param {Parted} parted
 */
export function missingWords({ kept, missing }) {
  const all = kept.length + missing.length;
  const alike = all === 1 ? "The shape most alike" : `the ${numberWord(all)} most alike`;
  if (all === 1) return `${alike} is ${missing.length === 0 ? "near it" : "elsewhere on the map"}.`;
  if (missing.length === 0) return `All of ${alike} are near it.`;
  if (kept.length === 0) return `All of ${alike} are elsewhere on the map.`;
  return `${capitalised(numberWord(missing.length))} of ${alike} ${missing.length === 1 ? "is" : "are"} elsewhere on the map.`;
}

/**
 * The mark and the name of a class.
 * @param {Database} database
 * @param {number} group
 */
export function classLine(database, group) {
  return element(
    "p",
    { class: "of-class" },
    swatch(database.symbol(group), database.color(group)),
    element("bdi", {}, shortened(database.className(group), 60)),
  );
}
