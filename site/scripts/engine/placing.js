// Where a map lies on the page: its start, how it is turned, how it fits. Points are Float64Array (2 n).

import { Random } from "./random.js";

/** @import { Points } from "./distances.js" */

/** Up to this many rows layouts work on the distances of all pairs; their start then comes from these. */
export const ALL_PAIRS = 300;

/** Rounds of the power iteration; few where each is dear, as a start need not be exact. */
const ROUNDS = { squared: 40, values: 10 };

/** Vectors that are iterated along; more than the two wanted let those settle sooner. */
const BLOCK = 4;

/**
 * Coordinates along the first two principal axes, from squared distances of all pairs (Torgerson's scaling).
 *
 * @param {Float64Array} squared (n n)
 * @param {number} count n, at least 2
 */
export function classicalScaling(squared, count) {
  const means = new Float64Array(count);
  for (let row = 0; row < count; row++) {
    for (let other = 0; other < count; other++) means[row] += squared[row * count + other] / count;
  }
  // The doubly centred matrix is never made: vectors are kept centred, so the column means cancel.
  const steps = principalCoordinates(count, ROUNDS.squared, (vector, product) => {
    for (let row = 0; row < count; row++) {
      let sum = 0;
      for (let other = 0, place = row * count; other < count; other++, place++) {
        sum += (means[other] + means[row] - squared[place]) * vector[other];
      }
      product[row] = sum / 2;
    }
  });
  for (;;) {
    const { done, value } = steps.next();
    if (done) return value;
  }
}

/**
 * As {@link classicalScaling}, from the points of `scaledPoints`, for more rows than have all their distances.
 * @param {Points} points
 * @returns {Steps<Float64Array>}
 */
export function* principalComponents({ count, width, values }) {
  const axis = new Float64Array(width);
  return yield* principalCoordinates(count, ROUNDS.values, (vector, product) => {
    axis.fill(0);
    for (let row = 0; row < count; row++) {
      const weight = vector[row];
      for (let place = 0, at = row * width; place < width; place++, at++) axis[place] += values[at] * weight;
    }
    for (let row = 0; row < count; row++) {
      let sum = 0;
      for (let place = 0, at = row * width; place < width; place++, at++) sum += values[at] * axis[place];
      product[row] = sum;
    }
  });
}

/**
 * The two leading eigenvectors of the scalar products of centred rows, each times the root of its eigenvalue.
 *
 * @param {number} count
 * @param {number} rounds
 * @param {(vector: Float64Array, product: Float64Array) => void} multiply writes the product with a centred vector
 * @returns {Steps<Float64Array>}
 */
function* principalCoordinates(count, rounds, multiply) {
  const random = new Random(1);
  let vectors = Array.from({ length: Math.min(BLOCK, count - 1) }, () => new Float64Array(count));
  let products = vectors.map(() => new Float64Array(count));
  for (const vector of vectors) for (let row = 0; row < count; row++) vector[row] = random.normal();
  const lengths = new Float64Array(BLOCK);
  for (let round = 0; round <= rounds; round++) {
    vectors.forEach((vector, place) => {
      centre(vector);
      for (let before = 0; before < place; before++) remove(vector, vectors[before]);
      lengths[place] = Math.sqrt(product(vector, vector));
      const factor = lengths[place] > 0 ? 1 / lengths[place] : 0;
      for (let row = 0; row < count; row++) vector[row] *= factor;
    });
    if (round === rounds) break;
    for (const [place, vector] of vectors.entries()) {
      multiply(vector, products[place]);
      yield { progress: round / rounds };
    }
    [vectors, products] = [products, vectors];
  }
  const xy = new Float64Array(2 * count);
  vectors.slice(0, 2).forEach((vector, axis) => {
    // Each axis points the way in which the farthest row lies.
    const farthest = vector.reduce((most, value) => (Math.abs(value) > Math.abs(most) ? value : most), 0);
    const factor = Math.sqrt(lengths[axis]) * (farthest < 0 ? -1 : 1);
    for (let row = 0; row < count; row++) xy[2 * row + axis] = vector[row] * factor;
  });
  return xy;
}

/** @param {Float64Array} vector */
function centre(vector) {
  const mean = vector.reduce((sum, value) => sum + value, 0) / vector.length;
  for (let row = 0; row < vector.length; row++) vector[row] -= mean;
}

/**
 * @param {Float64Array} one
 * @param {Float64Array} other
 */
function product(one, other) {
  let sum = 0;
  for (let row = 0; row < one.length; row++) sum += one[row] * other[row];
  return sum;
}

/**
 * Make a vector orthogonal to another of length 1 or 0.
 * @param {Float64Array} vector
 * @param {Float64Array} other
 */
function remove(vector, other) {
  const share = product(vector, other);
  for (let row = 0; row < vector.length; row++) vector[row] -= share * other[row];
}

/**
 * Give rows that an earlier map did not have a place among their neighbours.
 *
 * @param {Float32Array|Float64Array} xy (2 n), NaN where a row has no place; some have one
 * @param {(visit: (row: number, other: number, weight: number) => void) => void} visitPairs hands over pairs of neighbours and their weight
 * @returns {Float64Array} (2 n)
 */
export function placeNewcomers(xy, visitPairs) {
  const placed = Float64Array.from(xy);
  const totals = new Float64Array(xy.length);
  const weights = new Float64Array(xy.length / 2);
  /**
   * @param {number} to
   * @param {number} from
   * @param {number} weight
   */
  const lend = (to, from, weight) => {
    if (isPlaced(xy, 2 * to) || !isPlaced(xy, 2 * from)) return;
    weights[to] += weight;
    totals[2 * to] += weight * xy[2 * from];
    totals[2 * to + 1] += weight * xy[2 * from + 1];
  };
  visitPairs((one, other, weight) => {
    lend(one, other, weight);
    lend(other, one, weight);
  });
  const [, , x, y] = meansOfPlaced(xy, xy);
  for (let row = 0; row < weights.length; row++) {
    if (isPlaced(xy, 2 * row)) continue;
    // Without a neighbour on the earlier map: its middle.
    placed[2 * row] = weights[row] > 0 ? totals[2 * row] / weights[row] : x;
    placed[2 * row + 1] = weights[row] > 0 ? totals[2 * row + 1] / weights[row] : y;
  }
  for (let at = 0; at < placed.length; at += 2) {
    placed[at] -= x;
    placed[at + 1] -= y;
  }
  return placed;
}

/**
 * Turn and mirror a map so that its points lie as close as possible to those of a reference (orthogonal Procrustes),
 * and fit it into [-1, 1] by one factor.
 *
 * @param {Float64Array} xy
 * @param {Float64Array|Float32Array} reference NaN where a row has no place
 * @returns {Float32Array}
 */
export function placeLike(xy, reference) {
  const [x, y, toX, toY] = meansOfPlaced(xy, reference);
  let xx = 0,
    xy_ = 0,
    yx = 0,
    yy = 0;
  for (let at = 0; at < xy.length; at += 2) {
    if (!isPlaced(reference, at)) continue;
    xx += (xy[at] - x) * (reference[at] - toX);
    xy_ += (xy[at] - x) * (reference[at + 1] - toY);
    yx += (xy[at + 1] - y) * (reference[at] - toX);
    yy += (xy[at + 1] - y) * (reference[at + 1] - toY);
  }
  // Of all turns, and of all turns after mirroring the second axis, the one that agrees better.
  const turned = Math.hypot(xx + yy, xy_ - yx);
  const mirrored = Math.hypot(xx - yy, xy_ + yx);
  const mirror = mirrored > turned ? -1 : 1;
  const angle = mirror < 0 ? Math.atan2(xy_ + yx, xx - yy) : Math.atan2(xy_ - yx, xx + yy);
  const cosine = Math.cos(angle),
    sine = Math.sin(angle);
  const placed = new Float64Array(xy.length);
  for (let at = 0; at < xy.length; at += 2) {
    const second = mirror * xy[at + 1];
    placed[at] = cosine * xy[at] - sine * second;
    placed[at + 1] = sine * xy[at] + cosine * second;
  }
  return fitSquare(placed);
}

/**
 * The larger root mean square of the two coordinates.
 * @param {Float64Array} xy
 */
export function extent(xy) {
  let x = 0,
    y = 0;
  for (let at = 0; at < xy.length; at += 2) {
    x += xy[at] * xy[at];
    y += xy[at + 1] * xy[at + 1];
  }
  return Math.sqrt((2 * Math.max(x, y)) / xy.length);
}

/**
 * Whether the row whose first coordinate stands at `at` has a place.
 * @param {Float64Array | Float32Array} xy
 * @param {number} at
 */
export function isPlaced(xy, at) {
  return Number.isFinite(xy[at]) && Number.isFinite(xy[at + 1]);
}

/**
 * @param {Float64Array | Float32Array} xy
 * @param {Float64Array | Float32Array} reference
 */
function meansOfPlaced(xy, reference) {
  const sums = [0, 0, 0, 0];
  let count = 0;
  for (let at = 0; at < xy.length; at += 2) {
    if (!isPlaced(reference, at)) continue;
    sums[0] += xy[at];
    sums[1] += xy[at + 1];
    sums[2] += reference[at];
    sums[3] += reference[at + 1];
    count += 1;
  }
  return sums.map((sum) => sum / Math.max(count, 1));
}

/**
 * Centre points and scale them by one factor into [-1, 1].
 * @param {Float64Array} xy
 */
function fitSquare(xy) {
  let left = Infinity,
    right = -Infinity,
    bottom = Infinity,
    top = -Infinity;
  for (let at = 0; at < xy.length; at += 2) {
    left = Math.min(left, xy[at]);
    right = Math.max(right, xy[at]);
    bottom = Math.min(bottom, xy[at + 1]);
    top = Math.max(top, xy[at + 1]);
  }
  const extent = Math.max(right - left, top - bottom);
  const factor = extent > 0 ? 2 / extent : 1;
  const fitted = new Float32Array(xy.length);
  for (let at = 0; at < xy.length; at += 2) {
    fitted[at] = (xy[at] - (left + right) / 2) * factor;
    fitted[at + 1] = (xy[at + 1] - (bottom + top) / 2) * factor;
  }
  return fitted;
}
