// The task "contrast": how far groups of shapes are apart, bin by bin, and how far groups dealt at random would be.

import { Random } from "./random.js";

/**
 * Two groups of rows without a common one, and how often they are dealt out anew.
 * @typedef {{ first: Int32Array | number[], second: Int32Array | number[], shuffles: number }} Contest
 *
 * The values of a table, and what a squared difference in each feature counts.
 * @typedef {{ rows: number, values: Float32Array, blocks: Int32Array, weights: number[] }} Given
 *
 * The columns of both groups, first group first, and their spread; `totals` by feature, last of all.
 * @typedef {object} Standard
 * @property {Float32Array} points
 * @property {Float64Array} spread
 * @property {Float64Array} totals
 * @property {Int32Array} blocks the feature of every column
 * @property {number} columns
 * @property {number} count
 * @property {number} features
 *
 * A share of the spread, beside what groups dealt at random have.
 * @typedef {object} Share
 * @property {number} share
 * @property {number} chance mean of the deals
 * @property {number} limit exceeded in one of a hundred
 * @property {number} exceeding share of deals, the observed one included, that reach it
 *
 * @typedef {object} Contrast
 * @property {Float64Array} effect a column's share of the spread between the groups, eta squared: (difference of the means)²
 *   in relation to all squared deviations from the common mean; positive where the first group has more
 * @property {number} limit what the largest effect of any column exceeds in one of a hundred deals
 * @property {Share[]} features the same share for the columns of each feature
 * @property {Share} all and for all columns together
 * @property {Float64Array} away squared distance of every row from the mean of its group, first group first
 */

/** The share of shuffles that may reach a difference which still counts as beyond chance. */
const CHANCE = 0.01;

/** Additions between two reports: a few milliseconds of work. */
const WORK = 4e6;

/**
 * Contrasts between groups of rows, one answer a contest.
 *
 * @param {FeatureValues} _table
 * @param {Given & { contests: Contest[], seed: number }} task
 * @returns {Steps<Contrast[]>}
 */
export function* contrast(_table, { rows, values, blocks, weights, contests, seed }) {
  const answers = [];
  for (const [number, contest] of contests.entries()) {
    const steps = compare({ rows, values, blocks, weights }, contest, seed);
    let step = steps.next();
    while (step.done !== true) {
      yield { progress: (number + step.value) / contests.length };
      step = steps.next();
    }
    answers.push(step.value);
  }
  return answers;
}

/**
 * @param {Given} given
 * @param {Contest} contest
 * @param {number} seed
 * @returns {Generator<number, Contrast, void>}
 */
function* compare(given, { first, second, shuffles }, seed) {
  const standard = standardised(given, first, second);
  const { columns, count } = standard;
  yield 0;
  // Sums over the smaller group say all: the two add up to zero.
  const size = Math.min(first.length, second.length);
  const order = Int32Array.from({ length: count }, (_, place) => place);
  const own = first.length === size ? order.slice(0, size) : order.slice(first.length);
  const sign = first.length === size ? 1 : -1;
  const effect = new Float64Array(columns);
  const observed = shares(standard, own, effect);
  const sums = columnSums(standard, own);
  const away = distances(standard, first.length);
  /** @type {Float64Array[]} */
  const dealt = [];
  const highest = new Float64Array(shuffles);
  const random = new Random(seed);
  const scratch = new Float64Array(columns);
  for (let shuffle = 0, work = 0; shuffle < shuffles; shuffle += 1) {
    deal(order, size, random);
    const found = shares(standard, order.subarray(0, size), scratch);
    dealt.push(found);
    highest[shuffle] = scratch.reduce((most, value) => Math.max(most, value), 0);
    work += columns * size;
    if (work > WORK) {
      work = 0;
      yield shuffle / shuffles;
    }
  }
  const judged = Array.from(observed, (share, place) =>
    judge(
      share,
      dealt.map((found) => found[place]),
    ),
  );
  return {
    effect: effect.map((value, column) => Math.sign(sums[column]) * sign * value),
    limit: atLimit(highest),
    features: judged.slice(0, -1),
    all: judged[judged.length - 1],
    away,
  };
}

/**
 * The columns of both groups, first group first, with mean 0 and squares that add up to 1; constant ones are zero.
 * @param {Given} given
 * @param {ArrayLike<number> & Iterable<number>} first
 * @param {ArrayLike<number> & Iterable<number>} second
 * @returns {Standard}
 */
function standardised({ rows, values, blocks, weights }, first, second) {
  const columns = values.length / rows;
  const chosen = [...first, ...second];
  const count = chosen.length;
  const features = weights.length;
  const points = new Float32Array(columns * count);
  const spread = new Float64Array(columns);
  for (let column = 0; column < columns; column += 1) {
    const start = column * rows;
    let mean = 0;
    for (let place = 0; place < count; place += 1) mean += values[start + chosen[place]] / count;
    let squares = 0;
    for (let place = 0; place < count; place += 1) squares += (values[start + chosen[place]] - mean) ** 2;
    // Below this, single precision knows no difference.
    if (squares <= count * (1e-6 * Math.abs(mean)) ** 2) continue;
    spread[column] = squares * weights[blocks[column]];
    const factor = 1 / Math.sqrt(squares);
    for (let place = 0; place < count; place += 1)
      points[column * count + place] = (values[start + chosen[place]] - mean) * factor;
  }
  const totals = new Float64Array(features + 1);
  for (let column = 0; column < columns; column += 1) {
    totals[blocks[column]] += spread[column];
    totals[features] += spread[column];
  }
  return { points, spread, totals, blocks, columns, count, features };
}

/**
 * @param {Standard} standard
 * @param {Int32Array} own
 */
function columnSums({ points, columns, count }, own) {
  const sums = new Float64Array(columns);
  for (let column = 0; column < columns; column += 1) {
    let sum = 0;
    for (let place = 0; place < own.length; place += 1) sum += points[column * count + own[place]];
    sums[column] = sum;
  }
  return sums;
}

/**
 * Fill `effect`; the shares of all features, and last of all columns.
 * @param {Standard} standard
 * @param {Int32Array} own
 * @param {Float64Array} effect
 */
function shares(standard, own, effect) {
  const { spread, totals, blocks, columns, count, features } = standard;
  const sums = columnSums(standard, own);
  const factor = count / (own.length * (count - own.length));
  const found = new Float64Array(features + 1);
  for (let column = 0; column < columns; column += 1) {
    effect[column] = sums[column] ** 2 * factor;
    found[blocks[column]] += spread[column] * effect[column];
    found[features] += spread[column] * effect[column];
  }
  return found.map((between, place) => (totals[place] > 0 ? between / totals[place] : 0));
}

/**
 * Squared distances from the mean of the own group.
 * @param {Standard} standard
 * @param {number} firstSize
 */
function distances({ points, spread, columns, count }, firstSize) {
  const away = new Float64Array(count);
  for (let column = 0; column < columns; column += 1) {
    const start = column * count;
    for (const [from, to] of [
      [0, firstSize],
      [firstSize, count],
    ]) {
      let mean = 0;
      for (let place = from; place < to; place += 1) mean += points[start + place] / (to - from);
      for (let place = from; place < to; place += 1)
        away[place] += spread[column] * (points[start + place] - mean) ** 2;
    }
  }
  return away;
}

/**
 * Bring a random choice of `size` to the front.
 * @param {Int32Array} order
 * @param {number} size
 * @param {Random} random
 */
function deal(order, size, random) {
  for (let place = 0; place < size; place += 1) {
    const other = place + random.below(order.length - place);
    [order[place], order[other]] = [order[other], order[place]];
  }
}

/**
 * @param {number} share
 * @param {number[]} dealt
 * @returns {Share}
 */
function judge(share, dealt) {
  const reached = dealt.filter((value) => value >= share * (1 - 1e-9)).length;
  return {
    share,
    chance: dealt.length > 0 ? dealt.reduce((sum, value) => sum + value, 0) / dealt.length : 0,
    limit: atLimit(dealt),
    exceeding: (reached + 1) / (dealt.length + 1),
  };
}

/**
 * The value that what is beyond chance has to exceed.
 * @param {ArrayLike<number>} dealt
 */
function atLimit(dealt) {
  const rising = Float64Array.from(dealt).sort();
  return rising[Math.ceil((1 - CHANCE) * (rising.length + 1)) - 1] ?? 1;
}
