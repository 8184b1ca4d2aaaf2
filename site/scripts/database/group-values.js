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

  moments() {
    const { bins, rows, count } = this;
    const [means, variances] = [new Float64Array(bins.count), new Float64Array(bins.count)];
    for (let column = 0; column < bins.count; column += 1) {
      const { mean, variance } = momentsOf(rows.map((row) => bins.value(column, row)));
      [means[column], variances[column]] = [mean, variance];
    }
    return { count, means, variances };
  }

  /** @param {number} column */
  mean(column) {
    return momentsOf(this.rows.map((row) => this.bins.share(column, row))).mean;
  }

  /** @param {number} column */
  points(column) {
    return this.rows
      .map((row) => ({ value: this.bins.share(column, row), weight: 1 }))
      .sort((one, other) => one.value - other.value);
  }

  /** @param {number} column */
  upTo(column) {
    const { bins, rows } = this;
    const start = column - bins.binOf(column);
    return momentsOf(
      rows.map((row) => {
        let sum = 0;
        for (let own = start; own <= column; own += 1) sum += bins.share(own, row);
        return sum;
      }),
    );
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
