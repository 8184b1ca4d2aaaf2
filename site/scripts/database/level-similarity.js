// Similar shapes in a database that has more values than a page can hold. Where all shapes lie along the first principal
// components of each feature says which ones may be similar; of these, the values themselves say how much.

import { part } from "../base/chunks.js";
import { entry } from "../base/entry.js";
import { LevelBins } from "./level-bins.js";
import { levelsOf } from "./levels.js";
import { first, Similarity, weightOf } from "./similarity.js";

/** @import { Bins } from "./bins.js" */
/** @import { Choice, Similar } from "./similarity.js" */

/**
 * Squared differences of all shapes from one in a feature, in units of what they count.
 * @typedef {{ squared: Int32Array, unit: number }} Nearness
 */

/** So many times as many shapes as are wanted are looked at anew, and at least as many as a list shows. */
const LOOKED_AT = 2;
const LEAST_LOOKED_AT = 48;

/**
 * How similar shapes are found: among all that is known, or part by part.
 * @param {Bins} bins
 */
export function similarityOf(bins) {
  return bins instanceof LevelBins ? new LevelSimilarity(bins) : new Similarity(bins);
}

export class LevelSimilarity {
  /** @param {LevelBins} bins */
  constructor(bins) {
    this.bins = bins;
  }

  /** @type {Map<number, Promise<Chunk.ComponentPart>>} */
  #components = new Map();
  /** @type {{ row: number, near: Map<number, Promise<Nearness>> }} of the last shape: readers try several choices on one */
  #last = { row: -1, near: new Map() };

  /**
   * As of Similarity, but that shapes may be missed that are hardly more similar than the last.
   * @param {number} row
   * @param {Choice} choice
   * @param {number} count
   * @returns {Promise<Similar[]>}
   */
  async rank(row, choice, count) {
    return this.tell(row, await this.nearest(row, choice, count), choice);
  }

  /**
   * @param {number} row
   * @param {number[]} others
   * @param {Choice} choice
   * @returns {Promise<Similar[]>}
   */
  async tell(row, others, choice) {
    const [squared, near] = await Promise.all([
      this.#squared(row, others, choice),
      this.#near(row, [...this.bins.features.keys()]),
    ]);
    const closer = near.map((own) => sharesFarther(own.squared, row, others));
    return others.map((other, place) => ({
      row: other,
      distance: Math.sqrt(squared[place]),
      closer: closer.map((shares) => shares[place]),
    }));
  }

  /**
   * @param {number} row
   * @param {Choice} choice
   * @param {number} count
   * @param {(row: number) => boolean} [among]
   */
  async nearest(row, choice, count, among) {
    if (choice.columns) return first(await this.#byColumns(row, choice.columns), row, count, among);
    const total = new Float64Array(this.bins.shapes);
    for (const { squared: own, unit } of await this.#near(row, choice.features))
      for (let other = 0; other < total.length; other += 1) total[other] += own[other] * unit;
    const found = first(total, row, Math.max(LOOKED_AT * count, LEAST_LOOKED_AT), among);
    const squared = await this.#squared(row, found, choice);
    const order = [...found.keys()].sort((a, b) => squared[a] - squared[b] || found[a] - found[b]);
    return order.slice(0, count).map((place) => found[place]);
  }

  /**
   * @param {number} row
   * @param {number} other
   * @param {Choice} choice
   */
  async differences(row, other, choice) {
    const { bins } = this;
    await bins.know([row, other]);
    return this.#columns(choice)
      .map((column) => ({
        column,
        squared: (bins.value(column, row) - bins.value(column, other)) ** 2 * this.#weight(column, choice),
      }))
      .filter(({ squared }) => squared > 0);
  }

  /** @param {Choice} choice */
  typical(choice) {
    const { bins } = this;
    const spread = this.#columns(choice).reduce(
      (sum, column) => sum + bins.variance(column) * this.#weight(column, choice),
      0,
    );
    return Math.sqrt((2 * spread * bins.shapes) / Math.max(bins.shapes - 1, 1));
  }

  /**
   * Squared distances of some shapes, by the values themselves.
   * @param {number} row
   * @param {number[]} others
   * @param {Choice} choice
   */
  async #squared(row, others, choice) {
    const { bins } = this;
    await bins.know([row, ...others]);
    const squared = new Float64Array(others.length);
    for (const column of this.#columns(choice)) {
      const unit = bins.stepOf(column) ** 2 * this.#weight(column, choice);
      const own = bins.at(column, row);
      others.forEach((other, place) => (squared[place] += (bins.at(column, other) - own) ** 2 * unit));
    }
    return squared;
  }

  /**
   * The same of all shapes.
   * @param {number} row
   * @param {number[]} columns
   */
  async #byColumns(row, columns) {
    const { bins } = this;
    const total = new Float64Array(bins.shapes);
    for (const column of columns) {
      const levels = await levelsOf(bins, column);
      const unit = bins.stepOf(column) ** 2 * this.#weight(column, { columns });
      const own = levels[row];
      for (let other = 0; other < total.length; other += 1) total[other] += (levels[other] - own) ** 2 * unit;
    }
    return total;
  }

  /**
   * @param {number} row
   * @param {number[]} features
   */
  #near(row, features) {
    if (this.#last.row !== row) this.#last = { row, near: new Map() };
    const { near } = this.#last;
    return Promise.all(
      features.map((feature) =>
        entry(near, feature, async () => {
          const { values, unit } = await entry(this.#components, feature, () => part("components", feature));
          return { squared: squaresFrom(values, row, this.bins.shapes), unit };
        }),
      ),
    );
  }

  /**
   * @param {Choice} choice
   * @returns {number[]}
   */
  #columns({ features, columns }) {
    if (columns) return columns;
    return features.flatMap((feature) => {
      const { start, dimensions, bins } = this.bins.features[feature];
      return Array.from({ length: dimensions * bins }, (_, place) => start + place);
    });
  }

  /**
   * What a squared difference in a column counts.
   * @param {number} column
   * @param {Choice} choice
   */
  #weight(column, { columns }) {
    const { bins } = this;
    return columns ? weightOf(bins, bins.variance(column)) : bins.levels.weights[bins.featureOf(column)];
  }
}

/**
 * Sums of squared differences of all shapes from one, over components that follow each other.
 * @param {Uint8Array} values
 * @param {number} row
 * @param {number} count
 */
export function squaresFrom(values, row, count) {
  const total = new Int32Array(count);
  for (let start = 0; start < values.length; start += count) {
    const own = values[start + row];
    for (let other = 0; other < count; other += 1) {
      const difference = values[start + other] - own;
      total[other] += difference * difference;
    }
  }
  return total;
}

/**
 * For some shapes, the share of all others that are farther away, equally far ones counted half.
 * @param {Int32Array} squared of all shapes from the one of a row
 * @param {number} row
 * @param {number[]} others
 */
export function sharesFarther(squared, row, others) {
  const count = squared.length - 2;
  if (count < 1) return others.map(() => 0.5);
  const marks = Int32Array.from(new Set(others.map((other) => squared[other]))).sort();
  // How many lie between each mark and the one before, and at the mark.
  const [between, at] = [new Uint32Array(marks.length + 1), new Uint32Array(marks.length)];
  for (let other = 0; other < squared.length; other += 1) {
    if (other === row) continue;
    const value = squared[other];
    let [low, high] = [0, marks.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (marks[middle] < value) low = middle + 1;
      else high = middle;
    }
    if (marks[low] === value) at[low] += 1;
    else between[low] += 1;
  }
  /** @type {Map<number, number>} */
  const shares = new Map();
  let farther = between[marks.length];
  for (let place = marks.length - 1; place >= 0; place -= 1) {
    // The shape itself is one of those at its mark.
    shares.set(marks[place], (farther + (at[place] - 1) / 2) / count);
    farther += at[place] + between[place];
  }
  return others.map((other) => /** @type {number} */ (shares.get(squared[other])));
}
