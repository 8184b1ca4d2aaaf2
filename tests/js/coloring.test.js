// What colours say on a map: few values, many, numbers, dates, and what is not known.

import assert from "node:assert/strict";
import { test } from "node:test";
import { between, fieldColoring, placedGroups, stripesOf, trustColoring } from "../../site/scripts/map/coloring.js";

const marks = {
  unlabelled: "#888888",
  ink: "#000000",
  classes: ["#111111"],
  ramp: ["#000000", "#ffffff"],
  categories: ["#a00000", "#00a000", "#0000a0"],
};
const database = {
  marks,
  data: { marks: { plain: "o", missing: "x", categories: ["1", "2", "3"] } },
  groups: [0, 0, 0, 0, 0, 0],
  className: () => "ant",
  symbol: () => "o",
};
const field = (more) => ({
  key: "column:a",
  title: "a",
  unit: "",
  date: false,
  names: null,
  of: null,
  numbers: null,
  ...more,
});
const looks = (coloring, count) => Array.from({ length: count }, (_, index) => coloring.look(coloring.kindOf(index)));

test("each of a few values has a look and a line", () => {
  const coloring = fieldColoring(database, field({ names: ["p", "q"], of: [0, 1, 1, -1] }));
  assert.deepEqual(
    looks(coloring, 4).map(({ color }) => color),
    ["#a00000", "#00a000", "#00a000", "#888888"],
  );
  assert.equal(looks(coloring, 4)[3].symbol, "x");
  assert.deepEqual(
    coloring.legend.lines.map(({ name, shapes }) => [name, shapes]),
    [
      ["p", [0]],
      ["q", [1, 2]],
      ["no a", [3]],
    ],
  );
  assert.deepEqual([0, 3].map(coloring.naming.groupOf), [0, -1]);
  assert.equal(coloring.naming.nameOf(1), "q");
});

test("of many values those with most shapes are named, in their order, and the others are one", () => {
  const coloring = fieldColoring(database, field({ names: ["p", "q", "r", "s"], of: [0, 1, 1, 2, 3, 3] }));
  assert.deepEqual(
    coloring.legend.lines.map(({ name, shapes }) => [name, shapes]),
    [
      ["q", [1, 2]],
      ["s", [4, 5]],
      ["other (2 more)", [0, 3]],
    ],
  );
  assert.equal(looks(coloring, 1)[0].color, "#888888");
  assert.equal(looks(coloring, 1)[0].symbol, "o");
  assert.equal(coloring.textOf(0), "p");
});

test("numbers have a ramp from the lowest to the highest, and a mark of their own where there is none", () => {
  const coloring = fieldColoring(database, field({ numbers: [10, 20, null, 15], unit: "mm" }));
  assert.deepEqual(
    looks(coloring, 4).map(({ color }) => color),
    ["rgb(0 0 0)", "rgb(255 255 255)", "#888888", "rgb(128 128 128)"],
  );
  assert.deepEqual(coloring.legend.ramp.texts, ["10 mm", "15 mm", "20 mm"]);
  assert.deepEqual(
    coloring.legend.lines.map(({ name, shapes }) => [name, shapes]),
    [["no value", [2]]],
  );
  assert.equal(coloring.textOf(2), "–");
});

test("numbers over many powers of ten are told apart by factors", () => {
  const coloring = fieldColoring(database, field({ numbers: [0.1, 10, 1000] }));
  assert.equal(looks(coloring, 2)[1].color, "rgb(128 128 128)");
  assert.deepEqual(coloring.legend.ramp.texts, ["0.1", "10", "1000"]);
});

test("where half would look alike, numbers are told apart by factors, and else by differences", () => {
  const texts = (numbers) => fieldColoring(database, field({ numbers })).legend.ramp.texts;
  assert.deepEqual(texts([100, 200, 400, 800, 10000]), ["100", "1000", "10\u202f000"]);
  assert.deepEqual(texts([1, 500, 600, 800, 1000]), ["1", "500.5", "1000"]);
  assert.deepEqual(texts([0, 200, 400, 800, 10000]), ["0", "5000", "10\u202f000"]);
});

test("dates are dates in the legend and in words", () => {
  const coloring = fieldColoring(database, field({ numbers: [-719162, 0, 365], date: true }));
  assert.equal(coloring.textOf(1), "1970-01-01");
  assert.equal(coloring.legend.ramp.texts[0], "0001-01-01");
  assert.equal(coloring.legend.ramp.texts[2], "1971-01-01");
});

test("one number for all shapes, or none, is no error", () => {
  const same = fieldColoring(database, field({ numbers: [3, 3] }));
  assert.equal(same.look(same.kindOf(0)).color, "rgb(0 0 0)");
  const none = fieldColoring(database, field({ numbers: [null, null] }));
  assert.deepEqual(none.legend.ramp.texts, []);
});

test("where colours are numbers, symbols are those of the classes", () => {
  const two = { ...database, groups: [0, 1, -1], symbol: (group) => ["o", "+"][group] ?? "." };
  const coloring = fieldColoring(two, field({ numbers: [10, 20, 10] }));
  assert.deepEqual(
    looks(coloring, 3).map(({ symbol, color }) => [symbol, color]),
    [
      ["o", "rgb(0 0 0)"],
      ["+", "rgb(255 255 255)"],
      [".", "rgb(0 0 0)"],
    ],
  );
  assert.ok(coloring.ofClasses);
});

test("the strip of some shapes has a stripe for each, in the order of their colours", () => {
  const coloring = fieldColoring(database, field({ names: ["p", "q"], of: [1, -1, 0, 1] }));
  assert.deepEqual(stripesOf(coloring, [0, 1, 2, 3]), [
    "#a00000 0.00% 25.00%",
    "#00a000 25.00% 50.00%",
    "#00a000 50.00% 75.00%",
    "#888888 75.00% 100.00%",
  ]);
});

test("a group has a place where its shapes have others of theirs about them, and none where it is strewn", () => {
  // On a line, the three nearest of each.
  const count = 60;
  const onLine = {
    ids: Array.from({ length: count }, (_, index) => `${index}`),
    neighbours: (index) => [1, -1, 2, -2].map((way) => index + way).filter((at) => at >= 0 && at < count),
  };
  const placed = (groupOf) => [...placedGroups({ groupOf }, onLine, 0)].sort();
  assert.deepEqual(
    placed((index) => Math.floor(index / 20)),
    [0, 1, 2],
  );
  assert.deepEqual(
    placed((index) => index % 3),
    [],
  );
  assert.deepEqual(
    placed((index) => (index < 20 ? 0 : 1 + (index % 2))),
    [0],
  );
  // Nearly all are of one group: that others of it lie about its shapes says nothing.
  assert.deepEqual(
    placed((index) => Number(index % 10 === 0)),
    [],
  );
  assert.deepEqual(
    placed(() => -1),
    [],
  );
});

test("a ramp is mixed between its colours", () => {
  assert.equal(between(["#000000", "#646464", "#ffffff"], 0.25), "rgb(50 50 50)");
  assert.equal(between(["#000000", "#ffffff"], 7), "rgb(255 255 255)");
});

test("what a map makes of neighbours is told of the map that is drawn, on one scale for all", () => {
  const map = (shares) => ({ neighbours: 10, faith: { kept: shares, false: shares, missing: shares } });
  const maps = [map([0, 0.1, 0.2, 0.2, 0, 0]), map([0, 0.4, 0.2, null, 0, 0])];
  const two = { ...database, ids: [0, 1, 2, 3, 4, 5], projections: maps };
  let shown = maps[0];
  const coloring = trustColoring(two, "false", () => shown);
  assert.equal(coloring.textOf(1), "10\u00a0%");
  assert.equal(looks(coloring, 2)[1].color, between(marks.ramp, 12 / 48));
  assert.deepEqual(coloring.legend.ramp.texts, ["0\u00a0%", "20\u00a0%", "40\u00a0%"]);
  assert.match(coloring.note, /the ten nearest on this map/);
  shown = maps[1];
  assert.equal(coloring.textOf(1), "40\u00a0%");
  assert.equal(looks(coloring, 4)[1].color, "rgb(255 255 255)");
  assert.equal(looks(coloring, 4)[3].symbol, "x");
  assert.equal(coloring.of(maps[0]).textOf(1), "10\u00a0%");
  const beyond = coloring.of(map([0.8, 0, 0, 0, 0, 0]));
  assert.deepEqual(beyond.legend.ramp.texts, ["0\u00a0%", "20\u00a0%", "≥ 40\u00a0%"]);
  assert.equal(looks(beyond, 1)[0].color, "rgb(255 255 255)");
  assert.deepEqual(trustColoring(two, "kept", () => shown).legend.ramp.texts, ["0\u00a0%", "50\u00a0%", "100\u00a0%"]);
  assert.equal(coloring.of({ neighbours: 10 }).textOf(0), "–");
});
