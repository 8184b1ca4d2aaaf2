// What pages compute of a database without a page.

import assert from "node:assert/strict";
import { test } from "node:test";
import { hitRange, shareOfRange } from "../../site/scripts/database/hit-range.js";
import { sampled } from "../../site/scripts/database/sample.js";

test("a class of k shapes or fewer bounds what its neighbourhood hit can be", () => {
  const groups = [...Array(8).fill(0), ...Array(20).fill(1), -1];
  const { highest, highestOfClass, chanceOfClass } = hitRange(groups, 10);
  assert.equal(highestOfClass.get(0), 0.7);
  assert.equal(highestOfClass.get(1), 1);
  assert.ok(Math.abs(highest - (8 * 0.7 + 20) / 28) < 1e-12);
  assert.equal(chanceOfClass.get(0), 7 / 28);
  assert.equal(shareOfRange(0.7, 0.1, 0.7), 1);
});

test("a sample keeps each class in proportion and loses none", () => {
  const groups = Array.from({ length: 10000 }, (_, row) => (row < 9000 ? 0 : row < 9990 ? 1 : row < 9999 ? 2 : -1));
  const rows = groups.map((_, row) => row);
  const taken = sampled(rows, groups, 1000);
  const counts = new Map();
  for (const row of taken) counts.set(groups[row], (counts.get(groups[row]) ?? 0) + 1);
  assert.deepEqual(
    counts,
    new Map([
      [0, 899],
      [1, 99],
      [2, 1],
      [-1, 1],
    ]),
  );
  assert.deepEqual(taken, taken.slice().sort());
  assert.deepEqual(sampled(rows, groups, 1000), taken);
  assert.equal(sampled(rows, groups, 10000), rows);
});
