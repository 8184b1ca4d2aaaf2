// The pictures of shapes as marks of a map, each on a ground of its colour. They are elements, which browsers move without
// drawing them anew and scale down better than a canvas does.

import { element } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { CHOSEN, FAINT } from "./scene.js";

/** @import { Sheets } from "../database/sheets.js" */
/** @import { MapView } from "./map.js" */

export class Pictures {
  // The faint ones are one layer of one opacity: where they lie on each other they stay faint.
  #faint = element("div", { class: "faint" });
  #present = element("div", {});
  #chosen = element("div", {});
  /** @type {Map<number, HTMLElement>} */
  #shown = new Map();

  /** @param {MapView} view */
  constructor(view) {
    this.view = view;
    this.node = element("div", { class: "pictures", "aria-hidden": "true" }, this.#faint, this.#present, this.#chosen);
  }

  draw() {
    const { view } = this;
    const { scene, pictured, pictureSize: size, width, height, coloring } = view;
    const placeOf = view.placing();
    this.node.style.setProperty("--size", `${size}px`);
    const left = new Set(this.#shown.keys());
    for (let index = 0; index < pictured.length; index += 1) {
      if (!pictured[index] || !scene.visible(index)) continue;
      const [x, y] = placeOf(index);
      if (x < -size || y < -size || x > width + size || y > height + size) continue;
      left.delete(index);
      const node = entry(this.#shown, index, () => this.#picture(index));
      node.style.transform = `translate(${x - size / 2}px, ${y - size / 2}px)`;
      node.style.setProperty("--mark", coloring.look(coloring.kindOf(index)).color);
      const emphasis = scene.emphasis[index];
      const layer = emphasis === FAINT ? this.#faint : emphasis === CHOSEN ? this.#chosen : this.#present;
      if (node.parentNode !== layer) layer.append(node);
    }
    for (const index of left) {
      this.#shown.get(index)?.remove();
      this.#shown.delete(index);
    }
  }

  /** @param {number} index */
  #picture(index) {
    return element("div", { class: "pictured", "data-shape": index }, this.#image(index));
  }

  /** @param {number} index */
  #image(index) {
    const { database, scene } = this.view;
    if (database.sheets) return cutOut(database.sheets, database.methods[scene.target].key, index);
    const image = element("img", { alt: "", decoding: "async", draggable: "false" });
    database.pictures.show(image, index);
    return image;
  }
}

/**
 * A picture of a sheet.
 * @param {Sheets} sheets
 * @param {string} key of the map
 * @param {number} index
 */
function cutOut(sheets, key, index) {
  const { address, column, line } = sheets.cut(key, index);
  const [x, y] = [column, line].map((place) => (100 * place) / (sheets.across - 1));
  const node = element("i");
  node.style.background = `url("${address}") ${x}% ${y}% / ${100 * sheets.across}%`;
  return node;
}
