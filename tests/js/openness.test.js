// The soft shadows of a model: what stands in the way of the light around it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { opennessOf } from "../../site/scripts/viewer/openness.js";

const STEPS = 12;

/**
 * Rectangles, each from a corner along two sides, in small triangles.
 * @param {[number[], number[], number[]][]} rectangles
 */
function surface(rectangles) {
  const [positions, faces] = [[], []];
  for (const [corner, along, across] of rectangles) {
    const first = positions.length / 3;
    for (let i = 0; i <= STEPS; i += 1)
      for (let j = 0; j <= STEPS; j += 1)
        positions.push(...corner.map((value, axis) => value + (along[axis] * i + across[axis] * j) / STEPS));
    for (let i = 0; i < STEPS; i += 1)
      for (let j = 0; j < STEPS; j += 1) {
        const at = first + i * (STEPS + 1) + j;
        faces.push(at, at + STEPS + 1, at + 1, at + 1, at + STEPS + 1, at + STEPS + 2);
      }
  }
  return {
    positions: Float32Array.from(positions),
    faces: Uint32Array.from(faces),
    vertexCount: positions.length / 3,
  };
}

const floor = [
  [0, 0, 0],
  [0.5, 0, 0],
  [0, 0.5, 0],
];
const wall = [
  [0, 0, 0],
  [0, 0.5, 0],
  [0, 0, 0.5],
];
/** In the middle of the floor's side, by its distance from the wall. */
const at = (step) => step * (STEPS + 1) + STEPS / 2;

test("a plane lies open, and the corner below a wall does not", () => {
  const [flat, corner] = [[floor], [floor, wall]].map((rectangles) => opennessOf(surface(rectangles), 1));
  assert.ok(flat.every((open) => open === 1));
  const [near, far] = [corner[at(1)], corner[at(STEPS)]];
  assert.ok(near < 0.8, String(near));
  assert.ok(near > 0.1);
  assert.equal(far, 1);
});

test("the size of a model does not matter", () => {
  const model = surface([floor, wall]);
  const large = { ...model, positions: model.positions.map((value) => 8 * value) };
  const [one, other] = [opennessOf(model, 1), opennessOf(large, 8)];
  assert.ok(one.every((open, vertex) => Math.abs(open - other[vertex]) < 1e-4));
});
