// Pictures spread over a map: what holds of every map, from a few shapes to ten thousand.

import assert from "node:assert/strict";
import { test } from "node:test";
import { FARTHEST, spread, thinned, TOLERANCE } from "../../site/scripts/map/spread.js";

const FRAME = { left: 0, right: 960, top: 0, bottom: 700 };

/** Numbers in [0, 1), the same for a seed. */
function randomOf(seed) {
  let state = seed * 2654435761 + 1;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Round groups on a frame, some upon each other. */
function makeMap({ seed, groups, each, radius }) {
  const random = randomOf(seed);
  const [x, y] = [[], []];
  for (let group = 0; group < groups; group += 1) {
    const [middleX, middleY] = [60 + random() * 840, 60 + random() * 580];
    for (let member = 0; member < each; member += 1) {
      const [angle, distance] = [random() * 7, radius * Math.sqrt(random())];
      x.push(Math.min(Math.max(middleX + distance * Math.cos(angle), 25), 935));
      y.push(Math.min(Math.max(middleY + distance * Math.sin(angle), 25), 675));
    }
  }
  return { x, y };
}

function assertApart({ x, y, pictured }, size) {
  const rows = [...pictured.keys()].filter((row) => pictured[row] === 1);
  for (const [place, row] of rows.entries()) {
    for (const other of rows.slice(0, place)) {
      const distance = Math.hypot(x[row] - x[other], y[row] - y[other]);
      assert.ok(distance >= size * (1 - TOLERANCE), `${row} covers ${other}: ${distance} of ${size}`);
    }
  }
  return rows.length;
}

for (const [name, map, size, least] of [
  ["few shapes", { seed: 1, groups: 5, each: 4, radius: 30 }, 60, 1],
  ["the demo", { seed: 2, groups: 14, each: 12, radius: 50 }, 42, 0.75],
  ["280 shapes", { seed: 3, groups: 14, each: 20, radius: 70 }, 36, 0.75],
  ["all in one place", { seed: 4, groups: 1, each: 12, radius: 0 }, 40, 1],
  ["a thousand", { seed: 5, groups: 30, each: 34, radius: 80 }, 36, 0.1],
]) {
  test(`no picture covers another: ${name}`, () => {
    const { x, y } = makeMap(map);
    const found = spread(x, y, size, { frame: FRAME });
    const share = assertApart(found, size) / x.length;
    assert.ok(share >= least, `only ${share} of the shapes have a picture`);
    for (let row = 0; row < x.length; row += 1) {
      const moved = Math.hypot(found.x[row] - x[row], found.y[row] - y[row]);
      assert.ok(moved <= FARTHEST * size + 1e-6, `picture ${row} stands ${moved} from its place`);
      if (found.pictured[row] === 0) assert.equal(moved, 0);
      else {
        assert.ok(found.x[row] >= size / 2 - 1e-6 && found.x[row] <= 960 - size / 2 + 1e-6, "it leaves the frame");
        assert.ok(found.y[row] >= size / 2 - 1e-6 && found.y[row] <= 700 - size / 2 + 1e-6, "it leaves the frame");
      }
    }
  });
}

/** Many groups in a few tight clumps, as UMAP makes them, the first shape of each group first. */
function makeClumps({ seed, clumps, groups, each, radius }) {
  const random = randomOf(seed);
  const middles = Array.from({ length: clumps }, () => [120 + random() * 720, 120 + random() * 460]);
  const [x, y, of] = [[], [], []];
  for (let member = 0; member < each; member += 1) {
    for (let group = 0; group < groups; group += 1) {
      const [angle, distance] = [random() * 7, radius * Math.sqrt(random())];
      x.push(middles[group % clumps][0] + distance * Math.cos(angle));
      y.push(middles[group % clumps][1] + distance * Math.sin(angle));
      of.push(group);
    }
  }
  return { x, y, groups: of };
}

for (const [name, given, size] of [
  ["fourteen in three clumps", { clumps: 3, groups: 14, each: 12, radius: 30 }, 42],
  ["in one place", { clumps: 1, groups: 10, each: 12, radius: 1 }, 36],
  ["small pictures", { clumps: 4, groups: 14, each: 20, radius: 40 }, 28],
]) {
  test(`every group has a picture where groups lie in tight clumps, and no dot is under that of another: ${name}`, () => {
    for (let seed = 1; seed <= 6; seed += 1) {
      const { x, y, groups } = makeClumps({ seed, ...given });
      const found = spread(x, y, size, { frame: FRAME, first: given.groups, groups, dot: 3 });
      const count = assertApart(found, size);
      assert.ok(count < x.length, "the clumps are too wide to tell anything");
      const shown = new Set(groups.filter((_, row) => found.pictured[row] === 1));
      assert.equal(shown.size, given.groups, `${shown.size} groups have a picture, seed ${seed}`);
      for (let row = 0; row < x.length; row += 1) {
        if (found.pictured[row] === 1) continue;
        for (let other = 0; other < x.length; other += 1) {
          if (found.pictured[other] === 0 || groups[other] === groups[row] || other < given.groups) continue;
          const distance = Math.hypot(found.x[other] - x[row], found.y[other] - y[row]);
          assert.ok(distance >= size / 2, `the picture of ${other} lies on the dot of ${row}, seed ${seed}`);
        }
      }
    }
  });
}

test("pictures that lie apart stay where they are", () => {
  const x = [100, 200, 300, 100, 200];
  const y = [100, 100, 100, 200, 230];
  assert.deepEqual(spread(x, y, 60), {
    x: Float64Array.from(x),
    y: Float64Array.from(y),
    pictured: new Uint8Array(5).fill(1),
  });
});

test("the same places give the same picture, wherever the map lies", () => {
  const { x, y } = makeMap({ seed: 6, groups: 14, each: 20, radius: 70 });
  const once = spread(x, y, 36);
  assert.deepEqual(spread(x, y, 36), once);
  const further = spread(
    x.map((value) => value + 1000),
    y.map((value) => value - 333),
    36,
  );
  const same = once.pictured.filter((value, row) => value === further.pictured[row]).length;
  assert.ok(same > 0.97 * x.length, `${same} of ${x.length}`);
});

test("who comes first comes first to a picture", () => {
  const { x, y } = makeMap({ seed: 7, groups: 1, each: 400, radius: 90 });
  for (const found of [spread(x, y, 50), thinned(x, y, 50, 1)]) assert.equal(found.pictured[0], 1);
});

test("a crowd is thinned at its exact places", () => {
  const { x, y } = makeMap({ seed: 8, groups: 10, each: 40, radius: 60 });
  const found = thinned(x, y, 40, 0.5);
  assert.deepEqual([...found.x], x);
  const rows = [...found.pictured.keys()].filter((row) => found.pictured[row] === 1);
  for (const row of rows)
    for (const other of rows) if (row !== other) assert.ok(Math.hypot(x[row] - x[other], y[row] - y[other]) >= 20);
});

test("it is done within a frame or a few", () => {
  for (const [groups, each, most] of [
    [14, 20, 100],
    [40, 250, 600],
  ]) {
    const { x, y } = makeMap({ seed: 9, groups, each, radius: 80 });
    const times = [1, 2, 3].map(() => {
      const started = performance.now();
      spread(x, y, 36, { frame: FRAME });
      return performance.now() - started;
    });
    const took = Math.min(...times);
    assert.ok(took < most, `${took} ms for ${groups * each} shapes`);
  }
});

test("those that stand for many others lie apart about their places, however few they are", () => {
  const size = 40;
  const { x, y } = makeMap({ seed: 5, groups: 1, each: 60, radius: 110 });
  const found = spread(x, y, size, { frame: FRAME, crowd: true });
  assertApart(found, size);
  const rows = [...found.pictured.keys()].filter((row) => found.pictured[row] === 1);
  assert.ok(rows.length >= 8 && rows.length < 30, `${rows.length} pictures`);
  for (const row of rows) assert.ok(Math.hypot(found.x[row] - x[row], found.y[row] - y[row]) < size / 2);
});
