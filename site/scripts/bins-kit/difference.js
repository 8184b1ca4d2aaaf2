// Where on two surfaces the distance of two shapes lies.
//
// A squared distance is a sum over bins. What a bin adds is dealt out evenly over all that falls into it, on both
// surfaces: to a shape with the share a of its surface in the bin, beside another with b, goes a / (a + b) of it. Where
// the values compared are square roots of shares, each point of a surface then bears at most its own weight: a bin that
// only one shape has is all difference, one that both have alike is none. The sum over both surfaces, and over the
// features of whole shapes, which lie on no surface, is the squared distance.

/** @import { Bins } from "../database/bins.js" */
/** @import { Model } from "../viewer/model.js" */

/**
 * What differs in one feature, as shares of the squared distance: on the first surface, on the second, on none.
 * @typedef {{ feature: number, share: number, on: [number, number], beside: number }} FeaturePart
 *
 * One column's part of the squared distance.
 * @typedef {{ column: number, squared: number }} Part
 */

/** Colours are as strong as they get for this share of both surfaces, so that no speck makes all else pale. */
const STRONGEST = 0.02;

/**
 * The squared distance that some parts make.
 * @param {Part[]} parts
 */
export function sumOf(parts) {
  return parts.reduce((sum, { squared }) => sum + squared, 0);
}

/**
 * The features in which two shapes differ, those first that say most.
 * @param {Part[]} parts
 * @param {Bins} bins
 * @param {[number, number]} rows the two shapes
 * @returns {FeaturePart[]}
 */
export function byFeature(parts, bins, rows) {
  const total = sumOf(parts);
  /** @type {Map<number, FeaturePart>} */
  const found = new Map();
  for (const { column, squared } of parts) {
    const feature = bins.featureOf(column);
    const part = found.get(feature) ?? { feature, share: 0, on: [0, 0], beside: 0 };
    found.set(feature, part);
    part.share += squared / total;
    if (!bins.isShare(column)) part.beside += squared / total;
    else
      for (const side of /** @type {const} */ ([0, 1]))
        part.on[side] += (squared * owned(bins, column, rows, side)) / total;
  }
  return [...found.values()].sort((a, b) => b.share - a.share || a.feature - b.feature);
}

/**
 * How densely the difference lies at every vertex of the two models: the share of the squared distance on a piece of a
 * surface is its density times the piece's share of the surface.
 * @param {Part[]} parts
 * @param {Bins} bins
 * @param {[number, number]} rows the two shapes
 * @param {[Model, Model]} solids
 * @param {number} total the squared distance that shares are of
 */
export function densities(parts, bins, rows, solids, total) {
  /** @type {Map<number, Part[]>} */
  const byDimension = new Map();
  for (const part of parts) {
    const dimension = bins.dimensionOf(part.column);
    if (dimension === null) continue;
    byDimension.set(dimension, [...(byDimension.get(dimension) ?? []), part]);
  }
  const surfaces = solids.map((solid, place) => {
    const side = /** @type {0 | 1} */ (place);
    const masses = vertexMasses(solid);
    const density = new Float64Array(solid.vertexCount);
    for (const [dimension, own] of byDimension) {
      const at = solid.bins(dimension);
      const inBin = new Float64Array(16);
      for (let vertex = 0; vertex < at.length; vertex += 1) inBin[at[vertex]] += masses[vertex];
      const dealt = new Float64Array(16);
      for (const { column, squared } of own) {
        const bin = bins.binOf(column);
        // Few faces may have lost what there is little of.
        if (inBin[bin] > 0) dealt[bin] = (squared * owned(bins, column, rows, side)) / total / inBin[bin];
      }
      for (let vertex = 0; vertex < at.length; vertex += 1) density[vertex] += dealt[at[vertex]];
    }
    return { masses, density };
  });
  return { densities: surfaces.map(({ density }) => density), ...spreadOf(surfaces) };
}

/**
 * The share of a bin's part that lies on one of the two surfaces.
 * @param {Bins} bins
 * @param {number} column
 * @param {[number, number]} rows
 * @param {0 | 1} side
 */
function owned(bins, column, rows, side) {
  const shares = rows.map((row) => bins.share(column, row));
  return shares[side] / (shares[0] + shares[1]);
}

/**
 * The share of the surface around each vertex: a third of every face at it.
 * @param {Pick<Model, "vertexCount" | "faces" | "positions">} solid
 */
export function vertexMasses({ vertexCount, faces, positions }) {
  const masses = new Float64Array(vertexCount);
  for (let face = 0; face < faces.length; face += 3) {
    const corners = faces.subarray(face, face + 3);
    const [a, b, c] = [...corners].map((vertex) => positions.subarray(3 * vertex, 3 * vertex + 3));
    const [u, v] = [b, c].map((corner) => [corner[0] - a[0], corner[1] - a[1], corner[2] - a[2]]);
    const area = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
    for (const vertex of corners) masses[vertex] += area / 3;
  }
  const total = masses.reduce((sum, mass) => sum + mass, 0);
  return total > 0 ? masses.map((mass) => mass / total) : masses.fill(1 / vertexCount);
}

/**
 * How unevenly the difference lies on both surfaces: the density that only the densest of them exceed, and the share of
 * the surfaces on which half of it lies.
 * @param {{ masses: Float64Array, density: Float64Array }[]} surfaces
 */
function spreadOf(surfaces) {
  const points = surfaces
    .flatMap(({ masses, density }) => Array.from(density, (dense, vertex) => ({ dense, mass: masses[vertex] })))
    .sort((a, b) => b.dense - a.dense);
  const all = points.reduce((sum, { dense, mass }) => sum + dense * mass, 0);
  /** @type {{ strongest?: number, half?: number }} */
  const found = {};
  let [covered, held] = [0, 0];
  for (const { dense, mass } of points) {
    covered += mass / surfaces.length;
    held += dense * mass;
    if (covered >= STRONGEST) found.strongest ??= dense;
    if (held >= all / 2) found.half ??= covered;
  }
  return { strongest: found.strongest ?? 0, half: found.half ?? 1 };
}
