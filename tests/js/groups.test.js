// What the groups of a comparison are called.

import assert from "node:assert/strict";
import { test } from "node:test";
import { nameOf } from "../../site/scripts/compare/groups.js";

const LEFTWARD = "כיסא 2";
const APART = `\u2068${LEFTWARD}\u2069`;

/** Three shapes of one class; the site's classes are clusters where they `standIn`. */
const database = (standIn) => ({
  classes: [LEFTWARD],
  className: () => LEFTWARD,
  names: ["ant 1", "ant 2", "ant 3"],
  data: { standIn },
  census: () => [[0, 2]],
});

test("a name that goes on to the left keeps the words about it in order", () => {
  const shapes = { kind: "shapes", shapes: new Set([0, 1]) };
  const among = { side: "b", other: { kind: "shapes", shapes: new Set([2]) } };
  assert.equal(nameOf(shapes, database(false), among), `B: \u20682 ${APART}\u2069`);
  assert.equal(nameOf({ kind: "search", text: LEFTWARD }, database(false)), `“${APART}”`);
  assert.equal(nameOf({ kind: "cluster", name: LEFTWARD }, database(false)), `those ${APART}`);
  assert.equal(nameOf({ kind: "class", group: 0 }, database(true)), `those ${APART}`);
  assert.equal(nameOf({ kind: "class", group: 0 }, database(false)), LEFTWARD);
});
