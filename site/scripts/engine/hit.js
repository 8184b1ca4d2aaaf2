// Neighbourhood hit of a map (paper, Eq. 7 and 8), to the letter as shapeviz_report/quality.py defines it.

/** Distances that differ by less than this fraction are equal. */
const TIE = 1e-9;

/** Rows between two reports. */
const ROWS = 64;

/**
 * The share of each shape's k nearest neighbours on a map that have its own class.
 *
 * Points that tie for the last places share them equally. A neighbour without a label is a miss; a shape without one
 * has no hit (NaN) and no part in the means.
 *
 * @param {FeatureValues} _table not used: a map stands for itself
 * @param {{ xy: Float32Array | Float64Array, groups: Int32Array, k: number }} parameters
 *   xy (2 n); groups: each shape's class from 0, or -1 without a label
 * @returns {Steps<{ hit: Float64Array, hitOfClass: Float64Array, hitOfAll: number }>}
 *   of every shape, of every class by its number, of the map; NaN where nothing is defined
 */
export function* measureHit(_table, { xy, groups, k }) {
  const count = groups.length;
  const neighbours = Math.min(k, count - 1);
  const hit = new Float64Array(count).fill(NaN);
  if (neighbours >= 1) {
    const squared = new Float64Array(count);
    const nearest = new Float64Array(neighbours);
    for (let row = 0; row < count; row++) {
      if (row % ROWS === 0) yield { progress: row / count };
      if (groups[row] >= 0) hit[row] = hitOfRow(row, xy, groups, squared, nearest);
    }
  }
  return { hit, ...means(hit, groups) };
}

/**
 * @param {number} row
 * @param {Float32Array | Float64Array} xy
 * @param {Int32Array} groups
 * @param {Float64Array} squared
 * @param {Float64Array} nearest
 */
function hitOfRow(row, xy, groups, squared, nearest) {
  const count = groups.length;
  const k = nearest.length;
  nearest.fill(Infinity);
  for (let other = 0; other < count; other++) {
    const toX = xy[2 * row] - xy[2 * other];
    const toY = xy[2 * row + 1] - xy[2 * other + 1];
    const distance = other === row ? Infinity : toX * toX + toY * toY;
    squared[other] = distance;
    if (distance < nearest[k - 1]) insert(nearest, distance);
  }
  const last = nearest[k - 1];
  let nearer = 0,
    nearerHits = 0,
    tied = 0,
    tiedHits = 0;
  for (let other = 0; other < count; other++) {
    const same = groups[other] === groups[row] ? 1 : 0;
    if (squared[other] < last * (1 - TIE)) {
      nearer += 1;
      nearerHits += same;
    } else if (squared[other] <= last * (1 + TIE)) {
      tied += 1;
      tiedHits += same;
    }
  }
  return (nearerHits + (tiedHits * (k - nearer)) / tied) / k;
}

/**
 * Put a value into its place of a rising row, whose last falls out.
 * @param {Float64Array} rising
 * @param {number} value
 */
function insert(rising, value) {
  let place = rising.length - 1;
  for (; place > 0 && rising[place - 1] > value; place--) rising[place] = rising[place - 1];
  rising[place] = value;
}

/**
 * @param {Float64Array} hit
 * @param {Int32Array} groups
 */
function means(hit, groups) {
  const classes = groups.reduce((most, group) => Math.max(most, group + 1), 0);
  const totals = new Float64Array(classes);
  const sizes = new Float64Array(classes);
  let total = 0,
    labelled = 0;
  for (let row = 0; row < groups.length; row++) {
    if (groups[row] < 0) continue;
    totals[groups[row]] += hit[row];
    sizes[groups[row]] += 1;
    total += hit[row];
    labelled += 1;
  }
  return { hitOfClass: totals.map((sum, group) => sum / sizes[group]), hitOfAll: total / labelled };
}
