// Which shapes pass the reader's filters, and how many would pass others.

import { entry } from "../base/entry.js";
import { NONE } from "../database/fields.js";

/** @import { Filter } from "../addresses/shapes.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Field, Fields, RangeField, TreeField } from "../database/fields.js" */

/** @typedef {(row: number) => boolean} Passing */

export class Sieve {
  /** @type {WeakMap<Filter, Uint8Array>} */
  #failing = new WeakMap();

  /**
   * @param {Database} database
   * @param {Fields} fields
   */
  constructor(database, fields) {
    this.database = database;
    this.fields = fields;
    this.everything = new Uint8Array(database.count);
    /** @type {Map<string, Uint8Array>} */
    this.conditions = new Map();
    this.failures = this.everything;
    this.size = database.count;
  }

  /**
   * Sift the shapes. What it is given is never changed, only replaced.
   * @param {Set<number> | null} matches shapes that the search finds
   * @param {Set<number> | null} only shapes
   * @param {Map<string, Filter>} filters by the keys of their fields
   */
  sift(matches, only, filters) {
    this.conditions = new Map();
    for (const [key, shapes] of Object.entries({ search: matches, only })) {
      if (shapes !== null)
        this.conditions.set(
          key,
          this.#of(shapes, () => (row) => shapes.has(row)),
        );
    }
    for (const [key, filter] of filters)
      this.conditions.set(
        key,
        this.#of(filter, () => passing(/** @type {Field} */ (this.fields.byKey.get(key)), filter)),
      );
    this.failures = this.everything;
    if (this.conditions.size > 0) {
      this.failures = new Uint8Array(this.database.count);
      for (const failing of this.conditions.values())
        for (let row = 0; row < failing.length; row += 1) this.failures[row] += failing[row];
    }
    this.size = this.#remaining(this.everything);
  }

  /**
   * Filters are never changed, so what one lets pass is found once.
   * @param {Filter} filter
   * @param {() => Passing} make
   */
  #of(filter, make) {
    return entry(this.#failing, filter, () => {
      const passes = make();
      return Uint8Array.from({ length: this.database.count }, (_, row) => (passes(row) ? 0 : 1));
    });
  }

  /** @param {number} row */
  passes(row) {
    return this.failures[row] === 0;
  }

  /**
   * How many shapes there would be without one condition, by its key.
   * @param {string} key
   */
  without(key) {
    return this.#remaining(this.conditions.get(key) ?? this.everything);
  }

  /** @param {Uint8Array} own */
  #remaining(own) {
    let size = 0;
    for (let row = 0; row < own.length; row += 1) size += this.failures[row] === own[row] ? 1 : 0;
    return size;
  }

  /**
   * How many of the shapes that pass all other filters have each value of a field; those without one come last.
   * @param {{ key: string, names: ArrayLike<unknown>, of: ArrayLike<number> }} field
   */
  counts({ key, names, of }) {
    const counts = new Int32Array(names.length + 1);
    this.#each(key, (row) => {
      counts[of[row] < 0 ? names.length : of[row]] += 1;
    });
    return counts;
  }

  /**
   * The same for the nodes of a tree with all below them.
   * @param {TreeField} field
   */
  countsOfTree({ key, tree: { nodes, of } }) {
    const counts = this.counts({ key, names: nodes, of });
    for (let node = nodes.length - 1; node >= 0; node -= 1)
      if (nodes[node].parent >= 0) counts[nodes[node].parent] += counts[node];
    return counts;
  }

  /**
   * The same for the intervals of a field of numbers.
   * @param {RangeField} field
   */
  countsOfIntervals({ key, numbers, edges }) {
    const counts = new Int32Array(edges.length - 1);
    this.#each(key, (row) => {
      const number = numbers[row];
      if (!Number.isNaN(number)) counts[interval(edges, number)] += 1;
    });
    return counts;
  }

  /**
   * @param {string} key
   * @param {(row: number) => void} visit
   */
  #each(key, visit) {
    const own = this.conditions.get(key) ?? this.everything;
    for (let row = 0; row < own.length; row += 1) if (this.failures[row] === own[row]) visit(row);
  }
}

/**
 * The interval that a number lies in; the last one holds its upper edge too.
 * @param {number[]} edges
 * @param {number} number
 */
export function interval(edges, number) {
  let [low, high] = [0, edges.length - 2];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (edges[middle] <= number) low = middle;
    else high = middle - 1;
  }
  return low;
}

/**
 * @param {Field} field
 * @param {Filter} filter
 * @returns {Passing}
 */
function passing({ tree, of, numbers }, filter) {
  if (!(filter instanceof Set))
    return (row) => {
      const number = numbers?.[row] ?? Number.NaN;
      return number >= filter.low && number <= filter.high;
    };
  if (tree === null) return (row) => filter.has(of?.[row] ?? NONE);
  const under = new Set(filter);
  for (const [node, { parent }] of tree.nodes.entries()) if (under.has(parent) && parent !== NONE) under.add(node);
  return (row) => under.has(tree.of[row]);
}
