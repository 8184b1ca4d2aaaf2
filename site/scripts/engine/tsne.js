// t-SNE (van der Maaten and Hinton 2008), as shapeviz_report/projections/tsne.py has it: exact on few rows; on more,
// with the nearest rows only and the far ones summed up by a tree (van der Maaten 2014).

import { nearestRows, squaredDistances } from "./distances.js";
import { ALL_PAIRS, classicalScaling, extent, placeNewcomers, principalComponents } from "./placing.js";
import { Quadtree } from "./quadtree.js";
import { Random } from "./random.js";
import { part } from "./steps.js";

/** Most effective neighbours: else the square root of the number of rows, and of few rows a third of the others. */
const PERPLEXITY = 30;

/** Factor on the affinities at first, for all pairs and for the nearest. */
const EXAGGERATION = { all: 4, nearest: 8 };

/**
 * Steps with and without exaggeration, and the size of the start: small from components, from an earlier map that of a
 * finished one, which moves its points least. Python takes 250 and 500 steps; fewer do as well (docs/using/workbench.md). Of many
 * rows the tree's maps were worse from a finished size than anew, so these start small from anywhere.
 */
const PLANS = {
  anew: { early: 100, late: 250, size: () => 1e-4 },
  onwards: {
    early: 50,
    late: 200 /** @param {number} count */,
    /** @param {number} count */
    size: (count) => 0.36 * Math.sqrt(count),
  },
};

/** Size of the seeded noise on the start, relative to its extent: what differs between two seeds. */
const JITTER = 0.01;

/** The entropy of a row is found to this precision (nats). */
const ENTROPY = 1e-5;

/** Pairs, and rows of affinities, between two reports: a few milliseconds of work. */
const WORK = 4e5;
const ROWS = 256;

/**
 * Lay out rows by t-SNE.
 *
 * @param {{ count: number, width: number, values: Float32Array }} points as `scaledPoints` gives them, at least 5, not all
 *   equal
 * @param {Float32Array | Float64Array | null} start an earlier map of these rows, NaN where a row had no place; null to start anew
 * @param {number} seed
 * @returns {Steps<Float64Array, Float64Array>} (2 n); the first to see is the map it starts from
 */
export function* layOutByTsne(points, start, seed) {
  const { count } = points;
  let forces, squared;
  if (count <= ALL_PAIRS) {
    squared = yield* part(squaredDistances(points), 0, 0.3);
    forces = new AllPairs(allAffinities(squared, count), count);
  } else {
    const nearest = yield* part(nearestRows(points, Math.floor(3 * perplexityOf(count))), 0, 0.3);
    forces = new NearPairs(yield* part(nearAffinities(nearest, count), 0.3, 0.35), count);
  }
  const plan = start && squared ? PLANS.onwards : PLANS.anew;
  let origin;
  if (start) origin = placeNewcomers(start, (visit) => forces.visitPairs(visit));
  else if (squared) origin = classicalScaling(squared, count);
  else origin = yield* part(principalComponents(points), 0.35, 0.4);
  yield { progress: 0.4, partial: origin };
  const random = new Random(seed);
  const unit = extent(origin);
  const size = plan.size(count);
  const xy = origin.map((value) => (value / unit + JITTER * random.normal()) * size);
  return yield* part(descend(forces, xy, forces.exaggeration, plan), 0.4, 1);
}

/** @param {number} count */
function perplexityOf(count) {
  return Math.min(PERPLEXITY, Math.sqrt(count), (count - 1) / 3);
}

/**
 * Affinities of all pairs: symmetric, with an empty diagonal, adding up to 1.
 *
 * @param {Float64Array} squared (n n) squared distances
 * @param {number} count n
 * @returns {Float64Array} (n n)
 */
function allAffinities(squared, count) {
  const perplexity = perplexityOf(count);
  const conditional = new Float64Array(count * count);
  const distances = new Float64Array(count - 1);
  for (let row = 0; row < count; row++) {
    for (let other = 0, at = 0; other < count; other++) {
      if (other !== row) distances[at++] = squared[row * count + other];
    }
    shareOut(distances, perplexity);
    for (let other = 0, at = 0; other < count; other++) {
      if (other !== row) conditional[row * count + other] = distances[at++];
    }
  }
  const shares = new Float64Array(count * count);
  for (let row = 0; row < count; row++) {
    for (let other = 0; other < row; other++) {
      const share = (conditional[row * count + other] + conditional[other * count + row]) / (2 * count);
      shares[row * count + other] = share;
      shares[other * count + row] = share;
    }
  }
  return shares;
}

/**
 * Affinities of near pairs, each pair once, adding up to 1/2.
 *
 * @param {{ k: number, rows: Int32Array, squared: Float64Array }} nearest whose distances become shares
 * @param {number} count
 * @returns {Steps<{ from: Int32Array, to: Int32Array, share: Float64Array }>}
 */
function* nearAffinities({ k, rows, squared }, count) {
  const perplexity = perplexityOf(count);
  for (let row = 0; row < count; row++) {
    if (row % ROWS === 0) yield { progress: row / count };
    shareOut(squared.subarray(row * k, (row + 1) * k), perplexity);
  }
  // The pairs of a row with those after it lie together: from `ends` of the row before it on.
  const ends = new Int32Array(count);
  for (let at = 0; at < rows.length; at++) ends[Math.min(Math.floor(at / k), rows[at])] += 1;
  for (let row = 1; row < count; row++) ends[row] += ends[row - 1];
  const next = Int32Array.from(ends, (_, row) => (row === 0 ? 0 : ends[row - 1]));
  const partner = new Int32Array(rows.length);
  const value = new Float64Array(rows.length);
  for (let at = 0; at < rows.length; at++) {
    const row = Math.floor(at / k);
    const held = next[Math.min(row, rows[at])]++;
    partner[held] = Math.max(row, rows[at]);
    value[held] = squared[at];
  }
  const from = new Int32Array(rows.length),
    to = new Int32Array(rows.length);
  const share = new Float64Array(rows.length);
  const place = new Int32Array(count).fill(-1);
  let pairs = 0;
  for (let row = 0, held = 0; row < count; row++) {
    const begin = pairs;
    for (; held < ends[row]; held++) {
      const other = partner[held];
      if (place[other] < begin) {
        place[other] = pairs;
        from[pairs] = row;
        to[pairs] = other;
        pairs += 1;
      }
      share[place[other]] += value[held] / (2 * count);
    }
  }
  return { from: from.subarray(0, pairs), to: to.subarray(0, pairs), share: share.subarray(0, pairs) };
}

/**
 * Turn the squared distances of a row's neighbours into shares: a Gaussian of the width whose entropy is
 * log(perplexity), found by Newton steps on the logarithm of its precision inside a shrinking bracket.
 * @param {Float64Array} distances
 * @param {number} perplexity
 */
function shareOut(distances, perplexity) {
  const size = distances.length;
  const target = Math.log(perplexity);
  let nearest = Infinity,
    mean = 0;
  for (let at = 0; at < size; at++) {
    nearest = Math.min(nearest, distances[at]);
    mean += distances[at] / size;
  }
  // Distances beyond the nearest, in units of their mean: neither can underflow the exponential.
  mean -= nearest;
  const spread = mean > 1e-6 * nearest && mean > 0;
  if (!spread) {
    distances.fill(1 / size);
    return;
  }
  for (let at = 0; at < size; at++) distances[at] = (distances[at] - nearest) / mean;
  let low = 0,
    high = Infinity,
    precision = 1,
    total = 1;
  for (let round = 0; round < 60; round++) {
    let first = 0,
      second = 0;
    total = 0;
    for (let at = 0; at < size; at++) {
      const excess = distances[at];
      const weight = Math.exp(-precision * excess);
      total += weight;
      first += weight * excess;
      second += weight * excess * excess;
    }
    first /= total;
    const surplus = Math.log(total) + precision * first - target;
    // More rows at the nearest distance than the perplexity asks for: no precision is enough.
    if (Math.abs(surplus) < ENTROPY || precision > 1e12) break;
    if (surplus > 0) low = precision;
    else high = precision;
    const slope = precision * precision * (second / total - first * first);
    const step = slope > 0 ? surplus / slope : 0;
    const moved = precision * Math.exp(Math.min(Math.max(step, -2), 2));
    if (moved > low && moved < high) precision = moved;
    else precision = high === Infinity ? 4 * precision : (low + high) / 2;
  }
  for (let at = 0; at < size; at++) distances[at] = Math.exp(-precision * distances[at]) / total;
}

/** The forces between all pairs; every pair has an affinity. */
class AllPairs {
  /**
   * @param {Float64Array} shares
   * @param {number} count
   */
  constructor(shares, count) {
    this.shares = shares;
    this.count = count;
    this.exaggeration = EXAGGERATION.all;
    this.work = (count * count) / 2;
  }

  /**
   * @param {(row: number, other: number, weight: number) => void} visit
   * @param {(row: number, other: number, weight: number) => void} visit
   */
  visitPairs(visit) {
    for (let row = 0; row < this.count; row++) {
      for (let other = 0; other < row; other++) visit(row, other, this.shares[row * this.count + other]);
    }
  }

  /**
   * Write what pulls and what pushes each point; returns the sum of the similarities, each pair counted twice.
   * @param {Float64Array} xy
   * @param {Float64Array} pull
   * @param {Float64Array} push
   * @param {Float64Array} xy
   * @param {Float64Array} pull
   * @param {Float64Array} push
   */
  measure(xy, pull, push) {
    const { shares, count } = this;
    pull.fill(0);
    push.fill(0);
    let normaliser = 0;
    for (let row = 0; row < count; row++) {
      const x = xy[2 * row],
        y = xy[2 * row + 1];
      let pullX = 0,
        pullY = 0,
        pushX = 0,
        pushY = 0;
      for (let other = 0, at = row * count; other < row; other++, at++) {
        const toX = x - xy[2 * other],
          toY = y - xy[2 * other + 1];
        const kernel = 1 / (1 + toX * toX + toY * toY);
        normaliser += kernel;
        const weight = shares[at] * kernel;
        const square = kernel * kernel;
        pullX += weight * toX;
        pullY += weight * toY;
        pushX += square * toX;
        pushY += square * toY;
        pull[2 * other] -= weight * toX;
        pull[2 * other + 1] -= weight * toY;
        push[2 * other] -= square * toX;
        push[2 * other + 1] -= square * toY;
      }
      pull[2 * row] += pullX;
      pull[2 * row + 1] += pullY;
      push[2 * row] += pushX;
      push[2 * row + 1] += pushY;
    }
    return 2 * normaliser;
  }
}

/** The forces between near pairs, and those of all by a tree. */
class NearPairs {
  /**
   * @param {{ from: Int32Array, to: Int32Array, share: Float64Array }} pairs
   * @param {number} count
   */
  constructor(pairs, count) {
    this.pairs = pairs;
    this.tree = new Quadtree(count);
    this.exaggeration = EXAGGERATION.nearest;
    // A point meets about a hundred squares.
    this.work = 100 * count + pairs.from.length;
  }

  /** @param {(row: number, other: number, weight: number) => void} visit */
  visitPairs(visit) {
    const { from, to, share } = this.pairs;
    share.forEach((weight, pair) => visit(from[pair], to[pair], weight));
  }

  /**
   * @param {Float64Array} xy
   * @param {Float64Array} pull
   * @param {Float64Array} push
   */
  measure(xy, pull, push) {
    const { from, to, share } = this.pairs;
    pull.fill(0);
    for (let pair = 0; pair < share.length; pair++) {
      const one = 2 * from[pair],
        other = 2 * to[pair];
      const toX = xy[one] - xy[other],
        toY = xy[one + 1] - xy[other + 1];
      const weight = share[pair] / (1 + toX * toX + toY * toY);
      pull[one] += weight * toX;
      pull[one + 1] += weight * toY;
      pull[other] -= weight * toX;
      pull[other + 1] -= weight * toY;
    }
    return this.tree.push(xy, push);
  }
}

/**
 * Minimise the KL divergence between the affinities and those of the map, by gradient descent with momentum and a gain
 * for every coordinate.
 *
 * @param {AllPairs|NearPairs} forces
 * @param {Float64Array} xy where the points start, (2 n); they move
 * @param {number} exaggeration factor on the affinities at first
 * @param {{ early: number, late: number }} steps with exaggeration, and without
 * @returns {Steps<Float64Array, Float64Array>} the points
 */
function* descend(forces, xy, exaggeration, { early, late }) {
  const size = xy.length;
  const pull = new Float64Array(size),
    push = new Float64Array(size);
  const speed = new Float64Array(size),
    gain = new Float64Array(size).fill(1);
  // Belkina et al. 2019: rows over exaggeration; 4 stands in the gradient already.
  const rate = Math.max(size / 2 / exaggeration / 4, 50);
  const smallest = extent(xy);
  let work = 0;
  for (let step = 0; step < early + late; step++) {
    const factor = step < early ? exaggeration : 1;
    const momentum = step < early ? 0.5 : 0.8;
    const scale = 1 / Math.max(forces.measure(xy, pull, push), 1e-12);
    for (let at = 0; at < size; at++) {
      const gradient = 4 * (factor * pull[at] - push[at] * scale);
      gain[at] = speed[at] * gradient < 0 ? gain[at] + 0.2 : Math.max(gain[at] * 0.8, 0.01);
      speed[at] = momentum * speed[at] - rate * gain[at] * gradient;
      xy[at] += speed[at];
    }
    if (step < early) keepSize(xy, speed, smallest);
    work += forces.work;
    if (work > WORK) {
      work = 0;
      yield { progress: step / (early + late), partial: xy };
    }
  }
  return xy;
}

/**
 * Exaggeration pulls rows without clear groups together; centre them and keep the size of the start, at which forces are
 * linear and scale means nothing, so that rounding cannot swallow what tells them apart.
 * @param {Float64Array} xy
 * @param {Float64Array} speed
 * @param {number} smallest
 */
function keepSize(xy, speed, smallest) {
  let x = 0,
    y = 0;
  const count = xy.length / 2;
  for (let at = 0; at < xy.length; at += 2) {
    x += xy[at] / count;
    y += xy[at + 1] / count;
  }
  for (let at = 0; at < xy.length; at += 2) {
    xy[at] -= x;
    xy[at + 1] -= y;
  }
  const size = extent(xy);
  if (size > 0 && size < smallest) {
    const growth = smallest / size;
    for (let at = 0; at < xy.length; at++) {
      xy[at] *= growth;
      speed[at] *= growth;
    }
  }
}
