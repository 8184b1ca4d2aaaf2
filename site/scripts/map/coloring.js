// What the colour of a mark says: a class, how well a shape keeps to its class, or anything else that is known of shapes.

import { figure } from "../base/words.js";
import { highestOf, ofAtMost, reachOf } from "../database/hit-range.js";

/** @import { Database, ShapeMap } from "../database/database.js" */

/**
 * @typedef {{ symbol: string, color: string }} Look of a mark
 *
 * What colours say. Shapes of one `kind` look the same; null is the kind of a shape that nothing is known of.
 * @typedef {object} Coloring
 * @property {string} title
 * @property {(index: number) => number | null} kindOf
 * @property {(kind: number | null) => Look} look
 * @property {(index: number) => string} textOf what is known of a shape, in words
 * @property {Naming} [naming] groups that stand together on a map, where these are not the classes
 *
 * Groups with a name, of which -1 has none.
 * @typedef {object} Naming
 * @property {(index: number) => number} groupOf
 * @property {(group: number) => string} nameOf
 * @property {(group: number) => Look} lookOf
 */

/**
 * @param {Database} database
 * @returns {Naming}
 */
export function classNaming(database) {
  return {
    groupOf: (index) => database.groups[index],
    nameOf: (group) => database.className(group),
    lookOf: (group) => ({ symbol: database.symbol(group), color: database.color(group) }),
  };
}

/**
 * @param {Database} database
 * @returns {Coloring}
 */
export function classColoring(database) {
  const { lookOf } = classNaming(database);
  return {
    title: database.data.standIn ? "Cluster" : "Class",
    kindOf: (index) => database.groups[index],
    look: (group) => lookOf(group ?? -1),
    textOf: (index) => database.className(database.groups[index]),
  };
}

/**
 * @param {Database} database
 * @param {ShapeMap} map
 * @returns {Coloring}
 */
export function hitColoring(database, map) {
  return {
    title: "NH",
    kindOf: (index) => reachOf(database, map, index),
    look: (reach) => ({
      symbol: database.data.marks.plain,
      color: reach === null ? database.marks.unlabelled : between(database.marks.hit, reach),
    }),
    textOf: (index) => `${figure(map.hit[index])}${ofAtMost(highestOf(database, map, index))}`,
  };
}

/**
 * A colour on a ramp.
 * @param {string[]} ramp written as #rrggbb, from 0 to 1
 * @param {number} share
 */
export function between(ramp, share) {
  const place = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
  const low = Math.min(Math.floor(place), ramp.length - 2);
  return mixed(ramp[low], ramp[low + 1], place - low);
}

/**
 * A colour between two, which are written as #rrggbb.
 * @param {string} one
 * @param {string} other
 * @param {number} share
 */
function mixed(one, other, share) {
  /**
   * @param {string} color
   * @param {number} at
   */
  const part = (color, at) => Number.parseInt(color.slice(at, at + 2), 16);
  return `rgb(${[1, 3, 5].map((at) => Math.round(part(one, at) + share * (part(other, at) - part(one, at)))).join(" ")})`;
}
