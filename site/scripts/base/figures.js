// How NH and its changes are written.

import { element, svg } from "./dom.js";
import { figure } from "./words.js";

/**
 * A difference with its sign, three decimals as all figures of quality.
 * @param {number} value
 */
export function difference(value) {
  const shown = figure(Math.abs(value));
  return shown === "0.000" ? "±0.000" : `${value < 0 ? "−" : "+"}${shown}`;
}

/** The symbol of the neighbourhood hit of a map. */
export function symbol() {
  return element("span", { class: "symbol" }, "NH", element("sub", {}, "s"));
}

/**
 * What a change is called where it is heard: "up 0.203".
 * @param {number} value
 */
export function changeWords(value) {
  const shown = figure(Math.abs(value));
  return shown === "0.000" ? "unchanged" : `${value < 0 ? "down" : "up"} ${shown}`;
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
