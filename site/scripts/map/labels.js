// Names of classes on a map, or of other groups, each with its mark before it; where they stand is decided in placement.js.

import { svg } from "../base/dom.js";
import { shortened } from "../base/words.js";
import { leaderOf, placeNames } from "./placement.js";

/** @import { Naming } from "./coloring.js" */
/** @import { Mark } from "./clusters.js" */
/** @import { Box, Place } from "./placement.js" */
/** @typedef {Place & { node: Element, mark: Element, line: Element | null }} Label */

const HEIGHT = 18;
const LONGEST = 26;
/** Of the mark before a name, and from its beginning to that of the text. */
const RADIUS = 3.8;
const INDENT = 12;
/** Right and left of a name, so that two do not read as one. */
const PADDING = 4;

/** @type {CanvasRenderingContext2D | null} measures texts */
let pen = null;

export class Labels {
  #layer = svg("g", { class: "labels" });
  /** @type {Label[]} */
  #labels = [];
  /** @type {Map<string, number>} */
  #widths = new Map();

  /**
   * @param {Naming} naming of the groups whose names stand there
   * @param {Element} overlay
   */
  constructor(naming, overlay) {
    this.naming = naming;
    overlay.append(this.#layer);
  }

  /** The shapes that names stand at. */
  get anchors() {
    return new Set(this.#labels.map(({ anchor }) => anchor));
  }

  clear() {
    this.#labels = [];
    this.#layer.replaceChildren();
  }

  /**
   * Choose places; a name that has one keeps it where it can.
   *
   * @param {Mark[]} marks the visible shapes
   * @param {{ width: number, height: number, covered?: Box[] }} frame
   * @param {number} radius of a mark
   */
  place(marks, frame, radius) {
    const groups = new Set(marks.map(({ group }) => group).filter((group) => group >= 0));
    const sizes = new Map([...groups].map((group) => [group, this.#size(group)]));
    const places = placeNames(marks, sizes, frame, radius, this.#labels);
    this.#labels = places.map((place) => {
      const { group, leader } = place;
      const mark = svg("path", {
        d: this.naming.lookOf(group).symbol,
        transform: `translate(${RADIUS} 0) scale(${RADIUS})`,
      });
      const text = svg("text", { x: INDENT, "dominant-baseline": "central" }, this.#text(group));
      const line = leader ? svg("line") : null;
      return { ...place, node: svg("g", {}, mark, text), mark, line };
    });
    // Lines lie below all names.
    this.#layer.replaceChildren(
      ...this.#labels.flatMap(({ line }) => (line === null ? [] : [line])),
      ...this.#labels.map(({ node }) => node),
    );
  }

  /**
   * Let the names follow their shapes.
   *
   * @param {(index: number) => number[]} screen where a shape is in pixels
   */
  follow(screen) {
    for (const { node, mark, line, group, anchor, dx, dy } of this.#labels) {
      const [x, y] = screen(anchor);
      const { width, height } = this.#size(group);
      const box = {
        left: x + dx - width / 2,
        right: x + dx + width / 2,
        top: y + dy - height / 2,
        bottom: y + dy + height / 2,
      };
      mark.setAttribute("fill", this.naming.lookOf(group).color);
      node.setAttribute("transform", `translate(${box.left + PADDING} ${y + dy})`);
      for (const [name, value] of Object.entries(line === null ? {} : leaderOf(box, { x, y })))
        line?.setAttribute(name, `${value}`);
    }
  }

  /** @param {number} group */
  #text(group) {
    return shortened(this.naming.nameOf(group), LONGEST);
  }

  /** @param {number} group */
  #size(group) {
    const text = this.#text(group);
    let width = this.#widths.get(text);
    if (width === undefined) {
      pen ??= document.createElement("canvas").getContext("2d");
      if (pen === null) throw new Error("texts cannot be measured");
      pen.font = `600 13px ${getComputedStyle(document.body).fontFamily}`;
      width = pen.measureText(text).width + INDENT + 2 * PADDING;
      this.#widths.set(text, width);
    }
    return { width, height: HEIGHT };
  }
}
