// The mark of a feature.

import { element } from "../base/dom.js";

/** @param {string} color */
export function hue(color) {
  const mark = element("i", { class: "hued", "aria-hidden": "true" });
  mark.style.background = color;
  return mark;
}
