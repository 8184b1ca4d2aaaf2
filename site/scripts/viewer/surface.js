// The corners of a model's faces with the normals they are lit by: smooth over curved parts, split at creases.

/** @import { Model } from "./model.js" */

/**
 * Corners, three numbers each, and the vertex of each.
 * @typedef {{ positions: Float32Array, normals: Float32Array, source: Uint32Array }} Corners
 */

const CREASE_COSINE = Math.cos((40 * Math.PI) / 180);

/**
 * `positions` and `normals` of all corners, three numbers each, and the `source` vertex of each.
 * @param {Pick<Model, "positions" | "faces" | "vertexCount">} model
 * @returns {Corners}
 */
export function cornersOf({ positions, faces, vertexCount }) {
  const faceCount = faces.length / 3;
  const planes = new Float32Array(faces.length);
  const angles = new Float32Array(faces.length);
  for (let face = 0; face < faceCount; face += 1) {
    const [a, b, c] = [0, 1, 2].map((corner) => point(positions, faces[3 * face + corner]));
    const normal = unit(cross(minus(b, a), minus(c, a)));
    planes.set(normal, 3 * face);
    [angleAt(a, b, c), angleAt(b, c, a), angleAt(c, a, b)].forEach((angle, corner) => {
      angles[3 * face + corner] = angle;
    });
  }
  // The corners around each vertex, one list after the other.
  const starts = new Uint32Array(vertexCount + 1);
  for (const vertex of faces) starts[vertex + 1] += 1;
  for (let vertex = 0; vertex < vertexCount; vertex += 1) starts[vertex + 1] += starts[vertex];
  const around = new Uint32Array(faces.length);
  const next = starts.slice();
  for (let corner = 0; corner < faces.length; corner += 1) {
    around[next[faces[corner]]] = corner;
    next[faces[corner]] += 1;
  }
  const corners = {
    positions: new Float32Array(3 * faces.length),
    normals: new Float32Array(3 * faces.length),
    source: faces,
  };
  for (let corner = 0; corner < faces.length; corner += 1) {
    const own = 3 * Math.floor(corner / 3);
    const sum = [0, 0, 0];
    for (let i = starts[faces[corner]]; i < starts[faces[corner] + 1]; i += 1) {
      const other = 3 * Math.floor(around[i] / 3);
      const cosine =
        planes[own] * planes[other] + planes[own + 1] * planes[other + 1] + planes[own + 2] * planes[other + 2];
      if (cosine < CREASE_COSINE) continue;
      for (let axis = 0; axis < 3; axis += 1) sum[axis] += angles[around[i]] * planes[other + axis];
    }
    corners.normals.set(unit(sum), 3 * corner);
    corners.positions.set(point(positions, faces[corner]), 3 * corner);
  }
  return corners;
}

/**
 * @param {Float32Array} positions
 * @param {number} vertex
 */
function point(positions, vertex) {
  return positions.subarray(3 * vertex, 3 * vertex + 3);
}

/**
 * @param {ArrayLike<number>} a
 * @param {ArrayLike<number>} b
 */
function minus(a, b) {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/**
 * @param {number[]} a
 * @param {number[]} b
 */
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/**
 * Of length 1; a vector without a direction stays zero.
 * @param {number[]} vector
 */
function unit(vector) {
  const length = Math.hypot(...vector) || 1;
  return vector.map((value) => value / length);
}

/**
 * @param {ArrayLike<number>} corner
 * @param {ArrayLike<number>} one
 * @param {ArrayLike<number>} other
 */
function angleAt(corner, one, other) {
  const [a, b] = [unit(minus(one, corner)), unit(minus(other, corner))];
  return Math.acos(Math.min(Math.max(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1), 1));
}
