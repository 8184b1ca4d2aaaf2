// How NH and its changes are written.

import { element, svg } from "./dom.js";
import { figure } from "./words.js";

/**
 * How far two figures of quality differ as they are shown, so that it adds up for a reader; as `change` of
 * `pages/base.py`.
 * @param {number} before
 * @param {number} after
 */
export function change(before, after) {
  return Number(figure(Number(figure(after)) - Number(figure(before))));
}

/**
 * The same with its sign, three decimals as all figures of quality.
 * @param {number} before
 * @param {number} after
 */
export function difference(before, after) {
  const value = change(before, after);
  return value === 0 ? "±0.000" : `${value < 0 ? "−" : "+"}${figure(Math.abs(value))}`;
}

/** The symbol of the neighbourhood hit of a map. */
export function symbol() {
  return element("span", { class: "symbol" }, "NH", element("sub", {}, "s"));
}

/**
 * What a change is called where it is heard: "up 0.203".
 * @param {number} before
 * @param {number} after
 */
export function changeWords(before, after) {
  const value = change(before, after);
  return value === 0 ? "unchanged" : `${value < 0 ? "down" : "up"} ${figure(Math.abs(value))}`;
}

/** How NH of a map and of a class stand in a caption, which is plain text until it is drawn or shown. */
const SYMBOL = /(?<=NH)_([sc])\b/;

/** How far below the line their letter stands, in parts of the size of the text. */
const BELOW = 0.25;
const SMALLER = 0.7;

/**
 * A line of a caption, to be shown on the page.
 * @param {string} line
 */
export function withSymbols(line) {
  return line.split(SYMBOL).map((part, place) => (place % 2 === 1 ? element("sub", {}, part) : part));
}

/**
 * The same to be drawn in a text of some size, in pixels.
 * @param {string} line
 * @param {number} size
 */
export function drawnSymbols(line, size) {
  const below = BELOW * size;
  return line.split(SYMBOL).map((part, place) => {
    if (place % 2 === 1) return svg("tspan", { dy: below, "font-size": `${SMALLER * size}px` }, part);
    return place === 0 || part === "" ? part : svg("tspan", { dy: -below }, part);
  });
}
