// The example that the Bins page opens with shows its bin.

import assert from "node:assert/strict";
import { test } from "node:test";
import { pictured } from "../../site/scripts/bins-kit/look.js";
import { firstBin } from "../../site/scripts/bins/class-cards.js";

// Two shapes a class; the shares of three bins.
const database = { groups: [0, 0, 1, 1] };
const SHARES = [
  [0, 0, 0.001, 0.04],
  [0.3, 0.2, 0.02, 0.01],
  [0.1, 0.1, 0.6, 0.5],
];
const bins = { ease: () => 1 };
const paintings = [0, 1, 2].flatMap((column) =>
  [0, 2].map((shape) => ({ column, shape, share: SHARES[column][shape] })),
);
const set = (columns, nh) => ({ bins: columns, nh, nhSpace: nh });
const selection = {
  paintings,
  minimal: [
    // Told apart best, but by a bin that is hardly to be seen on the shapes that are pictured.
    { group: 0, other: 1, highest: 1, sets: [set([0], 0.99)] },
    { group: 1, other: 0, highest: 1, sets: [set([1], 0.6), set([1, 2], 0.95)] },
  ],
};

test("it is one that its pictures show", () => {
  assert.deepEqual(firstBin(selection, database, bins), { bin: 1, group: 1 });
  assert.deepEqual(firstBin({ paintings: [], minimal: selection.minimal }, database, bins), { bin: 0, group: 0 });
  const other = { ...bins, ease: (column) => 1 + Number(column === 1) };
  assert.deepEqual(firstBin({ paintings: [], minimal: selection.minimal }, database, other), { bin: 1, group: 1 });
  assert.deepEqual(firstBin({ paintings, minimal: [] }, database, bins), { bin: 0, group: null });
});

test("it is one that can be said plainly unless others show much more", () => {
  const minimal = [
    { group: 0, other: 1, highest: 1, sets: [set([2], 0.99)] },
    { group: 1, other: 0, highest: 1, sets: [set([0], 0.9), set([0, 1], 0.95)] },
  ];
  // The pictures differ by 4, 28 and 50 in a hundred.
  const plain = (column) => ({ ...bins, ease: (other) => (other === column ? 2 : 1) });
  assert.deepEqual(firstBin({ paintings, minimal }, database, bins), { bin: 2, group: 0 });
  minimal[1].sets = [set([1], 0.6)];
  assert.deepEqual(firstBin({ paintings, minimal }, database, plain(1)), { bin: 1, group: 1 });
  minimal[1].sets = [set([0], 0.95)];
  assert.deepEqual(firstBin({ paintings, minimal }, database, plain(0)), { bin: 2, group: 0 });
});

test("the shape with much of a bin stands before the one with little", () => {
  const shapes = (column, group) => pictured(selection, database, column, group).map(({ shape }) => shape);
  assert.deepEqual(shapes(1, 1), [0, 2]);
  assert.deepEqual(shapes(2, 0), [2, 0]);
});
