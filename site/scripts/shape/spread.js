// How the values of a bin are spread: over all shapes, and over the others of a shape's class.

import { quantile } from "../bins-kit/bin-card.js";

/** @import { Bins } from "../database/bins.js" */

const QUARTERS = [0.25, 0.5, 0.75];

export class Spread {
  /** @param {Bins} bins */
  constructor(database, bins) {
    this.database = database;
    this.bins = bins;
    this.ofAll = new Map();
  }

  /** The quarters of all shapes in a column: `{ low, middle, high, least, most }`. */
  all(column) {
    if (!this.ofAll.has(column)) this.ofAll.set(column, this.#quarters(column, null));
    return this.ofAll.get(column);
  }

  /** The same of the others of a shape's class; null where it has none. */
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

  /** The share of all other shapes that have less of a column than one, those with as much counted half. */
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

  /** In which dimension of a feature a shape differs most from the mean of all shapes. */
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

  #means = new Map();

  /** @param {number} column */
  #mean(column) {
    if (!this.#means.has(column)) {
      const { steps, rows } = this.bins;
      let total = 0;
      for (let place = column * rows; place < (column + 1) * rows; place += 1) total += steps[place];
      this.#means.set(column, total / rows);
    }
    return this.#means.get(column);
  }

  #quarters(column, rows) {
    const { bins } = this;
    const values = Float64Array.from(rows ?? { length: bins.rows }, (row, place) =>
      bins.share(column, rows ? row : place),
    ).sort();
    const [low, middle, high] = QUARTERS.map((share) => quantile(values, share));
    return { low, middle, high, least: values[0], most: values.at(-1) };
  }
}
