// How far a map shows who is like whom by what it compares, without labels; to the letter as
// shapeviz_report/faithfulness.py defines it.

import { scaledPoints, squaredDistances } from "./distances.js";

/** @import { Points } from "./distances.js" */

/** Distances whose squares differ by less than this fraction are equal. */
const TIE = 1e-9;

/** Numbers that are looked at between two reports: a few milliseconds of work. */
const WORK = 4e6;

/** Up to so many shapes all are asked; of more, so many: their distances would take as long as the map. */
const ALL = 1000;
const ASKED = 100;

/**
 * Neighbours kept, false and missing of every shape that is asked (NaN of others), and their means; stress.
 *
 * @param {FeatureValues} table
 * @param {{ rows: Int32Array, columns: Int32Array, by: "features" | "bins", xy: Float32Array | Float64Array, k: number }} parameters
 *   rows, columns, by: what was laid out, see `scaledPoints`; xy (2 n): the map
 * @returns {Steps<{ kept: Float64Array, false: Float64Array, missing: Float64Array, mean: number, chance: number,
 *   trustworthiness: number, continuity: number, random: number, stress: number, randomStress: number }>}
 *   no numbers where nothing is defined: all of one shape; false, missing, trustworthiness, continuity and random where k is
 *   half of the shapes or more; stress of equal shapes
 */
export function* measureFaith(table, { rows, columns, by, xy, k }) {
  const count = rows.length;
  const neighbours = Math.min(k, count - 1);
  const found = { kept: none(count), false: none(count), missing: none(count) };
  const sums = { together: 0, near: 0, shown: 0, apart: 0, far: 0 };
  if (neighbours < 1) return { ...found, ...NOTHING };
  const points = scaledPoints(table, rows, columns, by);
  const asked = count <= ALL ? count : ASKED;
  const whole = asked === count ? yield* squaredDistances(points) : null;
  const [near, shown] = [new Float64Array(count), new Float64Array(count)];
  const work = count * (whole === null ? points.width : 1) + 20 * count;
  const pace = Math.max(Math.floor(WORK / work), 1);
  for (let place = 0; place < asked; place++) {
    if (place % pace === 0) yield { progress: place / asked };
    const row = Math.floor((place * count) / asked);
    if (whole === null) distancesFrom(points, row, near);
    else near.set(whole.subarray(row * count, (row + 1) * count));
    for (let other = 0; other < count; other++) {
      const toX = xy[2 * row] - xy[2 * other];
      const toY = xy[2 * row + 1] - xy[2 * other + 1];
      shown[other] = toX * toX + toY * toY;
      if (other === row) continue;
      const [one, two] = [Math.sqrt(near[other]), Math.sqrt(shown[other])];
      sums.together += one * two;
      sums.near += near[other];
      sums.shown += shown[other];
      sums.apart += one;
      sums.far += two;
    }
    near[row] = Infinity;
    shown[row] = Infinity;
    compare(row, near, shown, neighbours, found);
  }
  return { ...found, ...conclude(found, sums, count, asked, neighbours) };
}

const NOTHING = {
  mean: NaN,
  chance: NaN,
  trustworthiness: NaN,
  continuity: NaN,
  random: NaN,
  stress: NaN,
  randomStress: NaN,
};

/**
 * @param {{ kept: Float64Array, false: Float64Array, missing: Float64Array }} found of false and missing the places, which
 *   become shares
 * @param {{ together: number, near: number, shown: number, apart: number, far: number }} sums over the pairs of those asked
 * @param {number} count
 * @param {number} asked
 * @param {number} k
 */
function conclude(found, { together, near, shown, apart, far }, count, asked, k) {
  const ranked = 2 * k < count;
  const most = ranked ? (k * (2 * count - 3 * k - 1)) / 2 : NaN;
  for (const shares of [found.false, found.missing]) for (let row = 0; row < count; row++) shares[row] /= most;
  const dealt = (apart * far) / (asked * (count - 1));
  /** @param {number} product */
  const stress = (product) =>
    near === 0 ? NaN : shown === 0 ? 1 : Math.sqrt(Math.max(1 - (product * product) / (near * shown), 0));
  return {
    mean: meanOf(found.kept),
    chance: k / (count - 1),
    trustworthiness: 1 - meanOf(found.false),
    continuity: 1 - meanOf(found.missing),
    random: ranked ? 1 - ((count - 1 - k) * (count - k)) / ((count - 1) * (2 * count - 3 * k - 1)) : NaN,
    stress: stress(together),
    randomStress: stress(dealt),
  };
}

/**
 * What the map makes of the neighbours of a row.
 * @param {number} row
 * @param {Float64Array} near squared distances to all others by what is compared
 * @param {Float64Array} shown and on the map
 * @param {number} k
 * @param {{ kept: Float64Array, false: Float64Array, missing: Float64Array }} found
 */
function compare(row, near, shown, k, found) {
  const [own, seen] = [placesOf(near, k), placesOf(shown, k)];
  let [kept, wrong, lost] = [0, 0, 0];
  for (let other = 0; other < near.length; other++) {
    const [one, two] = [shareOf(near[other], own), shareOf(shown[other], seen)];
    kept += Math.min(one, two);
    if (two > one) wrong += (two - one) * beyond(near, near[other], k);
    else if (one > two) lost += (one - two) * beyond(shown, shown[other], k);
  }
  found.kept[row] = kept / k;
  found.false[row] = wrong;
  found.missing[row] = lost;
}

/**
 * The distance of the k-th nearest, within rounding, and what share of a place those have that are as far.
 * @param {Float64Array} squared
 * @param {number} k
 */
function placesOf(squared, k) {
  const rising = new Float64Array(k).fill(Infinity);
  for (const value of squared) {
    if (!(value < rising[k - 1])) continue;
    let place = k - 1;
    for (; place > 0 && rising[place - 1] > value; place--) rising[place] = rising[place - 1];
    rising[place] = value;
  }
  const [low, high] = [rising[k - 1] * (1 - TIE), rising[k - 1] * (1 + TIE)];
  let [nearer, within] = [0, 0];
  for (const value of squared) {
    if (value < low) nearer++;
    if (value <= high) within++;
  }
  return { low, high, share: (k - nearer) / (within - nearer) };
}

/**
 * @param {number} value
 * @param {{ low: number, high: number, share: number }} places
 */
function shareOf(value, { low, high, share }) {
  return value < low ? 1 : value <= high ? share : 0;
}

/**
 * By how many places one at this distance lies beyond the k-th, on average over the places that it shares.
 * @param {Float64Array} squared
 * @param {number} value
 * @param {number} k
 */
function beyond(squared, value, k) {
  const [low, high] = [value * (1 - TIE), value * (1 + TIE)];
  let [nearer, within] = [0, 0];
  for (const other of squared) {
    if (other < low) nearer++;
    if (other <= high) within++;
  }
  return within <= k ? 0 : (Math.max(nearer, k) + 1 + within) / 2 - k;
}

/**
 * @param {Points} points
 * @param {number} row
 * @param {Float64Array} squared
 */
function distancesFrom({ count, width, values }, row, squared) {
  const start = row * width;
  for (let other = 0; other < count; other++) {
    const first = other * width;
    let sum = 0;
    for (let place = 0; place < width; place++) {
      const difference = values[start + place] - values[first + place];
      sum += difference * difference;
    }
    squared[other] = sum;
  }
}

/** @param {number} count */
function none(count) {
  return new Float64Array(count).fill(NaN);
}

/**
 * Of those that are known.
 * @param {Float64Array} values
 */
function meanOf(values) {
  const known = values.filter((value) => !Number.isNaN(value));
  return known.reduce((sum, value) => sum + value, 0) / known.length;
}
