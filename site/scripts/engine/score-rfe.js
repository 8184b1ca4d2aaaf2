// Recursive feature elimination with a linear classifier; shapeviz_report/scorers/rfe.py says it in full.

import { standardise } from "./balance.js";

const PENALTY = 10;
const SHARE = 0.1;
const ONE_BY_ONE = 50;
const TIE = 1e-9;

/** The equations of a round are solved until this part of their right side is left, far below what makes a tie. */
const PRECISION = 1e-13;

/** Against running on where rounding allows no better; tens of steps are usual. */
const MOST_STEPS = 1000;

/**
 * Scores of `columns`, all of which vary over the contest's rows.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 * @returns {Steps<Float64Array>}
 */
export function* scoreByRfe(table, contest, columns) {
  const total = columns.length;
  const classifier = new Ridge(standardise(table, contest, columns), total);
  const places = new Float64Array(total);
  let left = Int32Array.from(columns, (_, place) => place);
  while (left.length) {
    yield* classifier.fit(left, 1 - left.length / (total + 1));
    /** @param {number} index */
    const size = (index) => Math.abs(classifier.coefficients[left[index]]);
    const order = Int32Array.from(left.keys()).sort((one, other) => size(one) - size(other));
    const tie = TIE * size(order[order.length - 1]);
    const leaving = left.length > ONE_BY_ONE ? Math.floor(SHARE * left.length) : 1;
    // Columns with equal coefficients leave together and share the mean of their places.
    let start = 0;
    while (start < leaving) {
      let end = start + 1;
      while (end < order.length && size(order[end]) - size(order[end - 1]) <= tie) end += 1;
      const place = total - left.length + (start + 1 + end) / 2;
      for (let i = start; i < end; i += 1) places[left[order[i]]] = place;
      start = end;
    }
    const gone = new Set(order.subarray(0, start));
    left = left.filter((_, index) => !gone.has(index));
  }
  return places.map((place) => place / total);
}

/**
 * Ridge regression by conjugate gradients. The penalty keeps the equations so well conditioned that tens of steps solve them
 * to the last digits, each of which takes two passes over the columns; and the coefficients of one round are a
 * good start for the next.
 */
class Ridge {
  /**
   * @param {ReturnType<typeof standardise>} standard
   * @param {number} total
   */
  constructor({ values, weights, count, hits }, total) {
    this.values = values;
    this.count = count;
    this.coefficients = new Float64Array(total);
    this.residual = new Float64Array(total);
    this.direction = new Float64Array(total);
    this.image = new Float64Array(total);
    this.ofRows = new Float64Array(count);
    // The columns times the target, and the columns times the roots of the weights.
    this.aims = new Float64Array(total);
    const roots = weights.map(Math.sqrt);
    for (let place = 0; place < total; place += 1) {
      const start = place * count;
      let aim = 0;
      for (let i = 0; i < count; i += 1) {
        values[start + i] *= roots[i];
        aim += values[start + i] * (i < hits ? roots[i] : -roots[i]);
      }
      this.aims[place] = aim;
    }
  }

  /**
   * Find the coefficients of the columns `left`.
   * @param {Int32Array} left
   * @param {number} progress
   */
  *fit(left, progress) {
    const { coefficients, residual, direction, image, aims } = this;
    const penalty = (PENALTY * left.length) / this.count;
    this.multiply(left, coefficients, penalty);
    let goal = 0;
    let length = 0;
    for (const place of left) {
      residual[place] = aims[place] - image[place];
      direction[place] = residual[place];
      length += residual[place] * residual[place];
      goal += aims[place] * aims[place];
    }
    goal *= PRECISION * PRECISION;
    for (let step = 0; step < MOST_STEPS && length > goal; step += 1) {
      yield { progress };
      this.multiply(left, direction, penalty);
      let along = 0;
      for (const place of left) along += direction[place] * image[place];
      const move = length / along;
      let next = 0;
      for (const place of left) {
        coefficients[place] += move * direction[place];
        residual[place] -= move * image[place];
        next += residual[place] * residual[place];
      }
      for (const place of left) direction[place] = residual[place] + (next / length) * direction[place];
      length = next;
    }
    yield { progress };
  }

  /**
   * `image` = (X'X + penalty) `vector`, for the columns `left`.
   * @param {Int32Array} left
   * @param {Float64Array} vector
   * @param {number} penalty
   */
  multiply(left, vector, penalty) {
    const { values, count, ofRows, image } = this;
    ofRows.fill(0);
    for (const place of left) {
      const factor = vector[place];
      const start = place * count;
      for (let i = 0; i < count; i += 1) ofRows[i] += factor * values[start + i];
    }
    for (const place of left) {
      const start = place * count;
      let sum = 0;
      for (let i = 0; i < count; i += 1) sum += ofRows[i] * values[start + i];
      image[place] = sum + penalty * vector[place];
    }
  }
}
