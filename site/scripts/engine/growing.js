// The task "grow": few bins that keep classes apart, found as shapeviz_report/search/bins/automatic.py grows them. The
// neighbourhood hit in their space decides: the bin that raises it most joins, then whatever can leave without loss
// leaves, until none raises it.

import { scaledPoints } from "./distances.js";
import { differ } from "./table.js";

/**
 * The candidates, and what they are to keep apart: each class is a number, -1 for none; places: how many neighbours of
 * each row count.
 * @typedef {{ columns: Float64Array[], groups: Int32Array, places: Int32Array }} Space
 */

/** Values are rounded to this many binary digits of the largest one: sums of their squares are exact, and ties are ties. */
const GRID_BITS = 20;

/** The hit counts shapes, so that real differences exceed this and rounding does not. */
const GAIN = 1e-9;

/** Candidates between two reports. */
const AT_ONCE = 4;

/**
 * @param {FeatureValues} table
 * @param {{ rows: Int32Array, columns: Int32Array, groups: Int32Array, k: number, limit: number }} task
 *   groups: of each of the rows; limit: most bins
 * @returns {Steps<{ columns: Int32Array }>} the bins found, in the order in which they joined
 */
export function* grow(table, { rows, columns, groups, k, limit }) {
  const varying = columns.filter((column) => differ(table, column, rows));
  const count = rows.length;
  const space = { columns: onGrid(table, rows, varying), groups, places: placesOf(groups, Math.min(k, count - 1)) };
  const squared = new Float64Array(count * count);
  /** @type {number[]} */
  let bins = [];
  let best = 0;
  while (bins.length < Math.min(limit, varying.length)) {
    const [done, share] = [bins.length / limit, 1 / limit / varying.length];
    const rising = sortedDistances(squared, count);
    let joining = -1;
    let most = bins.length === 0 ? -1 : best + GAIN;
    for (let place = 0; place < varying.length; place += 1) {
      if (place % AT_ONCE === 0) yield { progress: done + place * share };
      if (bins.includes(place)) continue;
      const reached = hitWith(space.columns[place], rising, space);
      if (reached > most) [joining, most] = [place, reached];
    }
    if (joining < 0) break;
    bins.push(joining);
    addTo(squared, space.columns[joining], 1);
    best = most;
    // The one that has just joined stays.
    while (bins.length > 2) {
      let leaving = -1;
      let left = best - GAIN;
      for (const bin of bins.slice(0, -1)) {
        yield { progress: done };
        addTo(squared, space.columns[bin], -1);
        const reached = hitWith(NOTHING, sortedDistances(squared, count), space);
        addTo(squared, space.columns[bin], 1);
        if (reached > left) [leaving, left] = [bin, reached];
      }
      if (leaving < 0) break;
      addTo(squared, space.columns[leaving], -1);
      bins = bins.filter((bin) => bin !== leaving);
      best = left;
    }
  }
  return { columns: Int32Array.from(bins, (place) => varying[place]) };
}

/**
 * As many neighbours of each row count as its class has others, at least 1, at most k: so a class of any size can be
 * kept together wholly.
 * @param {Int32Array} groups
 * @param {number} k
 */
function placesOf(groups, k) {
  const sizes = new Int32Array(groups.reduce((most, group) => Math.max(most, group + 1), 0));
  for (const group of groups) if (group >= 0) sizes[group] += 1;
  return groups.map((group) => (group < 0 ? k : Math.min(Math.max(sizes[group] - 1, 1), k)));
}

/** A column that parts no shapes. */
const NOTHING = new Float64Array(0);

/**
 * Each of the columns for the rows, as maps of bins compare it, on the grid.
 * @param {FeatureValues} table
 * @param {Int32Array} rows
 * @param {Int32Array} columns
 */
function onGrid(table, rows, columns) {
  const { width, values } = scaledPoints(table, rows, columns, "bins");
  const highest = values.reduce((most, value) => Math.max(most, Math.abs(value)), 1e-300);
  const step = 2 ** (Math.ceil(Math.log2(highest)) - GRID_BITS);
  return Array.from(columns, (_, place) =>
    Float64Array.from(rows, (_row, index) => Math.round(values[index * width + place] / step) * step),
  );
}

/**
 * Add the squared distances of a column, or with -1 take them away.
 * @param {Float64Array} squared
 * @param {Float64Array} column
 * @param {1 | -1} sign
 */
function addTo(squared, column, sign) {
  const { length } = column;
  for (let row = 0; row < length; row += 1)
    for (let other = 0; other < length; other += 1)
      squared[row * length + other] += sign * (column[row] - column[other]) ** 2;
}

/**
 * The others of each row, the nearest first, and how far they are.
 * @param {Float64Array} squared
 * @param {number} count
 */
function sortedDistances(squared, count) {
  const others = new Int32Array(count * (count - 1));
  const distances = new Float64Array(others.length);
  for (let row = 0; row < count; row += 1) {
    const own = squared.subarray(row * count, (row + 1) * count);
    const order = Int32Array.from(own.keys())
      .filter((other) => other !== row)
      .sort((a, b) => own[a] - own[b]);
    others.set(order, row * (count - 1));
    distances.set(
      Float64Array.from(order, (other) => own[other]),
      row * (count - 1),
    );
  }
  return { others, distances };
}

/**
 * The mean hit of the shapes of a class if a column joined those that made the distances.
 *
 * An added column can only part shapes: a row is done as soon as the next of the others, in the order of their present
 * distance, is farther than the k-th nearest found. Neighbours that tie for the last places share them.
 * @param {Float64Array} column
 * @param {{ others: Int32Array, distances: Float64Array }} rising
 * @param {Space} space
 */
function hitWith(column, { others, distances }, { groups, places }) {
  const count = groups.length;
  const nearest = new Float64Array(Math.max(...places));
  const moves = column.length > 0;
  let total = 0;
  let labelled = 0;
  for (let row = 0; row < count; row += 1) {
    if (groups[row] < 0) continue;
    const start = row * (count - 1);
    const own = moves ? column[row] : 0;
    const k = places[row];
    let found = 0;
    let last = Infinity;
    let seen = 0;
    for (; seen < count - 1 && distances[start + seen] <= last; seen += 1) {
      const step = moves ? column[others[start + seen]] - own : 0;
      const distance = distances[start + seen] + step * step;
      if (distance >= last) continue;
      let place = Math.min(found, k - 1);
      for (; place > 0 && nearest[place - 1] > distance; place -= 1) nearest[place] = nearest[place - 1];
      nearest[place] = distance;
      found = Math.min(found + 1, k);
      if (found === k) last = nearest[k - 1];
    }
    let nearer = 0;
    let hits = 0;
    let tied = 0;
    let tiedHits = 0;
    for (let index = 0; index < seen; index += 1) {
      const other = others[start + index];
      const step = moves ? column[other] - own : 0;
      const distance = distances[start + index] + step * step;
      const same = groups[other] === groups[row] ? 1 : 0;
      if (distance < last) {
        nearer += 1;
        hits += same;
      } else if (distance === last) {
        tied += 1;
        tiedHits += same;
      }
    }
    total += (hits + ((k - nearer) * tiedHits) / tied) / k;
    labelled += 1;
  }
  return total / labelled;
}
