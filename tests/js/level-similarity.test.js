// Similar shapes of very many: sums over components, and shares of those that are farther, against their definitions.

import assert from "node:assert/strict";
import { test } from "node:test";
import { sharesFarther, squaresFrom } from "../../site/scripts/database/level-similarity.js";
import { first } from "../../site/scripts/database/similarity.js";

/** Whole numbers below a limit, the same with every run. */
function numbers(count, limit, seed = 1) {
  let state = seed;
  return Array.from({ length: count }, () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * limit);
  });
}

test("squares add up over components", () => {
  const [count, components] = [50, 6];
  const values = Uint8Array.from(numbers(count * components, 256));
  const found = squaresFrom(values, 17, count);
  for (let other = 0; other < count; other += 1) {
    let sum = 0;
    for (let component = 0; component < components; component += 1)
      sum += (values[component * count + other] - values[component * count + 17]) ** 2;
    assert.equal(found[other], sum);
  }
});

test("no sum of as many components as there may be is too large for its kind of number", () => {
  const values = Uint8Array.from({ length: 32 }, (_, place) => (place % 2) * 255);
  assert.equal(squaresFrom(values, 0, 2)[1], 16 * 255 ** 2);
});

for (const limit of [1000, 5, 1])
  test(`of squares below ${limit}, those that exceed one are counted, equal ones half`, () => {
    const squared = Int32Array.from(numbers(80, limit, 3));
    const [row, others] = [9, [4, 33, 5, 70, 71]];
    const found = sharesFarther(squared, row, others);
    for (const [place, other] of others.entries()) {
      const rest = [...squared.keys()].filter((index) => index !== row && index !== other);
      const above = rest.filter((index) => squared[index] > squared[other]).length;
      const equal = rest.filter((index) => squared[index] === squared[other]).length;
      assert.ok(Math.abs(found[place] - (above + equal / 2) / rest.length) < 1e-12);
    }
  });

test("of two shapes nobody else is farther or nearer", () => {
  assert.deepEqual(sharesFarther(Int32Array.from([0, 7]), 0, [1]), [0.5]);
});

test("the lowest come first, of equal ones those that stand first", () => {
  const squared = Float64Array.from(numbers(200, 12, 5));
  const expected = [...squared.keys()]
    .filter((other) => other !== 3 && other % 2 === 1)
    .sort((a, b) => squared[a] - squared[b] || a - b);
  for (const count of [0, 1, 10, 99, 500])
    assert.deepEqual(
      first(squared, 3, count, (other) => other % 2 === 1),
      expected.slice(0, count),
    );
});
