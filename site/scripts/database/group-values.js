// How the values of a group of shapes are spread, bin by bin.

/** @import { Moments } from "../engine/contrast.js" */
/** @import { Bins } from "./bins.js" */

/**
 * A value, as `share` of the bins gives it, and how many shapes have it.
 * @typedef {{ value: number, weight: number }} Point
 *
 * What is known of the values of a group.
 * @typedef {object} GroupValues
 * @property {number} count shapes that it is known of
 * @property {boolean} each whether a point is a shape
 * @property {() => Moments} moments of the compared values
 * @property {(column: number) => number} mean of what `share` gives
 * @property {(column: number) => Point[]} points rising
 * @property {(column: number) => { mean: number, variance: number }} upTo of the share of the surface that lies in a bin and
 *   in those before it of its dimension
 */

/**
 * The values of some shapes that are at hand, one by one.
 * @implements {GroupValues}
 */
export class RowValues {
  /**
   * @param {Bins} bins
   * @param {number[]} rows
   */
  constructor(bins, rows) {
    this.bins = bins;
    this.rows = rows;
    this.count = rows.length;
    this.each = true;
  }

  /** @type {((column: number) => number[]) | null} */
  #read = null;

  /**
   * The steps of all in a column.
   * @param {number} column
   */
  steps(column) {
    this.#read ??= this.bins.reader(this.rows);
    return this.#read(column);
  }

  /** @param {number} column */
  #shares(column) {
    return this.steps(column).map((step) => this.bins.shareAt(column, step));
  }

  moments() {
    const { bins, count } = this;
    const [means, variances] = [new Float64Array(bins.count), new Float64Array(bins.count)];
    for (let column = 0; column < bins.count; column += 1) {
      const { mean, variance } = momentsOf(this.steps(column).map((step) => bins.valueAt(column, step)));
      [means[column], variances[column]] = [mean, variance];
    }
    return { count, means, variances };
  }

  /** @param {number} column */
  mean(column) {
    return momentsOf(this.#shares(column)).mean;
  }

  /** @param {number} column */
  points(column) {
    return this.#shares(column)
      .map((value) => ({ value, weight: 1 }))
      .sort((one, other) => one.value - other.value);
  }

  /** @param {number} column */
  upTo(column) {
    const sums = new Array(this.count).fill(0);
    for (let own = column - this.bins.binOf(column); own <= column; own += 1) {
      for (const [place, share] of this.#shares(own).entries()) sums[place] += share;
    }
    return momentsOf(sums);
  }
}

/** @param {number[]} values */
function momentsOf(values) {
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  return { mean, variance: values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length };
}

/**
 * Of all pairs of a shape of one group and one of another, the share in which the first has more.
 * @param {Point[]} points
 * @param {Point[]} others
 */
export function shareAhead(points, others) {
  let [place, below, total] = [0, 0, 0];
  for (const { value, weight } of points) {
    for (; place < others.length && others[place].value < value; place += 1) below += others[place].weight;
    let equal = 0;
    for (let at = place; at < others.length && others[at].value === value; at += 1) equal += others[at].weight;
    total += weight * (below + equal / 2);
  }
  return total / (weightOf(points) * weightOf(others));
}

/**
 * The share of a group that has more than so much.
 * @param {Point[]} points
 * @param {number} limit
 */
export function shareAbove(points, limit) {
  return weightOf(points.filter(({ value }) => value > limit)) / weightOf(points);
}

/** @param {Point[]} points */
export function weightOf(points) {
  return points.reduce((sum, { weight }) => sum + weight, 0);
}
