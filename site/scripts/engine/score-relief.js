// The weights of iterative Relief; shapeviz_report/scorers/relief.py says in full what they are.

import { valuesAt } from "./table.js";

/**
 * The rows that are compared, one after the other: those of the first group first, `count` in all, then empty ones up to
 * the `stride`, a multiple of `WIDE`.
 * @typedef {{ count: number, stride: number, positives: number, values: Float32Array }} Sample
 */

const KERNEL = 0.1;
const ROWS = 400;
const SETTLED = 3e-3;
const MOST_ROUNDS = 30;

/** Rows against rows that are taken together in the sums over all pairs, so that each value read serves several. */
const TALL = 2;
const WIDE = 4;

/**
 * Scores of `columns`, all of which vary over the contest's rows.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 * @returns {Steps<Float64Array>}
 */
export function* scoreByRelief(table, contest, columns) {
  const sample = yield* spreadRows(table, contest, columns);
  const width = columns.length;
  let weights = new Float64Array(width).fill(1 / Math.sqrt(width));
  let before = new Float64Array(width);
  let step = 1;
  let settled = 0;
  for (let round = 0; round < MOST_ROUNDS; round += 1) {
    // How far the weights still move tells most of the progress; each of a round's two sums over pairs adds a little.
    /** @param {number} part */
    const report = (part) => ({ progress: settled + (1 - settled) * 0.3 * part });
    const distances = yield* pairDistances(sample, weights, (part) => report(part / 2));
    const shares = pairShares(distances, sample);
    const margins = yield* pairDifferences(sample, width, shares, (part) => report((1 + part) / 2));
    const widening = margins.map((margin) => Math.max(margin, 0));
    const length = norm(widening);
    if (length === 0) return widening;
    const move = widening.map((value, k) => value / length - weights[k]);
    const moved = norm(move);
    if (moved < SETTLED) break;
    // Two columns that each need the other can take turns for ever: shorter steps meet in the middle.
    if (move.reduce((sum, value, k) => sum + value * before[k], 0) < 0) step /= 2;
    before = move;
    const next = weights.map((weight, k) => weight + step * move[k]);
    const size = norm(next);
    weights = next.map((weight) => weight / size);
    settled = Math.min(Math.max(Math.log(moved) / Math.log(SETTLED), 0), 0.95);
  }
  return weights;
}

/** @param {Float64Array} vector */
function norm(vector) {
  return Math.sqrt(vector.reduce((sum, value) => sum + value * value, 0));
}

/**
 * The rows that are compared: at most `ROWS`, spread evenly by the sums of their values, each column divided by its
 * range over all rows of the contest.
 *
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 * @returns {Steps<Sample>}
 */
function* spreadRows(table, { positive, negative }, columns) {
  const width = columns.length;
  const all = [...positive, ...negative];
  const lows = new Float64Array(width);
  const ranges = new Float64Array(width);
  const sums = new Float64Array(all.length);
  const own = new Float32Array(all.length);
  for (let k = 0; k < width; k += 1) {
    valuesAt(table, columns[k], all, own);
    let low = Infinity;
    let high = -Infinity;
    for (const value of own) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
    lows[k] = low;
    ranges[k] = high - low;
    for (let i = 0; i < all.length; i += 1) sums[i] += (own[i] - low) / ranges[k];
    if (k % 256 === 255) yield { progress: 0 };
  }
  const places = Int32Array.from(all.keys());
  const groups = [places.subarray(0, positive.length), places.subarray(positive.length)];
  const most = Math.max(ROWS / 2, ROWS - Math.min(positive.length, negative.length));
  const chosen = groups.map((group) => {
    const count = Math.min(group.length, most);
    const ordered = [...group].sort((a, b) => sums[a] - sums[b]);
    return Array.from({ length: count }, (_, i) => ordered[Math.floor(((i + 0.5) * group.length) / count)]);
  });
  const count = chosen[0].length + chosen[1].length;
  const stride = Math.ceil(count / WIDE) * WIDE;
  const scaled = new Float32Array(stride * width);
  const held = new Float32Array(count);
  const rows = chosen.flat().map((place) => all[place]);
  for (let k = 0; k < width; k += 1) {
    valuesAt(table, columns[k], rows, held);
    for (let i = 0; i < count; i += 1) scaled[i * width + k] = (held[i] - lows[k]) / ranges[k];
  }
  return { count, stride, positives: chosen[0].length, values: scaled };
}

/**
 * Sums over the columns of weighted absolute differences between all rows; (stride, stride), symmetric.
 *
 * @param {Sample} sample
 * @param {Float64Array} weights
 * @param {(part: number) => { progress: number }} report
 * @returns {Steps<Float64Array>}
 */
function* pairDistances({ count, stride, values }, weights, report) {
  const used = Int32Array.from(weights.keys()).filter((k) => weights[k] > 0);
  const width = used.length;
  const weighted = new Float32Array(stride * width);
  for (let i = 0; i < count; i += 1) {
    for (let k = 0; k < width; k += 1) {
      weighted[i * width + k] = values[i * weights.length + used[k]] * Math.fround(weights[used[k]]);
    }
  }
  const distances = new Float64Array(stride * stride);
  const sums = new Float64Array(TALL * WIDE);
  for (let i = 0; i < count; i += TALL) {
    for (let j = 0; j < i + TALL; j += WIDE) {
      addDistances(sums, weighted, width, i, j);
      for (let place = 0; place < sums.length; place += 1) {
        const one = i + Math.floor(place / WIDE);
        const other = j + (place % WIDE);
        distances[one * stride + other] = sums[place];
        distances[other * stride + one] = sums[place];
      }
    }
    yield report(Math.min((i + TALL) / count, 1) ** 2);
  }
  return distances;
}

/**
 * @param {Float64Array} sums
 * @param {Float32Array} values
 * @param {number} width
 * @param {number} row
 * @param {number} column
 */
function addDistances(sums, values, width, row, column) {
  const [i, j] = [row * width, (row + 1) * width];
  const [a, b, c, d] = [column * width, (column + 1) * width, (column + 2) * width, (column + 3) * width];
  let ia = 0;
  let ib = 0;
  let ic = 0;
  let id = 0;
  let ja = 0;
  let jb = 0;
  let jc = 0;
  let jd = 0;
  for (let k = 0; k < width; k += 1) {
    const first = values[i + k];
    const second = values[j + k];
    let other = values[a + k];
    ia += Math.abs(first - other);
    ja += Math.abs(second - other);
    other = values[b + k];
    ib += Math.abs(first - other);
    jb += Math.abs(second - other);
    other = values[c + k];
    ic += Math.abs(first - other);
    jc += Math.abs(second - other);
    other = values[d + k];
    id += Math.abs(first - other);
    jd += Math.abs(second - other);
  }
  [sums[0], sums[1], sums[2], sums[3], sums[4], sums[5], sums[6], sums[7]] = [ia, ib, ic, id, ja, jb, jc, jd];
}

/**
 * What each pair counts, negative for rows of one group; both directions together at [i, j] with j < i.
 * @param {Float64Array} distances
 * @param {Sample} sample
 */
function pairShares(distances, { count, stride, positives }) {
  const shares = new Float64Array(stride * stride);
  let mean = 0;
  for (let i = 0; i < count; i += 1) {
    for (let j = 0; j < count; j += 1) mean += distances[i * stride + j] / (count * (count - 1));
  }
  if (mean === 0) return shares;
  const kernel = KERNEL * mean;
  for (let i = 0; i < count; i += 1) {
    const own = i < positives ? [0, positives] : [positives, count];
    const other = i < positives ? [positives, count] : [0, positives];
    const hits = nearness(distances, i, stride, own, kernel);
    const misses = nearness(distances, i, stride, other, kernel);
    // The probability that the nearest row of all is of the same group, as if both groups were of the same size.
    const advantage =
      Math.log(hits.total / (own[1] - own[0] - 1) / (misses.total / (other[1] - other[0]))) +
      (misses.nearest - hits.nearest) / kernel;
    const noOutlier = hits.total === 0 ? 1 : 1 / (1 + Math.exp(-advantage));
    const counts = (0.5 / (own[1] - own[0])) * noOutlier;
    for (let j = own[0]; j < own[1]; j += 1)
      if (j !== i) shares[i * stride + j] = (-counts * hits.likely[j - own[0]]) / hits.total;
    for (let j = other[0]; j < other[1]; j += 1)
      shares[i * stride + j] = (counts * misses.likely[j - other[0]]) / misses.total;
  }
  for (let i = 0; i < count; i += 1) {
    for (let j = 0; j < i; j += 1) {
      shares[i * stride + j] += shares[j * stride + i];
      shares[j * stride + i] = 0;
    }
  }
  return shares;
}

/**
 * How likely each row of a group is the nearest to row i, up to the factor `total`.
 * @param {Float64Array} distances
 * @param {number} i
 * @param {number} stride
 * @param {number[]} rows from the first up to the last
 * @param {number} kernel
 */
function nearness(distances, i, stride, rows, kernel) {
  const [begin, end] = rows;
  let nearest = Infinity;
  for (let j = begin; j < end; j += 1) if (j !== i) nearest = Math.min(nearest, distances[i * stride + j]);
  const likely = new Float64Array(end - begin);
  let total = 0;
  for (let j = begin; j < end; j += 1) {
    if (j === i) continue;
    likely[j - begin] = Math.exp((nearest - distances[i * stride + j]) / kernel);
    total += likely[j - begin];
  }
  return { nearest, likely, total };
}

/**
 * Sums over all pairs of rows of their absolute differences in each column, each pair with its share.
 *
 * @param {Sample} sample
 * @param {number} width
 * @param {Float64Array} shares
 * @param {(part: number) => { progress: number }} report
 * @returns {Steps<Float64Array>}
 */
function* pairDifferences({ count, stride, values }, width, shares, report) {
  const total = new Float64Array(width);
  for (let i = 0; i < count; i += TALL) {
    for (let j = 0; j < i + TALL; j += WIDE) addDifferences(total, values, shares, stride, i, j);
    yield report(Math.min((i + TALL) / count, 1) ** 2);
  }
  return total;
}

/**
 * @param {Float64Array} total
 * @param {Float32Array} values
 * @param {Float64Array} shares
 * @param {number} stride
 * @param {number} row
 * @param {number} column
 */
function addDifferences(total, values, shares, stride, row, column) {
  const width = total.length;
  const [i, j] = [row * width, (row + 1) * width];
  const [a, b, c, d] = [column * width, (column + 1) * width, (column + 2) * width, (column + 3) * width];
  const [ia, ib, ic, id] = shares.subarray(row * stride + column, row * stride + column + WIDE);
  const [ja, jb, jc, jd] = shares.subarray((row + 1) * stride + column, (row + 1) * stride + column + WIDE);
  for (let k = 0; k < width; k += 1) {
    const first = values[i + k];
    const second = values[j + k];
    let other = values[a + k];
    let sum = ia * Math.abs(first - other) + ja * Math.abs(second - other);
    other = values[b + k];
    sum += ib * Math.abs(first - other) + jb * Math.abs(second - other);
    other = values[c + k];
    sum += ic * Math.abs(first - other) + jc * Math.abs(second - other);
    other = values[d + k];
    sum += id * Math.abs(first - other) + jd * Math.abs(second - other);
    total[k] += sum;
  }
}
