// A map turned beside another.

import assert from "node:assert/strict";
import { test } from "node:test";
import { turned } from "../../site/scripts/workbench/turned.js";

const map = { x: [1, -0.5, -0.5, 0.2], y: [0.1, 0.8, -0.9, 0] };

test("a map that was turned and mirrored lies as it did", () => {
  for (const mirror of [1, -1]) {
    for (const angle of [0, 0.4, 2, -3]) {
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      const moved = {
        x: map.x.map((x, row) => cos * x - sin * mirror * map.y[row]),
        y: map.x.map((x, row) => sin * x + cos * mirror * map.y[row]),
      };
      const back = turned(moved, map);
      for (const row of map.x.keys()) {
        assert.ok(Math.abs(back.x[row] - map.x[row]) < 1e-9);
        assert.ok(Math.abs(back.y[row] - map.y[row]) < 1e-9);
      }
    }
  }
});

test("shapes without a place have none after, and turn nothing", () => {
  const gap = { x: [...map.x, NaN], y: [...map.y, NaN] };
  const back = turned(gap, { x: [...map.x, 7], y: [...map.y, 7] });
  assert.deepEqual(
    [...back.x].map((x) => Number(x.toFixed(6))),
    [1, -0.5, -0.5, 0.2, NaN],
  );
  assert.deepEqual([...turned({ x: [0], y: [0] }, map).x], [0]);
});
