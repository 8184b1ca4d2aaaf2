// Randomised logistic regression: the steps of shapeviz_report/scorers/logistic.py and kernels/stability.py, which say them
// in full, with the same random numbers.

import { standardise } from "./balance.js";
import { Random } from "./random.js";

const PAIRS = 50;
const MOST = 200;
const STRENGTHS = Array.from({ length: 6 }, (_, step) => 0.64 ** (step + 1));
const WEAKEST = 0.5;
const TOLERANCE = 1e-4;
const MOST_STEPS = 50;
const MOST_SWEEPS = 1000;

/**
 * Scores of `columns`, all of which vary over the contest's rows.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 * @param {number} seed
 * @returns {Steps<Float64Array>}
 */
export function* scoreByLogistic(table, contest, columns, seed) {
  const { values, count, hits } = standardise(table, contest, columns);
  const width = columns.length;
  const random = new Random(seed);
  const selected = new Float64Array(width);
  const order = Int32Array.from({ length: count }, (_, i) => i);
  const first = order.subarray(0, hits);
  const second = order.subarray(hits);
  const taken = Math.min((hits + 1) >> 1, MOST);
  const others = Math.min((count - hits + 1) >> 1, MOST);
  const run = new LassoPath(width, taken, others);
  for (let pair = 0; pair < PAIRS; pair += 1) {
    shuffle(first, random);
    shuffle(second, random);
    for (let half = 0; half < 2; half += 1) {
      // Where a group has an odd number of rows, both halves have the one in the middle.
      const [one, other] = half ? [first.slice(-taken), second.slice(-others)] : [first, second];
      run.sample(values, count, one, other, random);
      for (let step = 0; step < STRENGTHS.length; step += 1) {
        yield* run.fit(STRENGTHS[step], (2 * pair + half + (step + 1) / STRENGTHS.length) / (2 * PAIRS));
        for (let place = 0; place < run.size; place += 1) {
          const column = run.active[place];
          if (run.coefficients[column] !== 0) selected[column] += 1;
        }
      }
    }
  }
  return selected.map((times) => times / (2 * PAIRS * STRENGTHS.length));
}

/**
 * @param {Int32Array} order
 * @param {Random} random
 */
function shuffle(order, random) {
  for (let place = 0; place < order.length; place += 1) {
    const pick = place + random.below(order.length - place);
    const row = order[place];
    order[place] = order[pick];
    order[pick] = row;
  }
}

/** Logistic regressions with a falling L1 penalty on a sample of the rows, each started from the one before. */
class LassoPath {
  // What a sample sets: the penalty above which all is zero, the constant column's curvature, the columns in use.
  highest = 0;
  bend = 0;
  size = 0;

  /**
   * @param {number} width
   * @param {number} hits
   * @param {number} misses
   */
  constructor(width, hits, misses) {
    const count = hits + misses;
    this.width = width;
    this.count = count;
    this.hits = hits;
    this.values = new Float64Array(width * count);
    this.penalties = new Float64Array(width);
    this.coefficients = new Float64Array(width);
    this.gradient = new Float64Array(width);
    this.within = new Uint8Array(width);
    this.active = new Int32Array(width);
    this.bends = new Float64Array(width);
    this.linear = new Float64Array(count);
    this.previous = new Float64Array(width);
    this.residuals = new Float64Array(count);
    this.curvatures = new Float64Array(count);
    this.weights = Float64Array.from({ length: count }, (_, row) => 0.5 / (row < hits ? hits : misses));
  }

  /**
   * Take rows of either group and draw a penalty for each column; all coefficients become zero.
   * @param {Float64Array} values
   * @param {number} rows
   * @param {Int32Array} first
   * @param {Int32Array} second
   * @param {Random} random
   */
  sample(values, rows, first, second, random) {
    const { hits, count, width, weights, residuals, penalties } = this;
    for (let column = 0; column < width; column += 1) {
      const from = column * rows;
      const to = column * count;
      for (let place = 0; place < hits; place += 1) this.values[to + place] = values[from + first[place]];
      for (let place = hits; place < count; place += 1) this.values[to + place] = values[from + second[place - hits]];
      penalties[column] = 1 / (WEAKEST + (1 - WEAKEST) * random.uniform());
    }
    this.coefficients.fill(0);
    this.linear.fill(0);
    this.within.fill(0);
    this.size = 0;
    // With weights that give either group one half, an intercept of 0 is best while there are no coefficients.
    for (let row = 0; row < count; row += 1) residuals[row] = (row < hits ? 0.5 : -0.5) * weights[row];
    this.highest = 0;
    for (let column = 0; column < width; column += 1) {
      this.gradient[column] = this.slope(column);
      this.highest = Math.max(this.highest, Math.abs(this.gradient[column]) / penalties[column]);
    }
  }

  /**
   * Lower the penalty to a part of the least one at which all coefficients are zero.
   * @param {number} strength
   * @param {number} progress
   */
  *fit(strength, progress) {
    if (this.highest < 1e-12) return;
    const now = strength * this.highest;
    const allowed = TOLERANCE * this.highest;
    // Others join those that have wanted a coefficient so far, until none is left that wants one.
    this.join(now, allowed);
    do {
      for (let step = 0; step < MOST_STEPS; step += 1) {
        const violation = this.approximate(now);
        if (violation <= allowed) break;
        this.descend(now, violation);
        yield { progress };
      }
      for (let column = 0; column < this.width; column += 1) this.gradient[column] = this.slope(column);
    } while (this.join(now, allowed) > 0);
  }

  /**
   * Let columns have a coefficient whose slope is above their penalty; returns how many.
   * @param {number} now
   * @param {number} allowed
   */
  join(now, allowed) {
    const before = this.size;
    for (let column = 0; column < this.width; column += 1) {
      if (this.within[column] || Math.abs(this.gradient[column]) <= now * this.penalties[column] + allowed) continue;
      this.within[column] = 1;
      this.active[this.size] = column;
      this.size += 1;
    }
    return this.size - before;
  }

  /**
   * The second-order approximation at the current place; returns by how much the optimum's conditions are violated.
   * @param {number} now
   */
  approximate(now) {
    const { count, hits, weights, linear, curvatures, residuals, coefficients, active, penalties } = this;
    let slope = 0;
    let bend = 0;
    for (let row = 0; row < count; row += 1) {
      const share = 1 / (1 + Math.exp(-linear[row]));
      curvatures[row] = weights[row] * Math.max(share * (1 - share), 1e-9);
      residuals[row] = weights[row] * ((row < hits ? 1 : 0) - share);
      slope += residuals[row];
      bend += curvatures[row];
    }
    this.bend = bend;
    let violation = Math.abs(slope);
    for (let place = 0; place < this.size; place += 1) {
      const column = active[place];
      const pull = this.slope(column);
      const limit = now * penalties[column];
      const excess =
        coefficients[column] === 0 ? Math.abs(pull) - limit : Math.abs(pull - Math.sign(coefficients[column]) * limit);
      violation = Math.max(violation, excess);
    }
    return violation;
  }

  /**
   * Coordinate descent on the approximation; `residuals` become those of it. After the first sweep only those go on that
   * have a coefficient; `approximate` checks everyone.
   * @param {number} now
   * @param {number} violation
   */
  descend(now, violation) {
    const { count, values, curvatures, residuals, linear, bends, previous, active, coefficients, penalties } = this;
    for (let place = 0; place < this.size; place += 1) {
      bends[place] = 0;
      previous[place] = coefficients[active[place]];
    }
    let shift = 0;
    for (let sweep = 0; sweep < MOST_SWEEPS; sweep += 1) {
      let slope = 0;
      for (let row = 0; row < count; row += 1) slope += residuals[row];
      let largest = Math.abs(slope);
      const step = slope / this.bend;
      shift += step;
      for (let row = 0; row < count; row += 1) residuals[row] -= curvatures[row] * step;
      for (let place = 0; place < this.size; place += 1) {
        const column = active[place];
        const before = coefficients[column];
        if (before === 0 && sweep > 0) continue;
        let pull = this.slope(column);
        if (before === 0 && Math.abs(pull) <= now * penalties[column]) continue;
        const start = column * count;
        if (bends[place] === 0) {
          let bend = 0;
          for (let row = 0; row < count; row += 1) {
            const value = values[start + row];
            bend += curvatures[row] * value * value;
          }
          bends[place] = bend;
        }
        pull += bends[place] * before;
        const excess = Math.abs(pull) - now * penalties[column];
        const change = (excess > 0 ? (Math.sign(pull) * excess) / bends[place] : 0) - before;
        if (change === 0) continue;
        coefficients[column] = before + change;
        largest = Math.max(largest, Math.abs(change) * bends[place]);
        for (let row = 0; row < count; row += 1) residuals[row] -= curvatures[row] * (values[start + row] * change);
      }
      if (largest <= 0.1 * violation) break;
    }
    for (let row = 0; row < count; row += 1) linear[row] += shift;
    for (let place = 0; place < this.size; place += 1) {
      const change = coefficients[active[place]] - previous[place];
      if (change === 0) continue;
      const start = active[place] * count;
      for (let row = 0; row < count; row += 1) linear[row] += values[start + row] * change;
    }
  }

  /**
   * The product of a column and the residuals, in four sums that do not wait for each other.
   * @param {number} column
   */
  slope(column) {
    const { count, values, residuals } = this;
    const start = column * count;
    const whole = count - (count % 4);
    let a = 0,
      b = 0,
      c = 0,
      d = 0;
    for (let row = 0; row < whole; row += 4) {
      const at = start + row;
      a += values[at] * residuals[row];
      b += values[at + 1] * residuals[row + 1];
      c += values[at + 2] * residuals[row + 2];
      d += values[at + 3] * residuals[row + 3];
    }
    for (let row = whole; row < count; row += 1) a += values[start + row] * residuals[row];
    return a + b + (c + d);
  }
}
