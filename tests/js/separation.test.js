// What the Workbench says that scores tell apart, in words.

import assert from "node:assert/strict";
import { test } from "node:test";
import { separationWords } from "../../site/scripts/workbench/separation.js";

const groups = [0, 1, 2, 3, 4];
const database = { className: (group) => "abcde"[group], data: { standIn: false } };

const words = (from, against, each) =>
  separationWords({ from: from && new Set(from), against: against && new Set(against), each }, groups, database);

test("what is ticked on both sides is told from what is on the other alone", () => {
  assert.equal(words([0], [0, 1, 2], true), "a from each of b and c");
  assert.equal(words([0, 1], [1, 2], false), "a and b, together, from c");
  assert.equal(words([0, 1], groups, false), "a and b, together, from the rest");
  assert.equal(words([0], groups, true), "a from each of the rest");
  assert.equal(words([0], groups, false), "a from the rest");
});

test("each of several is told from all that are chosen, or from each other", () => {
  assert.equal(words(null, null, true), "all 5 classes, each from the rest");
  assert.equal(words(groups, groups, true), "all 5 classes, each from each other");
  assert.equal(words([0, 1], [1, 0], true), "a from b");
  assert.equal(words([0, 1, 2], [2, 1, 0], true), "a, b and c, each from each other");
  assert.equal(words([0, 1], [1, 2], true), "a and b, each from b and c");
});
