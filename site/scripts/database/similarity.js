// Which shapes are most similar to one, and which features make them so: what shapeviz_report/similarity.py is in Python.
//
// The distance of two shapes is the Euclidean distance of the values that projections compare: every feature divided by
// its root mean square norm over the database, times its weight, or every chosen bin by its standard deviation; "plain"
// tables as they are.

import { entry } from "../base/entry.js";

/** @import { Bins } from "./bins.js" */

/**
 * What is compared: bins or features by their numbers, rising.
 * @typedef {{ columns: number[], features?: undefined } | { features: number[], columns?: undefined }} Choice
 *
 * A similar shape: its distance, and for each feature the share of all other shapes that are farther in it alone, those
 * equally far counted half; 0.5 where a feature tells nothing.
 * @typedef {{ row: number, distance: number, closer: number[] }} Similar
 *
 * Squared distances from a row in each feature alone, and those of the other rows rising.
 * @typedef {{ row: number, byFeature: Float64Array[], sorted: Float64Array[] }} Squares
 */

/** Distances whose squares differ by less than this fraction are equal. */
const TIE = 1e-9;

/** A spread below this is rounding: the column or feature is the same for all shapes, and tells nothing. */
const NOTHING = 1e-12;

/**
 * What a squared difference in a bin of such a variance counts where bins are compared.
 * @param {{ balanced: boolean }} bins
 * @param {number} variance
 */
export function weightOf({ balanced }, variance) {
  if (!balanced) return 1;
  return Math.sqrt(variance) > NOTHING ? 1 / variance : 0;
}

export class Similarity {
  /** @param {Bins} bins */
  constructor(bins) {
    this.bins = bins;
  }

  /** What a squared difference counts, in each column that was asked for, and in each feature. */
  /** @type {Map<number, number>} */
  #columnWeights = new Map();
  /** @type {Map<number, number>} */
  #featureWeights = new Map();

  /** The squares of the last shape that was asked for: readers try several choices on one. */
  /** @type {Squares | null} */
  #last = null;

  /**
   * The shapes most similar to the one of a row, the most similar first.
   * @param {number} row
   * @param {Choice} choice
   * @param {number} count
   * @returns {Similar[]}
   */
  rank(row, choice, count) {
    const squared = this.#choose(row, choice);
    return this.tell(row, first(squared, row, count), choice);
  }

  /**
   * How far some shapes are from the one of a row, and in what they are like it.
   * @param {number} row
   * @param {number[]} others
   * @param {Choice} choice
   * @returns {Similar[]}
   */
  tell(row, others, choice) {
    const squared = this.#choose(row, choice);
    const { byFeature, sorted } = this.#know(row);
    return others.map((other) => ({
      row: other,
      distance: Math.sqrt(squared[other]),
      closer: byFeature.map((own, feature) => shareFarther(sorted[feature], own[other])),
    }));
  }

  /**
   * The same shapes alone, of some.
   * @param {number} row
   * @param {Choice} choice
   * @param {number} count
   * @param {(row: number) => boolean} among whether a shape counts
   */
  nearest(row, choice, count, among) {
    return first(this.#choose(row, choice), row, count, among);
  }

  /**
   * What two shapes differ in, column by column: adds up to their squared distance.
   * @param {number} row
   * @param {number} other
   * @param {Choice} choice
   * @returns {{ column: number, squared: number }[]} those that differ
   */
  differences(row, other, { features, columns }) {
    const { steps, rows } = this.bins;
    return (columns ?? features.flatMap((feature) => this.#columns(feature)))
      .map((column) => {
        const weight = columns ? this.#columnWeight(column) : this.#featureWeight(this.bins.featureOf(column));
        const difference = (steps[column * rows + row] - steps[column * rows + other]) * this.bins.stepOf(column);
        return { column, squared: difference ** 2 * weight };
      })
      .filter(({ squared }) => squared > 0);
  }

  /**
   * How far two shapes are apart, as a root mean square over all pairs.
   * @param {Choice} choice
   */
  typical({ features, columns }) {
    const { bins } = this;
    const spread = columns
      ? columns.reduce((sum, column) => sum + this.bins.variance(column) * this.#columnWeight(column), 0)
      : features.reduce((sum, feature) => sum + this.#size(feature) * this.#featureWeight(feature), 0);
    return Math.sqrt((2 * spread * bins.rows) / Math.max(bins.rows - 1, 1));
  }

  /**
   * @param {number} row
   * @param {Choice} choice
   */
  #choose(row, { features, columns }) {
    const total = new Float64Array(this.bins.rows);
    if (columns) for (const column of columns) this.#addSquares(total, row, column, this.#columnWeight(column));
    else
      for (const feature of features)
        this.#know(row).byFeature[feature].forEach((value, other) => (total[other] += value));
    return total;
  }

  /**
   * @param {number} row
   * @returns {Squares}
   */
  #know(row) {
    let last = this.#last;
    if (last?.row !== row) {
      const byFeature = [...this.bins.features.keys()].map((feature) => this.#byFeature(row, feature));
      last = {
        row,
        byFeature,
        sorted: byFeature.map((squared) => squared.filter((_, other) => other !== row).sort()),
      };
      this.#last = last;
    }
    return last;
  }

  /**
   * @param {number} row
   * @param {number} feature
   */
  #byFeature(row, feature) {
    const total = new Float64Array(this.bins.rows);
    for (const column of this.#columns(feature)) this.#addSquares(total, row, column, 1);
    const weight = this.#featureWeight(feature);
    return total.map((value) => value * weight);
  }

  /**
   * @param {Float64Array} total
   * @param {number} row
   * @param {number} column
   * @param {number} weight
   */
  #addSquares(total, row, column, weight) {
    const { steps, rows } = this.bins;
    const start = column * rows;
    const own = steps[start + row];
    const unit = this.bins.stepOf(column) ** 2 * weight;
    for (let other = 0; other < rows; other += 1) {
      const difference = steps[start + other] - own;
      total[other] += difference * difference * unit;
    }
  }

  /** @param {number} feature */
  #columns(feature) {
    const { start, dimensions, bins } = this.bins.features[feature];
    return Array.from({ length: dimensions * bins }, (_, place) => start + place);
  }

  /** @param {number} column */
  #columnWeight(column) {
    return entry(this.#columnWeights, column, () => weightOf(this.bins, this.bins.variance(column)));
  }

  /** @param {number} feature */
  #featureWeight(feature) {
    if (!this.bins.balanced) return 1;
    return entry(this.#featureWeights, feature, () => {
      const size = this.#size(feature);
      return size > NOTHING ** 2 ? this.bins.features[feature].weight / size : 0;
    });
  }

  /**
   * The mean squared distance of all shapes from their mean in one feature.
   * @param {number} feature
   */
  #size(feature) {
    return this.#columns(feature).reduce((sum, column) => sum + this.bins.variance(column), 0);
  }
}

/**
 * The rows with the lowest values, but one; of equal ones those that come first.
 * @param {Float64Array} squared
 * @param {number} row
 * @param {number} count
 * @param {(row: number) => boolean} [among]
 */
export function first(squared, row, count, among = () => true) {
  // A comparison of two rows costs as much as sorting many numbers: only what is low enough is put in order.
  const rising = squared.filter((_, other) => other !== row && among(other)).sort();
  const limit = rising[Math.min(count, rising.length) - 1] ?? -1;
  const rows = [...squared.keys()].filter((other) => other !== row && squared[other] <= limit && among(other));
  return rows.sort((a, b) => squared[a] - squared[b] || a - b).slice(0, count);
}

/**
 * The share of rising squared distances that exceed one of them, equal ones counted half.
 * @param {Float64Array} sorted
 * @param {number} squared
 */
function shareFarther(sorted, squared) {
  const others = sorted.length - 1;
  if (others === 0) return 0.5;
  const below = countBelow(sorted, squared * (1 - TIE), false);
  const above = sorted.length - countBelow(sorted, squared * (1 + TIE), true);
  return (above + (sorted.length - below - above - 1) / 2) / others;
}

/**
 * How many of some rising values are less than a limit, or at most that.
 * @param {Float64Array} sorted
 * @param {number} limit
 * @param {boolean} included
 */
function countBelow(sorted, limit, included) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] < limit || (included && sorted[middle] === limit)) low = middle + 1;
    else high = middle;
  }
  return low;
}
