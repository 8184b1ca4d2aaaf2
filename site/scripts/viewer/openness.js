// How much ambient light reaches the vertices of a model: what the soft shadows of its picture come from.
//
// The estimator of the pictures (shapeviz_report/render/shading.py, after McGuire and others 2011), taken over the
// surface around a vertex instead of over the pixels around a point, so that it holds from every side.

/** @import { Model } from "./model.js" */

/** The reach of shadows, in radii of the shape: nothing darkens from more than twice as far. */
const REACH = 0.22;
const STRENGTH = 1.25;
const BIAS = 0.03 * REACH;
const SOFTNESS = 0.01 * REACH ** 2;

/** Of a surface that lies around, the part that stands in the way. */
const IN_THE_WAY = 0.5;

/** Vertices that speak for the surface around, so that a model of very many parts is shown as soon. */
const MOST_AROUND = 3000;

/**
 * From 0 to 1, a number a vertex.
 * @param {Pick<Model, "positions" | "faces" | "vertexCount">} model
 * @param {number} radius of the shape
 */
export function opennessOf(model, radius) {
  const { vertexCount, positions, faces } = model;
  const normals = new Float32Array(3 * vertexCount);
  const areas = new Float32Array(vertexCount);
  for (let face = 0; face < faces.length; face += 3) {
    const [a, b, c] = [3 * faces[face], 3 * faces[face + 1], 3 * faces[face + 2]];
    const edge = (/** @type {number} */ to, /** @type {number} */ axis) => positions[to + axis] - positions[a + axis];
    const cross = [0, 1, 2].map((axis) => {
      const [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
      return edge(b, one) * edge(c, other) - edge(b, other) * edge(c, one);
    });
    const third = Math.hypot(...cross) / 6;
    for (const corner of [a, b, c]) {
      areas[corner / 3] += third;
      for (let axis = 0; axis < 3; axis += 1) normals[corner + axis] += cross[axis];
    }
  }
  for (let at = 0; at < normals.length; at += 3) {
    const length = Math.hypot(normals[at], normals[at + 1], normals[at + 2]) || 1;
    for (let axis = 0; axis < 3; axis += 1) normals[at + axis] /= length;
  }
  // Vertices come in an order along the surface: each so many of them speaks for its neighbours.
  const step = Math.ceil(vertexCount / MOST_AROUND);
  // Squared distances in units of the model.
  const [farthest, softness] = [4 * (REACH * radius) ** 2, SOFTNESS * radius ** 2];
  const openness = new Float32Array(vertexCount);
  for (let at = 0; at < positions.length; at += 3) {
    const x = positions[at];
    const y = positions[at + 1];
    const z = positions[at + 2];
    let occlusion = 0;
    for (let other = 0; other < positions.length; other += 3 * step) {
      const dx = positions[other] - x;
      const dy = positions[other + 1] - y;
      const dz = positions[other + 2] - z;
      const squared = dx * dx + dy * dy + dz * dz;
      if (squared > farthest) continue;
      const above = dx * normals[at] + dy * normals[at + 1] + dz * normals[at + 2] - BIAS * radius;
      if (above > 0) occlusion += (step * areas[other / 3] * above) / (squared + softness) ** 1.5;
    }
    openness[at / 3] = Math.max(0, 1 - (STRENGTH * IN_THE_WAY * occlusion) / (2 * Math.PI));
  }
  return openness;
}
