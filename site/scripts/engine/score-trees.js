// Importances in extremely randomised trees: the steps of shapeviz_report/scorers/kernels/extra_trees.py, with the same
// random numbers.

import { Random } from "./random.js";
import { valuesAt } from "./table.js";

const TREES = 1000;

/**
 * Scores of `columns`, all of which vary over the contest's rows.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 * @param {number} seed
 * @returns {Steps<Float64Array>}
 */
export function* scoreByTrees(table, contest, columns, seed) {
  const forest = new Forest(table, contest, columns, seed);
  for (let tree = 1; tree <= TREES; tree += 1) {
    forest.grow();
    yield { progress: tree / TREES };
  }
  return forest.total;
}

class Forest {
  /**
   * @param {FeatureValues} table
   * @param {Contest} contest
   * @param {Int32Array} columns
   * @param {number} seed
   */
  constructor(table, { positive, negative }, columns, seed) {
    const count = positive.length + negative.length;
    this.count = count;
    this.width = columns.length;
    this.candidates = Math.floor(Math.sqrt(this.width));
    this.random = new Random(seed);
    // The rows of the contest only, one column after the other, so that the values of a column lie close together.
    const chosen = [...positive, ...negative];
    this.values = new Float32Array(count * this.width);
    columns.forEach((column, place) => {
      valuesAt(table, column, chosen, this.values.subarray(place * count, (place + 1) * count));
    });
    this.positive = Uint8Array.from({ length: count }, (_, i) => Number(i < positive.length));
    this.total = new Float64Array(this.width);
    this.gains = new Float64Array(this.width);
    this.order = Int32Array.from({ length: this.width }, (_, place) => place);
    this.rows = Int32Array.from({ length: count }, (_, i) => i);
    // The classes and the values of one column of the rows of the node that is cut.
    this.isHit = new Uint8Array(count);
    this.inside = new Float32Array(count);
  }

  /** Grow a tree, and add its share of the importances. */
  grow() {
    this.gains.fill(0);
    const nodes = [[0, this.count]];
    for (let node = nodes.pop(); node !== undefined; node = nodes.pop()) {
      const [begin, end] = node;
      const middle = this.cut(begin, end);
      if (middle > 0) nodes.push([begin, middle], [middle, end]);
    }
    const whole = this.gains.reduce((sum, gain) => sum + gain, 0);
    if (whole > 0)
      for (let place = 0; place < this.width; place += 1) this.total[place] += this.gains[place] / whole / TREES;
  }

  /**
   * Cut a node in two; returns the place in `rows` where the second part begins, 0 if there is nothing to cut.
   * @param {number} begin
   * @param {number} end
   */
  cut(begin, end) {
    const { values, rows, order, random, isHit, inside, count, width, candidates } = this;
    const size = end - begin;
    let hits = 0;
    for (let i = 0; i < size; i += 1) {
      isHit[i] = this.positive[rows[begin + i]];
      hits += isHit[i];
    }
    if (hits === 0 || hits === size) return 0;
    // n times the impurity of a node of n rows, p of them positive, is 2 p (n - p) / n.
    const impurity = (2 * hits * (size - hits)) / size;
    let bestGain = -1;
    let bestColumn = -1;
    let bestThreshold = 0;
    for (let drawn = 0, varying = 0; varying < candidates && drawn < width; drawn += 1) {
      const pick = drawn + random.below(width - drawn);
      const column = order[pick];
      order[pick] = order[drawn];
      order[drawn] = column;
      const start = column * count;
      let low = Infinity;
      let high = -Infinity;
      for (let i = 0; i < size; i += 1) {
        const value = values[start + rows[begin + i]];
        inside[i] = value;
        if (value < low) low = value;
        if (value > high) high = value;
      }
      if (low === high) continue;
      varying += 1;
      let threshold = Math.fround(low + random.uniform() * (high - low));
      if (threshold >= high) threshold = low; // by rounding
      let below = 0;
      let belowHits = 0;
      for (let i = 0; i < size; i += 1) {
        if (inside[i] <= threshold) {
          below += 1;
          belowHits += isHit[i];
        }
      }
      const above = size - below;
      const aboveHits = hits - belowHits;
      let rest = (2 * belowHits * (below - belowHits)) / below;
      rest += (2 * aboveHits * (above - aboveHits)) / above;
      if (impurity - rest > bestGain) {
        bestGain = impurity - rest;
        bestColumn = column;
        bestThreshold = threshold;
      }
    }
    if (bestColumn < 0) return 0;
    this.gains[bestColumn] += bestGain;
    const start = bestColumn * count;
    let middle = begin;
    for (let place = begin; place < end; place += 1) {
      const row = rows[place];
      if (values[start + row] <= bestThreshold) {
        rows[place] = rows[middle];
        rows[middle] = row;
        middle += 1;
      }
    }
    return middle;
  }
}
