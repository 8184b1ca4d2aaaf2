// The steps of work on the Workbench.

import assert from "node:assert/strict";
import { test } from "node:test";
import { alike, changes, History, turns } from "../../site/scripts/workbench/history.js";

const step = (bins, { hidden = [], features = [0, 1], taken = 0, ...manner } = {}) => ({
  bins: new Set(bins),
  hidden: new Set(hidden),
  features: new Set(features),
  projection: "tsne",
  scorer: "rfe",
  separation: { from: null, against: null, each: true },
  taken,
  ...manner,
});

test("a step says what it added before what it took away", () => {
  assert.deepEqual(changes(step([1, 2, 3]), step([3, 4, 5, 6])), [
    [3, "bin"],
    [-2, "bin"],
  ]);
  // A class is taken out of use by hiding it.
  assert.deepEqual(changes(step([]), step([], { hidden: [4] })), [[-1, "class"]]);
  assert.deepEqual(changes(step([], { features: [0] }), step([])), [[1, "feature"]]);
  assert.deepEqual(changes(step([1]), step([1])), []);
  assert.deepEqual(turns(step([1]), step([2], { projection: "umap", scorer: "anova" })), ["other map", "other scorer"]);
});

test("steps are alike by what they choose and how they look at it, in whatever order", () => {
  const some = { from: new Set([1, 2]), against: null, each: true };
  assert.ok(alike(step([1, 2]), step([2, 1])));
  assert.ok(!alike(step([1, 2]), step([1, 3])));
  assert.ok(!alike(step([1]), step([1], { projection: "umap" })));
  assert.ok(alike(step([], { separation: some }), step([], { separation: { ...some, from: new Set([2, 1]) } })));
  assert.ok(!alike(step([], { separation: some }), step([])));
});

test("steps are those of the browser's history", () => {
  const history = new History();
  const bins = () => history.steps.map((one) => [...one.bins].join());
  history.take(step([], { taken: 2 }));
  for (const bin of [1, 2]) history.take(step([bin], { taken: 2 + bin }));
  // What the page does by itself takes no step.
  history.take(step([2, 3], { taken: 4 }));
  assert.deepEqual(bins(), ["", "1", "2,3"]);
  history.arrive(step([1], { taken: 3 }));
  assert.equal(history.at, 1);
  // From before the page was opened anew.
  history.arrive(step([9], { taken: 0 }));
  assert.deepEqual(bins(), ["9", "", "1", "2,3"]);
  assert.equal(history.at, 0);
  // An address written by hand, where another step had been undone.
  history.arrive(step([1], { taken: 3 }));
  history.arrive(step([7], { taken: 4 }));
  assert.deepEqual(bins(), ["9", "", "1", "7"]);
  // What leads back to the step before is that one.
  history.take(step([1], { taken: 4 }));
  assert.deepEqual([bins(), history.at], [["9", "", "1"], 2]);
});

test("where the work is the same, the step is", () => {
  const history = new History();
  const bins = () => history.steps.map((one) => [...one.bins].join());
  history.take(step([], { taken: 0 }));
  // Shapes were selected, then a bin was chosen, and others were selected.
  history.take(step([1], { taken: 2 }));
  for (const [taken, at] of [
    [1, 0],
    [3, 1],
    [2, 1],
    [0, 0],
  ]) {
    history.arrive(step(at === 0 ? [] : [1], { taken }));
    assert.deepEqual([bins(), history.at], [["", "1"], at]);
  }
  // A reader who selects here leaves what was undone.
  history.branch(1);
  assert.deepEqual([bins(), history.at], [[""], 0]);
  // The page is opened anew, and the reader goes back to before the step.
  const again = new History();
  again.take(step([1], { taken: 3 }));
  for (const taken of [2, 3]) {
    again.arrive(step([1], { taken }));
    assert.deepEqual([again.steps.length, again.at], [1, 0]);
  }
  again.arrive(step([], { taken: 1 }));
  assert.deepEqual([again.steps.length, again.at], [2, 0]);
});
