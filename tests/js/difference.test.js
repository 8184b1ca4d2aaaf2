// Where the distance of two shapes lies on their surfaces.

import assert from "node:assert/strict";
import { test } from "node:test";
import { byFeature, densities, sumOf, vertexMasses } from "../../site/scripts/bins-kit/difference.js";
import { Bins } from "../../site/scripts/database/bins.js";
import { Similarity } from "../../site/scripts/database/similarity.js";

const STEPS = 65535;
const FACES = 40;

/** Strips of triangles whose areas are random: a model, and the bin of each vertex in two dimensions. */
function solidOf(random, bins) {
  const vertexCount = FACES + 2;
  const positions = new Float32Array(3 * vertexCount);
  for (let vertex = 0; vertex < vertexCount; vertex += 1) positions.set([vertex, vertex % 2, random()], 3 * vertex);
  const faces = new Uint32Array(Array.from({ length: FACES }, (_, face) => [face, face + 1, face + 2]).flat());
  const places = bins.map((choices) => Uint8Array.from({ length: vertexCount }, () => choices(random)));
  return { vertexCount, faces, positions, bins: (/** @type {number} */ dimension) => places[dimension] };
}

/** The shares of a surface in the bins of a dimension, as its vertices have them. */
function sharesOf(solid, dimension, width) {
  const masses = vertexMasses(solid);
  const shares = new Array(width).fill(0);
  solid.bins(dimension).forEach((bin, vertex) => (shares[bin] += masses[vertex]));
  return shares;
}

function randoms(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** Two shapes: features `A` (one dimension of three bins), `B` (one of four) and `own`, a value that was brought along. */
function twoShapes() {
  const random = randoms(7);
  // The first shape has nothing in the last bin of A, the second nothing in the first.
  const solids = [
    solidOf(random, [(next) => Math.floor(2 * next()), (next) => Math.floor(4 * next())]),
    solidOf(random, [(next) => 1 + Math.floor(2 * next()), (next) => Math.floor(2 * next())]),
  ];
  const features = [
    { name: "A", start: 0, dimensions: 1, bins: 3, weight: 0.5, low: 0, high: 1 },
    { name: "own", start: 3, dimensions: 1, bins: 1, weight: 2, low: -1, high: 3 },
    { name: "B", start: 4, dimensions: 1, bins: 4, weight: 1, low: 0, high: 1 },
  ];
  const rows = solids.map((solid, row) => [
    ...sharesOf(solid, 0, 3).map(Math.sqrt),
    (row + 1) / 4,
    ...sharesOf(solid, 1, 4).map(Math.sqrt),
  ]);
  const steps = new Uint16Array(rows[0].flatMap((_, column) => rows.map((row) => Math.round(STEPS * row[column]))));
  const bins = new Bins({ features, scaling: "balanced", sentences: [], marks: {}, sample: null }, steps.buffer);
  return { bins, solids, similarity: new Similarity(bins) };
}

test("colours and numbers add up to the squared distance", () => {
  const { bins, solids, similarity } = twoShapes();
  for (const choice of [{ features: [0, 1, 2] }, { features: [2] }, { columns: [0, 1, 3, 6] }]) {
    const parts = similarity.differences(0, 1, choice);
    const [found] = similarity.rank(0, choice, 1);
    const total = sumOf(parts);
    assert.ok(Math.abs(total - found.distance ** 2) < 1e-9 * total);
    const told = byFeature(parts, bins, [0, 1]);
    const sums = told.map(({ share, on, beside }) => [share, on[0] + on[1] + beside]);
    for (const [share, sum] of sums) assert.ok(Math.abs(share - sum) < 1e-12);
    assert.ok(Math.abs(sums.reduce((sum, [share]) => sum + share, 0) - 1) < 1e-12);
    const painted = densities(parts, bins, [0, 1], solids, total);
    painted.densities.forEach((density, side) => {
      const masses = vertexMasses(solids[side]);
      const held = density.reduce((sum, dense, vertex) => sum + dense * masses[vertex], 0);
      assert.ok(Math.abs(held - told.reduce((sum, { on }) => sum + on[side], 0)) < 1e-9, `side ${side}`);
    });
  }
});

test("a bin that one shape has alone is on its surface, and one that both have alike on none", () => {
  const { bins, solids, similarity } = twoShapes();
  const parts = similarity.differences(0, 1, { columns: [0] });
  assert.deepEqual(byFeature(parts, bins, [0, 1])[0].on, [1, 0]);
  const { densities: painted } = densities(parts, bins, [0, 1], solids, sumOf(parts));
  assert.ok(painted[1].every((dense) => dense === 0));
  assert.ok(painted[0].every((dense, vertex) => dense > 0 === (solids[0].bins(0)[vertex] === 0)));
  assert.deepEqual(similarity.differences(0, 0, { features: [0, 1, 2] }), []);
});

test("a value that was brought along lies on no surface", () => {
  const { bins, similarity } = twoShapes();
  const told = byFeature(similarity.differences(0, 1, { features: [1] }), bins, [0, 1]);
  assert.deepEqual(told, [{ feature: 1, share: 1, on: [0, 0], beside: 1 }]);
});

test("half of a difference that lies evenly is on half of the surfaces", () => {
  const { bins, solids } = twoShapes();
  const even = solids.map((solid) => ({ ...solid, bins: () => new Uint8Array(solid.vertexCount) }));
  const found = densities([{ column: 0, squared: 2 }], bins, [0, 0], even, 2);
  assert.ok(Math.abs(found.half - 0.5) < 0.05);
  assert.ok(Math.abs(found.strongest - 0.5) < 1e-9);
});
