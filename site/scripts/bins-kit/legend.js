// The ten colours of a descriptor's values, with the values between them and the range of one bin marked.

import { element } from "../base/dom.js";
import { measured } from "../base/words.js";

export class Legend {
  /** @param {Chunk.Selection} selection */
  constructor(selection) {
    this.selection = selection;
    this.node = document.getElementById("legend");
  }

  /**
   * `dimension` is one of the chunk's; `place` the bin in it, from 0.
   * @param {Chunk.Dimension} dimension
   * @param {number} place
   */
  show(dimension, place) {
    const { ramp } = this.selection;
    const { quantity, unit, edges } = dimension;
    const swatches = ramp.map((color, bin) => {
      const node = element("i", { class: bin === place ? "own" : null });
      node.style.background = color;
      return node;
    });
    // The outer bins also take what lies beyond their edges, so these have no value to be told.
    const ticks = edges
      .slice(1, -1)
      .map((edge, between) =>
        element("span", { class: between === place || between === place - 1 ? "own" : null }, measured(edge)),
      );
    this.node.replaceChildren(
      element("p", {}, `Colours: ${quantityInWords(quantity, unit)}`),
      element(
        "div",
        { class: "ten", role: "img", "aria-label": `Ten colours from low to high; the bin is number ${place + 1}` },
        swatches,
      ),
      element("div", { class: "ticks", "aria-hidden": "true" }, ticks),
    );
  }

  clear() {
    this.node.replaceChildren();
  }
}

/**
 * What a descriptor measures, with its unit.
 * @param {string} quantity
 * @param {string} unit
 */
export function quantityInWords(quantity, unit) {
  return unit === "" ? quantity : `${quantity}, in ${unit === "°" ? "degrees" : unit}`;
}
