// What a bin is called: in plain words, with its name beside them; and what it is exactly, for who asks.

import { element } from "../base/dom.js";

/** @import { Bins } from "../database/bins.js" */

/**
 * The colour of its feature, its name, and its plain words.
 * @param {Bins} bins
 * @param {number} column
 */
export function binName(bins, column) {
  const hue = element("i", { class: "hued" });
  hue.style.background = bins.color(column);
  return [hue, element("b", {}, element("bdi", {}, bins.names[column])), ...inWords(bins, column)];
}

/**
 * The plain words of a bin, to follow its name; nothing for a feature that was brought along.
 * @param {Bins} bins
 * @param {number} column
 */
export function inWords(bins, column) {
  const words = bins.called[column];
  return words === "" ? [] : [" ", element("span", { class: "in-words" }, words)];
}

/**
 * The exact definition, behind a word that opens it.
 * @param {Bins} bins
 * @param {number} column
 * @param {string | null} [more] what else is said of it
 */
export function exactly(bins, column, more = null) {
  return element(
    "details",
    { class: "exactly" },
    element("summary", {}, "Exactly"),
    element("p", {}, bins.sentence(column), more && ` ${more}`),
  );
}
