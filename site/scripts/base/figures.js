// How the Workbench writes NH and its changes.

import { element } from "./dom.js";
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
