// The task "layout": from a choice of rows and columns to a map.

import { scaledPoints, squaredDistances } from "./distances.js";
import { classicalScaling, isPlaced, placeLike } from "./placing.js";
import { layOutByTsne } from "./tsne.js";
import { layOutByUmap } from "./umap.js";

/** @import { Points } from "./distances.js" */

const METHODS = { tsne: layOutByTsne, umap: layOutByUmap };

/** Fewer rows are laid out by principal components. */
const FEWEST = 5;

/** An earlier map must have a place for this share of the rows to start from it. */
const ENOUGH = 0.5;

/**
 * Lay out shapes in the plane.
 *
 * The map, and every partial one, is fitted into [-1, 1] by one factor, and turned and mirrored to agree with `start`,
 * else with `reference`, else with its own start, so that nothing jumps.
 *
 * @param {FeatureValues} table
 * @param {{ method: "tsne" | "umap", rows: Int32Array, columns: Int32Array, by: "features" | "bins",
 *   start?: Float32Array | null, reference?: Float32Array | null, seed: number }} parameters
 *   by: see `scaledPoints`; start (2 n): an earlier map of these rows to start from, NaN where a row had no place;
 *   reference: likewise, only to agree with
 * @returns {Steps<{ xy: Float32Array, seconds: number }, { xy: Float32Array }>}
 */
export function* layOut(table, { method, rows, columns, by, start = null, reference = null, seed }) {
  const began = performance.now();
  const points = scaledPoints(table, rows, columns, by);
  /** @type {Float32Array | Float64Array | null} */
  let like = [start, reference].find((map) => map?.some(Number.isFinite)) ?? null;
  let xy;
  if (allEqual(points)) {
    xy = new Float64Array(2 * points.count);
  } else if (points.count < FEWEST) {
    xy = classicalScaling(yield* squaredDistances(points), points.count);
  } else {
    const steps = METHODS[method](points, hasEnough(start) ? start : null, seed);
    for (let step = steps.next(); ; step = steps.next()) {
      if (step.done === true) {
        xy = step.value;
        break;
      }
      const { progress, partial } = step.value;
      if (partial) like ??= partial.slice();
      yield partial ? { progress, partial: { xy: placeLike(partial, like ?? partial) } } : { progress };
    }
  }
  return { xy: placeLike(xy, like ?? xy), seconds: (performance.now() - began) / 1000 };
}

/** @param {Points} points */
function allEqual({ count, width, values }) {
  for (let at = width; at < count * width; at++) if (values[at] !== values[at - width]) return false;
  return true;
}

/**
 * Whether a map has places for enough rows, and not one place for all.
 * @param {Float32Array | null} map
 * @returns {map is Float32Array}
 */
function hasEnough(map) {
  if (!map) return false;
  /** @type {number[]} */
  const places = [];
  for (let at = 0; at < map.length; at += 2) if (isPlaced(map, at)) places.push(at);
  /** @param {number} at */
  const differs = (at) => map[at] !== map[places[0]] || map[at + 1] !== map[places[0] + 1];
  return places.length >= (ENOUGH * map.length) / 2 && places.some(differs);
}
