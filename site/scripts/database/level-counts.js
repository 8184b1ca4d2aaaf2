// How the values of groups of shapes are spread in a database that has more of them than a page can hold: from what the
// build has counted class by class.

import { part } from "../base/chunks.js";
import { STEPS } from "./levels.js";

/** @import { GroupValues, RowValues } from "./group-values.js" */
/** @import { LevelBins } from "./level-bins.js" */

/** A group of whole classes is read from so many parts at most: each is 100 kB. */
const MOST_READ = 12;

/**
 * The values of some shapes that are whole classes, or all but whole classes, where these are few; else null, at once.
 * @param {LevelBins} bins
 * @param {number[]} shapes
 * @param {{ groups: ArrayLike<number>, sizes: Map<number, number>, classes: string[] }} database
 * @returns {Promise<CountedValues> | null}
 */
export function countedClasses(bins, shapes, { groups, sizes, classes }) {
  // From -1 on, which stands for no class.
  const held = new Uint32Array(classes.length + 1);
  for (const shape of shapes) held[groups[shape] + 1] += 1;
  const [inside, outside] = [true, false].map((wanted) =>
    [...sizes.keys()].filter((group) => held[group + 1] > 0 === wanted),
  );
  if (inside.some((group) => held[group + 1] !== sizes.get(group))) return null;
  /**
   * @param {number[]} codes
   * @param {"with" | "without"} joining
   */
  const read = async (codes, joining) => {
    const [first, ...rest] = await Promise.all(codes.map((code) => readCounts(bins, code)));
    return rest.reduce((sum, own) => sum[joining](own), first);
  };
  // Those without a class are counted with all shapes only.
  const [ways, others] = [inside, outside].map((own) => (own.includes(-1) ? Infinity : 0));
  if (Math.min(inside.length + ways, outside.length + 1 + others) > MOST_READ) return null;
  return inside.length + ways <= outside.length + 1 + others
    ? read(inside, "with")
    : read([classes.length, ...outside], "without");
}

/**
 * The values of a class; of all shapes, by the number of classes.
 * @param {LevelBins} bins
 * @param {number} code
 */
export async function readCounts(bins, code) {
  return new CountedValues(bins, await part("classes", code));
}

/**
 * The values of some shapes as counts of levels.
 * @implements {GroupValues}
 */
export class CountedValues {
  /**
   * @param {LevelBins} bins
   * @param {Pick<Chunk.ClassPart, "shapes"> & Record<"means" | "variances" | "upTo" | "cells", ArrayLike<number>>} counted
   */
  constructor(bins, counted) {
    this.bins = bins;
    this.counted = counted;
    this.count = counted.shapes;
    this.each = false;
  }

  /**
   * The same from values of single shapes.
   * @param {RowValues} values
   * @param {LevelBins} bins
   */
  static of(values, bins) {
    const { count } = values;
    const { levelsACell } = bins.levels;
    const cellsAColumn = Math.ceil((STEPS + 1) / levelsACell);
    const [means, variances, upTo] = Array.from({ length: 3 }, () => new Float64Array(bins.count));
    const cells = new Uint32Array(bins.count * cellsAColumn);
    for (let column = 0; column < bins.count; column += 1) {
      const own = values.steps(column);
      for (const level of own) {
        cells[column * cellsAColumn + Math.floor(level / levelsACell)] += 1;
        means[column] += level / count;
      }
      for (const level of own) variances[column] += (level - means[column]) ** 2 / count;
      if (bins.isShare(column)) upTo[column] = values.upTo(column).variance;
    }
    return new CountedValues(bins, { shapes: count, means, variances, upTo, cells });
  }

  moments() {
    const { bins, count, counted } = this;
    return {
      count,
      means: Float64Array.from(counted.means, (mean, column) => bins.valueAt(column, mean)),
      variances: Float64Array.from(counted.variances, (variance, column) => variance * bins.stepOf(column) ** 2),
    };
  }

  /** @param {number} column */
  mean(column) {
    const { bins, counted } = this;
    const share = bins.shareAt(column, counted.means[column]);
    // The mean of squares is the square of the mean and the variance.
    return bins.isSquare(column) ? share + counted.variances[column] * bins.stepOf(column) ** 2 : share;
  }

  /** @param {number} column */
  points(column) {
    const { bins } = this;
    const { levelsACell } = bins.levels;
    const first = (column * this.counted.cells.length) / bins.count;
    const points = [];
    for (let level = 0; level <= STEPS; level += 1) {
      const shapes = this.counted.cells[first + Math.floor(level / levelsACell)];
      // Within a cell they lie evenly.
      if (shapes > 0) points.push({ value: bins.shareAt(column, level), weight: shapes / levelsACell });
    }
    return points;
  }

  /** @param {number} column */
  upTo(column) {
    let mean = 0;
    for (let own = column - this.bins.binOf(column); own <= column; own += 1) mean += this.mean(own);
    return { mean, variance: this.counted.upTo[column] };
  }

  /**
   * Of both, who share no shape.
   * @param {CountedValues} other
   */
  with(other) {
    return this.#combined(other, 1);
  }

  /**
   * Of all but some of them.
   * @param {CountedValues} some
   */
  without(some) {
    return this.#combined(some, -1);
  }

  /**
   * @param {CountedValues} other
   * @param {1 | -1} sign
   */
  #combined(other, sign) {
    const { bins, counted } = this;
    const shapes = this.count + sign * other.count;
    const [own, others] = [this.count / shapes, (sign * other.count) / shapes];
    const [means, variances, upTo] = Array.from({ length: 3 }, () => new Float64Array(bins.count));
    /**
     * @param {number} variance
     * @param {number} theirs
     * @param {number} apart of the means
     */
    const joint = (variance, theirs, apart) =>
      Math.max(own * variance + others * theirs + own * others * apart ** 2, 0);
    for (let column = 0; column < bins.count; column += 1) {
      means[column] = own * counted.means[column] + others * other.counted.means[column];
      variances[column] = joint(
        counted.variances[column],
        other.counted.variances[column],
        counted.means[column] - other.counted.means[column],
      );
      if (bins.isShare(column)) {
        const [first, second] = [this.upTo(column), other.upTo(column)];
        upTo[column] = joint(first.variance, second.variance, first.mean - second.mean);
      }
    }
    // Not `from`, which goes through an iterator.
    const cells = new Uint32Array(counted.cells);
    const added = other.counted.cells;
    for (let cell = 0; cell < cells.length; cell += 1) cells[cell] += sign * added[cell];
    return new CountedValues(bins, { shapes, means, variances, upTo, cells });
  }
}
