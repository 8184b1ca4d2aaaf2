// Links from the page of a shape to those of others. They keep what the page shows otherwise, so they follow it.

import { shapeAddress } from "../addresses/shape.js";
import { element, picture } from "../base/dom.js";

/** @import { Child } from "../base/dom.js" */
/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Database } from "../database/database.js" */

export class ShapeLinks {
  /**
   * @param {Database} database
   * @param {ShapeState} state
   * @param {{ opened: () => void }} ways is told when a reader follows one within this window
   */
  constructor(database, state, { opened }) {
    this.database = database;
    this.state = state;
    state.listen((changed) => {
      if (["method", "features", "bins", "bin", "parts", "selection"].some((name) => changed.has(name))) this.#follow();
    });
    document.getElementById("content").addEventListener("click", (event) => {
      if (event.target.closest("a[data-shape]") && !event.ctrlKey && !event.metaKey && !event.shiftKey) opened();
    });
  }

  #follow() {
    for (const link of document.querySelectorAll("a[data-shape]"))
      link.href = shapeAddress(this.database, this.state, Number(link.dataset.shape));
  }

  /**
   * @param {number} shape
   * @param {Attributes} attributes
   * @param {...Child} children
   */
  link(shape, attributes, ...children) {
    return element(
      "a",
      { href: shapeAddress(this.database, this.state, shape), "data-shape": shape, ...attributes },
      children,
    );
  }

  /**
   * A shape as a picture, underlined where it is a stranger.
   * @param {number} shape
   * @param {number} size
   * @param {Attributes & { stranger?: boolean }} [how]
   */
  pictured(shape, size, { stranger = false, ...attributes } = {}) {
    const { database } = this;
    const group = database.groups[shape];
    const words = database.labelled
      ? [database.names.at(shape), database.className(group)]
      : [database.names.at(shape)];
    return this.link(
      shape,
      {
        class: stranger ? "shape stranger" : "shape",
        "aria-label": words.join(", "),
        title: words.join("\n"),
        ...attributes,
      },
      picture(database, shape, size),
    );
  }
}
