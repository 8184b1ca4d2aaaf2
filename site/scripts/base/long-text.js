// A long text of a database: its beginning, and the whole where a reader asks for it.

import { element } from "./dom.js";
import { shortened } from "./words.js";

/** Letters of a text that stands there whole, and of the beginning of a longer one. */
const WHOLE = 320;
const BEGINNING = 160;

/** @param {string} text */
export function longText(text) {
  if (text.length <= WHOLE) return text;
  return element(
    "details",
    { class: "long-text" },
    element(
      "summary",
      {},
      element("span", { class: "beginning" }, shortened(text, BEGINNING)),
      " ",
      element("span", { class: "more" }, "Show all"),
      element("span", { class: "less" }, "Show less"),
    ),
    text,
  );
}
