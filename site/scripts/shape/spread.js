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
    const values = Float64Array.from(rows ?? Array(bins.rows).keys(), (row) => bins.share(column, row)).sort();
    const [low, middle, high] = QUARTERS.map((share) => quantile(values, share));
    return { low, middle, high, least: values[0], most: values.at(-1) };
  }
}
