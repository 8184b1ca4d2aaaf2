// Rows as points whose Euclidean distances the layouts compare, and those distances.

import { reader, valuesAt } from "./table.js";

/**
 * Rows as points, one row after the other.
 * @typedef {{ count: number, width: number, values: Float32Array }} Points
 */

/** Products between two reports: a few milliseconds of work. */
const WORK = 4e6;

/** A spread below this is rounding: the column or feature counts as constant. */
const NO_SPREAD = 1e-12;

/**
 * The chosen rows and columns, scaled.
 *
 * For a choice of features, each is divided by its root mean square norm, as shapeviz_report/presets.py does, so that
 * each contributes its weight; for a choice of bins each column is divided by its standard deviation. Both are taken over
 * all rows of the table, so that leaving out classes does not change what near means. "plain" tables stay as they are.
 *
 * @param {FeatureValues} table
 * @param {Int32Array} rows
 * @param {Int32Array} columns
 * @param {"features"|"bins"} by
 * @returns {Points}
 */
export function scaledPoints(table, rows, columns, by) {
  const width = columns.length;
  const points = { count: rows.length, width, values: new Float32Array(rows.length * width) };
  const factors = factorsOf(table, columns, by);
  const held = new Float32Array(rows.length);
  for (let place = 0; place < width; place++) {
    valuesAt(table, columns[place], rows, held);
    for (let row = 0; row < rows.length; row++) points.values[row * width + place] = held[row] * factors[place];
  }
  return points;
}

/**
 * By what the values of each of the columns are multiplied there.
 * @param {FeatureValues} table
 * @param {Int32Array} columns
 * @param {"features" | "bins"} by
 */
export function factorsOf(table, columns, by) {
  if (table.scaling === "plain") return new Float64Array(columns.length).fill(1);
  const variances = Float64Array.from(columns, (column) => variance(table, column));
  if (by === "features") {
    /** @type {Map<number, number>} */
    const totals = new Map();
    columns.forEach((column, place) => {
      const block = table.blocks[column];
      totals.set(block, (totals.get(block) ?? 0) + variances[place]);
    });
    columns.forEach((column, place) => (variances[place] = totals.get(table.blocks[column]) ?? 0));
  }
  return variances.map((value, place) =>
    Math.sqrt(value) > NO_SPREAD
      ? Math.sqrt((by === "features" ? table.weights[table.blocks[columns[place]]] : 1) / value)
      : 0,
  );
}

/**
 * @param {FeatureValues} table
 * @param {number} column
 */
function variance(table, column) {
  const { rows } = table;
  const read = reader(table, column);
  let mean = 0,
    total = 0;
  for (let row = 0; row < rows; row++) mean += read(row) / rows;
  for (let row = 0; row < rows; row++) total += (read(row) - mean) ** 2;
  return total / rows;
}

/**
 * Squared distances of all pairs: Float64Array (n n).
 * @param {Points} points
 * @returns {Steps<Float64Array>}
 */
export function* squaredDistances(points) {
  const { count } = points;
  const squared = new Float64Array(count * count);
  yield* visitPairs(points, (row, other, distance) => {
    squared[row * count + other] = distance;
    squared[other * count + row] = distance;
  });
  return squared;
}

/**
 * The k nearest other rows of every row, nearest first.
 *
 * @param {Points} points
 * @param {number} k
 * @returns {Steps<{ k: number, rows: Int32Array, squared: Float64Array }>} k entries for each row
 */
export function* nearestRows(points, k) {
  const rows = new Int32Array(points.count * k).fill(-1);
  const squared = new Float64Array(points.count * k).fill(Infinity);
  /**
   * @param {number} row
   * @param {number} other
   * @param {number} distance
   */
  const offer = (row, other, distance) => {
    const first = row * k;
    let place = first + k - 1;
    if (!(distance < squared[place])) return;
    for (; place > first && squared[place - 1] > distance; place--) {
      squared[place] = squared[place - 1];
      rows[place] = rows[place - 1];
    }
    squared[place] = distance;
    rows[place] = other;
  };
  yield* visitPairs(points, (row, other, distance) => {
    offer(row, other, distance);
    offer(other, row, distance);
  });
  return { k, rows, squared };
}

/**
 * Hand every pair of rows, `other` before `row`, and their squared distance to `visit`.
 * @param {Points} points
 * @param {(row: number, other: number, distance: number) => void} visit
 * @returns {Steps<void>}
 */
function* visitPairs({ count, width, values }, visit) {
  // Two rows against two at a time: every value that is read serves twice, which halves the time.
  let work = 0;
  for (let row = 0; row < count; row += 2) {
    const first = row * width;
    // The last of an odd number of rows stands for its missing partner.
    const second = row + 1 < count ? first + width : first;
    for (let other = 0; other <= row; other += 2) {
      const third = other * width;
      const fourth = other + 1 < count ? third + width : third;
      let ac = 0,
        ad = 0,
        bc = 0,
        bd = 0;
      for (let place = 0; place < width; place++) {
        const a = values[first + place],
          b = values[second + place];
        const c = values[third + place],
          d = values[fourth + place];
        ac += (a - c) * (a - c);
        ad += (a - d) * (a - d);
        bc += (b - c) * (b - c);
        bd += (b - d) * (b - d);
      }
      if (other < row) {
        visit(row, other, ac);
        visit(row, other + 1, ad);
        if (row + 1 < count) visit(row + 1, other + 1, bd);
      }
      if (row + 1 < count) visit(row + 1, other, bc);
      work += 4 * width;
      if (work > WORK) {
        work = 0;
        yield { progress: (row / count) ** 2 };
      }
    }
  }
}
