// What is known of a mesh, by the same names on every page.

import { count, grouped } from "../base/words.js";

/**
 * Its surface: whether it is closed, and of how many parts it is.
 * @param {Chunk.ShapeDetails} known
 * @returns {[string, string][]}
 */
export function surfaceFacts({ watertight, components }) {
  return [
    ["surface", watertight ? "watertight" : "open"],
    ["parts", grouped(components)],
  ];
}

/**
 * Its mesh: what the file has, and what was measured in its place.
 * @param {Chunk.ShapeDetails} known
 * @returns {[string, string][]}
 */
export function meshFacts({ facesRead, verticesRead, faces, vertices, deviation }) {
  return [
    ["in the file", `${count(facesRead, "face")}, ${count(verticesRead, "vertex", "vertices")}`],
    ["as measured", `${count(faces, "face")}, ${count(vertices, "vertex", "vertices")}`],
    ["off by", `${((deviation ?? 0) * 100).toFixed(3)}\u00a0% of its diagonal at most`],
  ];
}

/**
 * What says that two shapes are the same shape, if they are copies of each other.
 * @param {Chunk.ShapeDetails} known of the one
 * @param {number} other
 */
export function copyEvidence({ copies }, other) {
  return copies.find(([copy]) => copy === other)?.[1] ?? null;
}
