// What neighbourhood hit can be for classes of these sizes, to the letter as shapeviz_report/quality.py defines it: of
// a shape of a class of n at most min(k, n - 1) of its k neighbours are of its class.

import { entry } from "../base/entry.js";
import { figure, grouped } from "../base/words.js";

/** @import { Database, ShapeMap } from "./database.js" */

/**
 * @param {Iterable<number>} groups the class of every shape on a map, -1 without a label
 * @param {number} k number of neighbours; less where there are fewer other shapes
 * @returns {{ highest: number | null, highestOfClass: Map<number, number>, chanceOfClass: Map<number, number> }}
 *   of NH_s, and of NH_c and of every shape of a class
 */
export function hitRange(groups, k) {
  /** @type {Map<number, number>} */
  const sizes = new Map();
  let others = -1;
  for (const group of groups) {
    others += 1;
    if (group >= 0) sizes.set(group, (sizes.get(group) ?? 0) + 1);
  }
  const places = Math.min(k, others);
  if (places < 1 || sizes.size === 0) return { highest: null, highestOfClass: new Map(), chanceOfClass: new Map() };
  /** @param {(size: number) => number} value */
  const ofClass = (value) => new Map([...sizes].map(([group, size]) => [group, value(size)]));
  const highestOfClass = ofClass((size) => Math.min(places, size - 1) / places);
  let [total, labelled] = [0, 0];
  for (const size of sizes.values()) {
    total += size * (Math.min(places, size - 1) / places);
    labelled += size;
  }
  return { highest: total / labelled, highestOfClass, chanceOfClass: ofClass((size) => (size - 1) / others) };
}

/** @type {WeakMap<ShapeMap, ReturnType<typeof hitRange>>} */
const ranges = new WeakMap();

/**
 * The range of a map as the Database has them; of the shapes that it was measured on.
 * @param {Database} database
 * @param {ShapeMap} map
 */
export function rangeOf(database, map) {
  return entry(ranges, map, () => hitRange(measuredGroups(database, map), map.neighbours));
}

/**
 * The classes of those shapes: of its sample, or of all that have a place on it.
 * @param {Database} database
 * @param {ShapeMap} map
 */
function measuredGroups({ groups }, { sample, x }) {
  return sample ? sample.map((shape) => groups[shape]) : groups.filter((_, index) => !Number.isNaN(x[index]));
}

/**
 * Why no map can differ from chance in NH, as a sentence; null where one can, and without labels. In the words of
 * `nothing_told` in `pages/base.py`.
 * @param {Database} database
 * @param {ShapeMap} map
 */
export function nothingTold(database, map) {
  const groups = measuredGroups(database, map);
  const { highest, highestOfClass, chanceOfClass } = rangeOf(database, map);
  if (highest === null) return null;
  if (highestOfClass.size === 1) return "All labelled shapes are of one class, which no map can mix with another.";
  if ([...highestOfClass].some(([group, most]) => most - /** @type {number} */ (chanceOfClass.get(group)) > 1e-9))
    return null;
  return map.neighbours >= groups.length - 1
    ? `With ${grouped(groups.length)} shapes, each has all others among its ${grouped(map.neighbours)} nearest on any map.`
    : "Each shape is alone in its class, so none can have another of it near on any map.";
}

/**
 * The highest NH that a shape can have on a map; null without a label.
 * @param {Database} database
 * @param {ShapeMap} map
 * @param {number} index
 */
export function highestOf(database, map, index) {
  return rangeOf(database, map).highestOfClass.get(database.groups[index]) ?? null;
}

/**
 * The share of what it can be that NH of a shape reaches, which its colour shows; null where it cannot but be 0.
 * @param {Database} database
 * @param {ShapeMap} map
 * @param {number} index
 */
export function reachOf(database, map, index) {
  const highest = highestOf(database, map, index);
  return highest && map.hit[index] !== null ? map.hit[index] / highest : null;
}

/**
 * How far a hit lies on the way from chance (0) to the maximum (1); null where every map reaches the same.
 * @param {number | null} value
 * @param {number | null} chance
 * @param {number | null} highest
 */
export function shareOfRange(value, chance, highest) {
  if (value === null || chance === null || highest === null || highest - chance < 1e-9) return null;
  return (value - chance) / (highest - chance);
}

/**
 * Whether a maximum is worth a word: 1 goes without saying.
 * @param {number | null | undefined} highest
 * @returns {highest is number}
 */
export function isBelowOne(highest) {
  return highest !== null && highest !== undefined && highest < 1 - 1e-9;
}

/**
 * " of at most 0.700"; nothing where NH can reach 1.
 * @param {number | null | undefined} highest
 */
export function ofAtMost(highest) {
  return isBelowOne(highest) ? ` of at most ${figure(highest)}` : "";
}
