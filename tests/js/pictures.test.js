// Pictures stand class by class among all, those of a class in the order of their shapes.

import assert from "node:assert/strict";
import { test } from "node:test";
import { placesByClass } from "../../site/scripts/base/pictures.js";

/** The slow way. */
function expected(groups) {
  const order = [...groups.keys()].sort((a, b) => groups[a] - groups[b] || a - b);
  const places = Array(groups.length);
  for (const [place, index] of order.entries()) places[index] = place;
  return places;
}

test("those without a class come first, then class after class", () => {
  for (const groups of [[], [-1], [0], [-1, -1], [2, 0, -1, 2, 1, -1, 0], [5, 5, 0], [0, 1, 2], [2, 1, 0]])
    assert.deepEqual([...placesByClass(Int32Array.from(groups))], expected(groups), groups.join());
});
