// UMAP (McInnes, Healy, Melville 2018), as shapeviz_report/projections/umap.py sets its authors' package.

import { nearestRows, squaredDistances } from "./distances.js";
import { ALL_PAIRS, classicalScaling, extent, placeNewcomers, principalComponents } from "./placing.js";
import { Random } from "./random.js";
import { part } from "./steps.js";

/** @import { Points } from "./distances.js" */

/** Nearest neighbours of a row, itself among them. */
const NEIGHBOURS = 15;

/** The curve 1 / (1 + A d^(2 B)) that fits a least distance of 0.1. */
const A = 1.576943460405378;
const B = 0.8950608781227859;

/**
 * Rounds over the edges, and how far a point goes at first, from the components and from an earlier map. The package takes
 * 500 rounds at a rate of 1; fewer do as well, and a gentle rate leaves an earlier map where it was (docs/using/workbench.md).
 */
const PLANS = { anew: { epochs: 200, rate: 1 }, onwards: { epochs: 150, rate: 0.25 } };

/** Points that each end of an edge is pushed from, drawn at random. */
const NEGATIVES = 5;

/** Side of the square that the map starts in. */
const SIDE = 10;

/** Size of the seeded noise on the start, relative to its extent. */
const JITTER = 0.01;

/** The longest way along an axis in one step, at a rate of 1. */
const LONGEST = 4;

/** Pushes between two reports: a few milliseconds of work. */
const WORK = 1e5;

/**
 * As `layOutByTsne`, by UMAP.
 * @param {Points} points
 * @param {Float32Array | null} start
 * @param {number} seed
 * @returns {Steps<Float64Array>}
 */
export function* layOutByUmap(points, start, seed) {
  const { count } = points;
  const nearest = yield* part(nearestRows(points, Math.min(NEIGHBOURS, count - 1) - 1), 0, 0.3);
  const edges = fuzzyUnion(memberships(nearest, count), count);
  let origin;
  if (start) origin = placeNewcomers(start, (visit) => visitEdges(edges, visit));
  else if (count <= ALL_PAIRS) origin = classicalScaling(yield* part(squaredDistances(points), 0.3, 0.4), count);
  else origin = yield* part(principalComponents(points), 0.3, 0.4);
  yield { progress: 0.4, partial: origin };
  const random = new Random(seed);
  const unit = extent(origin);
  const xy = origin.map((value) => ((value / unit + JITTER * random.normal()) * SIDE) / 4);
  return yield* part(descend(edges, xy, start ? PLANS.onwards : PLANS.anew, random), 0.4, 1);
}

/**
 * How surely each of a row's nearest is its neighbour: 1 for the first, falling off so that they add up to log2(k + 1).
 * @param {{ k: number, rows: Int32Array, squared: Float64Array }} nearest
 * @param {number} count
 */
function memberships({ k, rows, squared }, count) {
  const weight = new Float64Array(squared.length);
  const distances = squared.map(Math.sqrt);
  const mean = distances.reduce((sum, value) => sum + value, 0) / (count * (k + 1));
  const target = Math.log2(k + 1);
  for (let row = 0; row < count; row++) {
    const own = distances.subarray(row * k, (row + 1) * k);
    const first = own.find((distance) => distance > 0) ?? 0;
    const ownMean = own.reduce((sum, value) => sum + value, 0) / (k + 1);
    let low = 0,
      high = Infinity,
      width = 1;
    for (let round = 0; round < 64; round++) {
      const total = own.reduce((sum, distance) => sum + fall(distance - first, width), 0);
      if (Math.abs(total - target) < 1e-5) break;
      if (total > target) high = width;
      else low = width;
      width = high === Infinity ? 2 * width : (low + high) / 2;
    }
    width = Math.max(width, 1e-3 * (first > 0 ? ownMean : mean));
    for (let at = 0; at < k; at++) weight[row * k + at] = fall(own[at] - first, width);
  }
  return { k, rows, weight };
}

/**
 * @param {number} excess
 * @param {number} width
 */
function fall(excess, width) {
  return excess > 0 ? Math.exp(-excess / width) : 1;
}

/**
 * Neighbourhood either way: a + b - a b for every pair, listed from both of its ends.
 * @param {{ k: number, rows: Int32Array, weight: Float64Array }} memberships
 * @param {number} count
 */
function fuzzyUnion({ k, rows, weight }, count) {
  const pairs = new Map();
  for (let row = 0; row < count; row++) {
    for (let at = row * k; at < (row + 1) * k; at++) {
      const key = Math.min(row, rows[at]) * count + Math.max(row, rows[at]);
      const before = pairs.get(key) ?? 0;
      pairs.set(key, before + weight[at] - before * weight[at]);
    }
  }
  const from = [],
    to = [],
    sure = [];
  for (const [key, value] of pairs) {
    const low = Math.floor(key / count),
      high = key % count;
    from.push(low, high);
    to.push(high, low);
    sure.push(value, value);
  }
  return { from: Int32Array.from(from), to: Int32Array.from(to), weight: Float64Array.from(sure) };
}

/**
 * @param {{ from: Int32Array, to: Int32Array, weight: Float64Array }} parts
 * @param {(row: number, other: number, weight: number) => void} visit
 */
function visitEdges({ from, to, weight }, visit) {
  weight.forEach((value, edge) => visit(from[edge], to[edge], value));
}

/**
 * Stochastic descent: edges pull their ends together, as often as their weight says, and random points push.
 * @param {{ from: Int32Array, to: Int32Array, weight: Float64Array }} parts
 * @param {Float64Array} xy
 * @param {{ epochs: number, rate: number }} parts
 * @param {Random} random
 */
function* descend({ from, to, weight }, xy, { epochs, rate: first }, random) {
  const count = xy.length / 2;
  const largest = weight.reduce((most, value) => Math.max(most, value), 0);
  // Epochs between two turns of an edge; one that would have no turn is left out by never coming due.
  const interval = weight.map((value) => (value < largest / epochs ? Infinity : largest / value));
  const due = interval.slice();
  let work = 0;
  for (let epoch = 0; epoch < epochs; epoch++) {
    const rate = first * (1 - epoch / epochs);
    for (let edge = 0; edge < due.length; edge++) {
      if (due[edge] > epoch + 1) continue;
      due[edge] += interval[edge];
      const own = 2 * from[edge],
        other = 2 * to[edge];
      let toX = xy[own] - xy[other],
        toY = xy[own + 1] - xy[other + 1];
      let squared = toX * toX + toY * toY;
      if (squared > 0) {
        const power = squared ** B;
        const pull = (-2 * A * B * power) / (squared * (1 + A * power));
        const stepX = clip(pull * toX) * rate,
          stepY = clip(pull * toY) * rate;
        xy[own] += stepX;
        xy[own + 1] += stepY;
        xy[other] -= stepX;
        xy[other + 1] -= stepY;
      }
      for (let turn = 0; turn < NEGATIVES; turn++) {
        const far = 2 * random.below(count);
        toX = xy[own] - xy[far];
        toY = xy[own + 1] - xy[far + 1];
        squared = toX * toX + toY * toY;
        if (squared === 0) continue;
        const push = (2 * B) / ((0.001 + squared) * (1 + A * squared ** B));
        xy[own] += clip(push * toX) * rate;
        xy[own + 1] += clip(push * toY) * rate;
      }
      work += 1 + NEGATIVES;
    }
    if (work > WORK) {
      work = 0;
      yield { progress: epoch / epochs, partial: xy };
    }
  }
  return xy;
}

/** @param {number} step */
function clip(step) {
  return Math.max(-LONGEST, Math.min(LONGEST, step));
}
