// The card at the pointer: picture, name, class, and who the neighbours are.

import { element, picture, swatch } from "../base/dom.js";
import { figure, shortened } from "../base/words.js";
import { highestOf, ofAtMost } from "../database/hit-range.js";

/** @import { State } from "../base/state.js" */
/** @import { Database, Method, ShapeMap } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Coloring } from "./coloring.js" */
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
      if (["theme", "by", "view", "color"].some((name) => changed.has(name))) this.shown = null;
      const camera = state.get("pointedFrom")?.scene.cameraName;
      if (["pointed", camera, "method", "theme"].some((name) => name !== undefined && changed.has(name))) this.#show();
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
    if (this.shown !== index || this.map !== map) this.#fill(index, view.database, map, view.chosenColoring);
    this.#place(index, view);
  }

  /**
   * @param {number} index
   * @param {Database} database
   * @param {Method} map
   * @param {Coloring | null} coloring what else the map tells
   */
  #fill(index, database, map, coloring) {
    [this.shown, this.map] = [index, map];
    const group = database.groups[index];
    const neighbours =
      database.count > 1 ? database.census(database.neighbours(index, database.methods.indexOf(map))) : [];
    this.node.replaceChildren(
      picture(database, index, 112),
      element(
        "div",
        {},
        element("p", { class: "name", dir: "auto" }, shortened(database.names[index], 48)),
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
              .map(
                ([other, number], place) =>
                  `${place > 0 ? ", " : ""}${number} ${shortened(database.className(other), 18)}`,
              ),
            neighbours.length > MOST_CLASSES && " …",
          ),
      ),
    );
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
    const right = box.left + x + gap;
    const left = right + width < window.innerWidth - 8 ? right : box.left + x - gap - width;
    const top = Math.min(Math.max(box.top + y - height / 2, 8), window.innerHeight - height - 8);
    this.node.style.transform = `translate(${Math.round(Math.max(left, 8))}px, ${Math.round(top)}px)`;
  }
}

/**
 * The mark and the name of a class.
 * @param {Database} database
 * @param {number} group
 */
export function classLine(database, group) {
  return element(
    "p",
    { class: "of-class", dir: "auto" },
    swatch(database.symbol(group), database.color(group)),
    shortened(database.className(group), 60),
  );
}
