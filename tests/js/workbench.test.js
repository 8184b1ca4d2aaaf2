// The steps of work on the Workbench.

import assert from "node:assert/strict";
import { test } from "node:test";
import { alike, changes } from "../../site/scripts/workbench/history.js";

const step = (bins, hidden = [], features = [0, 1]) => ({
  bins: new Set(bins),
  hidden: new Set(hidden),
  features: new Set(features),
});

test("a step says what it added before what it took away", () => {
  assert.deepEqual(changes(step([1, 2, 3]), step([3, 4, 5, 6])), [
    [3, "bin"],
    [-2, "bin"],
  ]);
  // A class is taken out of use by hiding it.
  assert.deepEqual(changes(step([]), step([], [4])), [[-1, "class"]]);
  assert.deepEqual(changes(step([], [], [0]), step([], [], [0, 1])), [[1, "feature"]]);
  assert.deepEqual(changes(step([1]), step([1])), []);
});

test("steps are alike by what they choose, in whatever order", () => {
  assert.ok(alike(step([1, 2]), step([2, 1])));
  assert.ok(!alike(step([1, 2]), step([1, 3])));
});
