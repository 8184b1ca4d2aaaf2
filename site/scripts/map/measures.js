// What is measured of a map without labels, each beside what it is on a map at random.

import { element } from "../base/dom.js";
import { figure } from "../base/words.js";

/** @import { Faith } from "../database/database.js" */

/**
 * A measure of maps: its value is best where it is high, or where it is low.
 * @typedef {"kept" | "trustworthiness" | "continuity" | "stress"} MeasureName
 * @typedef {{ title: string, meaning: string, low: boolean }} Measured
 */

/** @type {Record<MeasureName, Measured>} */
export const MEASURES = {
  kept: { title: "Neighbours kept", meaning: "Of those most alike, the share that is near on the map", low: false },
  trustworthiness: { title: "Trustworthiness", meaning: "What is near on the map is alike: 1 at best", low: false },
  continuity: { title: "Continuity", meaning: "What is alike is near on the map: 1 at best", low: false },
  stress: { title: "Stress", meaning: "How far distances are out of proportion: 0 at best", low: true },
};

/**
 * The value of a measure, and that at random; null where there are too few shapes for it.
 * @param {Faith} faith
 * @param {MeasureName} name
 * @returns {{ value: number | null, chance: number | null }}
 */
export function measureOf(faith, name) {
  // Of all others any map keeps all.
  if (name === "kept") return { value: faith.chance === 1 ? null : faith.mean, chance: faith.chance };
  return { value: faith[name], chance: name === "stress" ? faith.randomStress : faith.random };
}

/**
 * A table of some measures; nothing where none is known.
 * @param {Faith} faith
 * @param {MeasureName[]} names
 */
export function measuresOf(faith, names = ["trustworthiness", "continuity", "stress"]) {
  const known = names.filter((name) => measureOf(faith, name).value !== null);
  if (known.length === 0) return "";
  /** @param {string} words */
  const head = (words) => element("th", { scope: "col" }, words);
  return element(
    "table",
    { class: "measures" },
    element("thead", {}, element("tr", {}, element("td"), head("this map"), head("at random"))),
    element(
      "tbody",
      {},
      known.map((name) => {
        const { value, chance } = measureOf(faith, name);
        return element(
          "tr",
          {},
          element(
            "th",
            { scope: "row", title: MEASURES[name].meaning },
            MEASURES[name].title,
            element("small", {}, MEASURES[name].meaning),
          ),
          element("td", {}, element("b", {}, figure(value))),
          element("td", {}, figure(chance)),
        );
      }),
    ),
  );
}
