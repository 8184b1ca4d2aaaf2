// Boxes and lassos on maps, and what becomes of a selection with them.

import assert from "node:assert/strict";
import { test } from "node:test";
import { combined } from "../../site/scripts/database/selection.js";
import { boxOf, lassoOf } from "../../site/scripts/map/area.js";

test("a box holds its inside and its rim, whichever corner it was begun at", () => {
  for (const box of [boxOf([10, 20], [30, 50]), boxOf([30, 50], [10, 20]), boxOf([10, 50], [30, 20])]) {
    assert.equal(box.path, "M10 20H30V50H10Z");
    for (const [x, y] of [
      [20, 30],
      [10, 20],
      [30, 50],
    ])
      assert.ok(box.holds(x, y));
    for (const [x, y] of [
      [9, 30],
      [31, 30],
      [20, 19],
      [20, 51],
    ])
      assert.ok(!box.holds(x, y));
  }
});

test("a lasso holds what it goes round, in both directions", () => {
  // The letter C: its mouth is outside.
  const line = [
    [0, 0],
    [10, 0],
    [10, 3],
    [3, 3],
    [3, 7],
    [10, 7],
    [10, 10],
    [0, 10],
  ];
  for (const lasso of [lassoOf(line), lassoOf([...line].reverse())]) {
    for (const [x, y] of [
      [1, 5],
      [8, 1],
      [8, 9],
      [1, 1],
    ])
      assert.ok(lasso.holds(x, y), `${x} ${y}`);
    for (const [x, y] of [
      [8, 5],
      [4, 4],
      [11, 1],
      [-1, 5],
      [5, 11],
    ])
      assert.ok(!lasso.holds(x, y), `${x} ${y}`);
  }
});

test("a place at the height of a corner is counted once", () => {
  const diamond = lassoOf([
    [5, 0],
    [10, 5],
    [5, 10],
    [0, 5],
  ]);
  assert.ok(diamond.holds(5, 5));
  assert.ok(diamond.holds(1, 5));
  assert.ok(!diamond.holds(-1, 5));
  assert.ok(!diamond.holds(11, 5));
});

test("both halves of a loop that crosses itself are inside, and so is what is gone round twice", () => {
  const eight = lassoOf([
    [0, 0],
    [10, 10],
    [10, 0],
    [0, 10],
  ]);
  assert.ok(eight.holds(1, 5) && eight.holds(9, 5));
  assert.ok(!eight.holds(5, 1));
  const square = [
    [0, 0],
    [10, 0],
    [10, 10],
    [0, 10],
  ];
  assert.ok(lassoOf([...square, ...square]).holds(5, 5));
});

test("a lasso of one or two places holds nothing", () => {
  assert.ok(!lassoOf([[5, 5]]).holds(5, 5));
  assert.ok(
    !lassoOf([
      [0, 0],
      [10, 10],
    ]).holds(5, 5),
  );
});

test("what is found replaces a selection, joins it, or leaves it", () => {
  const before = new Set([1, 2, 3]);
  assert.deepEqual(combined(before, [3, 4], "replace"), new Set([3, 4]));
  assert.deepEqual(combined(before, [3, 4], "add"), new Set([1, 2, 3, 4]));
  assert.deepEqual(combined(before, [3, 4], "subtract"), new Set([1, 2]));
  assert.deepEqual(before, new Set([1, 2, 3]));
});
