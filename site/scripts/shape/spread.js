// How the values of a bin are spread: over all shapes, and over the others of a shape's class.

import { entry } from "../base/entry.js";
import { quantile } from "../bins-kit/bin-card.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */

/**
 * How values are spread: their quarters, and their ends.
 * @typedef {{ low: number, middle: number, high: number, least: number, most: number }} Quarters
 */

const QUARTERS = [0.25, 0.5, 0.75];

/** Different values that 16 bits hold. */
const STEPS = 65536;

export class Spread {
  /**
   * @param {Database} database
   * @param {Bins} bins
   */
  constructor(database, bins) {
    this.database = database;
    this.bins = bins;
    /** @type {Map<number, Quarters>} */
    this.ofAll = new Map();
    /** @type {{ shape: number, rows: number[] } | null} */
    this.fellowsOf = null;
  }

  /**
   * Have at hand what is told of a shape.
   * @param {number} _shape
   */
  async know(_shape) {}

  /**
   * The quarters of all shapes in a column.
   * @param {number} column
   */
  all(column) {
    return entry(this.ofAll, column, () => this.#quarters(column, null));
  }

  /**
   * The same of the others of a shape's class; null where it has none.
   * @param {number} column
   * @param {number} shape
   */
  fellows(column, shape) {
    if (this.fellowsOf?.shape !== shape) {
      const { groups } = this.database;
      const own = groups[shape];
      this.fellowsOf = {
        shape,
        rows: own < 0 ? [] : [...groups.keys()].filter((row) => groups[row] === own && row !== shape),
      };
    }
    const { rows } = this.fellowsOf;
    return rows.length > 0 ? this.#quarters(column, rows) : null;
  }

  /**
   * The share of all other shapes that have less of a column than one, those with as much counted half.
   * @param {number} column
   * @param {number} shape
   */
  rank(column, shape) {
    const { steps, rows } = this.bins;
    const start = column * rows;
    const own = steps[start + shape];
    let below = 0,
      equal = -1;
    for (let row = 0; row < rows; row += 1) {
      below += Number(steps[start + row] < own);
      equal += Number(steps[start + row] === own);
    }
    return rows > 1 ? (below + equal / 2) / (rows - 1) : 0.5;
  }

  /**
   * In which dimension of a feature a shape differs most from the mean of all shapes.
   * @param {number} feature
   * @param {number} shape
   */
  mostUnusual(feature, shape) {
    const { start, dimensions, bins: width } = this.bins.features[feature];
    let [best, most] = [0, -1];
    for (let dimension = 0; dimension < dimensions; dimension += 1) {
      let total = 0;
      for (let place = 0; place < width; place += 1) {
        const column = start + dimension * width + place;
        total += (this.bins.steps[column * this.bins.rows + shape] - this.#mean(column)) ** 2;
      }
      if (total > most) [best, most] = [dimension, total];
    }
    return best;
  }

  /** @type {Map<number, number>} */
  #means = new Map();

  /** @param {number} column */
  #mean(column) {
    return entry(this.#means, column, () => {
      const { steps, rows } = this.bins;
      let total = 0;
      for (let place = column * rows; place < (column + 1) * rows; place += 1) total += steps[place];
      return total / rows;
    });
  }

  /**
   * @param {number} column
   * @param {number[] | null} rows all where it is null
   * @returns {Quarters}
   */
  #quarters(column, rows) {
    const { bins } = this;
    const start = column * bins.rows;
    const length = rows?.length ?? bins.rows;
    // How many shapes have no more than each step: a count where sorting would take too long for very many.
    const upTo = new Uint32Array(STEPS);
    for (let place = 0; place < length; place += 1)
      upTo[bins.steps[start + (rows === null ? place : rows[place])]] += 1;
    for (let step = 1; step < STEPS; step += 1) upTo[step] += upTo[step - 1];
    /** @param {number} place among all in rising order */
    const at = (place) => bins.shareAt(column, firstAbove(upTo, place));
    const [low, middle, high] = QUARTERS.map((share) => quantile({ length, at }, share));
    return { low, middle, high, least: at(0), most: at(length - 1) };
  }
}

/**
 * The first place of rising numbers at which one is above another.
 * @param {Uint32Array} rising
 * @param {number} number
 */
function firstAbove(rising, number) {
  let [low, high] = [0, rising.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rising[middle] > number) high = middle;
    else low = middle + 1;
  }
  return low;
}
