// Names on maps: what holds for every place, on crowded maps too.

import assert from "node:assert/strict";
import { test } from "node:test";
import { leaderOf, placeNames } from "../../site/scripts/map/placement.js";

const RADIUS = 4.5;

/** Numbers in [0, 1), the same for a seed. */
function randomOf(seed) {
  let state = seed * 2654435761 + 1;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** A map of round groups, which may lie upon each other. */
function makeMap({ seed, classes, each, spread, frame }) {
  const random = randomOf(seed);
  const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
  const marks = [];
  for (let group = 0; group < classes; group += 1) {
    const [x, y] = [20 + random() * (frame.width - 40), 20 + random() * (frame.height - 40)];
    for (let i = 0; i < each; i += 1) {
      const mark = { index: marks.length, group, x: x + normal() * spread, y: y + normal() * spread };
      marks.push(mark);
    }
  }
  const shown = marks.filter(({ x, y }) => x > 0 && y > 0 && x < frame.width && y < frame.height);
  const names = new Map(
    Array.from({ length: classes }, (_, group) => [group, { width: 50 + Math.floor(random() * 70), height: 18 }]),
  );
  return { marks: shown, names, frame };
}

const boxOf = (place, marks, names) => {
  const anchor = marks.find((mark) => mark.index === place.anchor);
  const { width, height } = names.get(place.group);
  const [x, y] = [anchor.x + place.dx, anchor.y + place.dy];
  return { left: x - width / 2, right: x + width / 2, top: y - height / 2, bottom: y + height / 2 };
};

const gap = (box, { x, y }) =>
  Math.hypot(Math.max(box.left - x, 0, x - box.right), Math.max(box.top - y, 0, y - box.bottom));

/** The largest cluster of a class as it is drawn, its marks linked where their edges are 20 pixels apart or less. */
function largestCluster(marks, group) {
  let rest = marks.filter((mark) => mark.group === group);
  let largest = [];
  while (rest.length > 0) {
    const cluster = [rest[0]];
    rest = rest.slice(1);
    for (const mark of cluster) {
      const near = ({ x, y }) => Math.hypot(mark.x - x, mark.y - y) <= 2 * RADIUS + 20;
      cluster.push(...rest.filter(near));
      rest = rest.filter((other) => !near(other));
    }
    if (cluster.length > largest.length) largest = cluster;
  }
  return largest;
}

/** The marks of other classes that a line crosses. */
function crossed({ x1, y1, x2, y2 }, marks, group) {
  return marks.filter((mark) => {
    if (mark.group === group) return false;
    const squared = (x2 - x1) ** 2 + (y2 - y1) ** 2;
    const along = Math.min(Math.max(((mark.x - x1) * (x2 - x1) + (mark.y - y1) * (y2 - y1)) / squared, 0), 1);
    return Math.hypot(x1 + along * (x2 - x1) - mark.x, y1 + along * (y2 - y1) - mark.y) < RADIUS;
  }).length;
}

/** What no placing may ever break, by brute force. */
function assertTrue(places, { marks, names, frame }) {
  const boxes = places.map((place) => boxOf(place, marks, names));
  for (const [position, place] of places.entries()) {
    const box = boxes[position];
    assert.ok(box.left >= 0 && box.top >= 0 && box.right <= frame.width && box.bottom <= frame.height, "outside");
    const nearest = (of) => Math.min(...of.map((mark) => gap(box, mark)));
    const strangers = marks.filter((mark) => mark.group !== place.group);
    const cluster = largestCluster(marks, place.group);
    // Of two as large as each other either will do.
    const anchor = marks.find((mark) => mark.index === place.anchor);
    const own = cluster.includes(anchor)
      ? cluster
      : largestCluster([anchor, ...marks.filter((mark) => mark !== anchor)], place.group);
    assert.ok(own.includes(anchor), `the name of ${place.group} is that of a stray`);
    const others = nearest(strangers);
    if (place.leader) {
      assert.ok(others > RADIUS, "a name with a line covers marks");
      assert.ok(
        Math.min(...strangers.map(({ x, y }) => Math.hypot(x - anchor.x, y - anchor.y))) > RADIUS - 1.5,
        "unseen",
      );
    } else assert.ok(nearest(own) < others, `${place.group} is nearer to another class: ${nearest(own)} and ${others}`);
    for (const other of boxes.slice(0, position)) {
      const apart =
        box.left >= other.right || other.left >= box.right || box.top >= other.bottom || other.top >= box.bottom;
      assert.ok(apart, "names lie upon each other");
    }
  }
}

const DESK = { width: 700, height: 640 };
const PHONE = { width: 340, height: 320 };

for (const [name, given, least] of [
  ["a few classes apart", { classes: 8, each: 20, spread: 14, frame: DESK }, 8],
  ["fourteen on a phone", { classes: 14, each: 20, spread: 14, frame: PHONE }, 9],
  ["classes upon each other", { classes: 20, each: 20, spread: 60, frame: DESK }, 8],
  ["forty-five", { classes: 45, each: 12, spread: 12, frame: DESK }, 33],
  ["seventy, more than there is room for", { classes: 70, each: 30, spread: 16, frame: DESK }, 38],
]) {
  test(`no name is nearer to another class than to its own: ${name}`, () => {
    for (let seed = 1; seed <= 8; seed += 1) {
      const map = makeMap({ seed, ...given });
      const places = placeNames(map.marks, map.names, map.frame, RADIUS);
      assertTrue(places, map);
      assert.ok(places.length >= least, `${places.length} names, seed ${seed}`);
    }
  });
}

test("no name stands below what lies over the map", () => {
  const covered = [{ left: 240, right: 340, top: 0, bottom: 40 }];
  for (let seed = 1; seed <= 8; seed += 1) {
    const map = makeMap({ seed, classes: 14, each: 20, spread: 14, frame: PHONE });
    const places = placeNames(map.marks, map.names, { ...map.frame, covered }, RADIUS);
    assert.ok(places.length >= 7);
    for (const place of places) {
      const box = boxOf(place, map.marks, map.names);
      assert.ok(box.right <= 240 || box.top >= 40, `the name of ${place.group} is covered`);
    }
  }
});

test("names keep their places while the map is zoomed, as long as they have room in it", () => {
  let [kept, all] = [0, 0];
  for (let seed = 1; seed <= 8; seed += 1) {
    const map = makeMap({ seed, classes: 14, each: 20, spread: 14, frame: DESK });
    const before = placeNames(map.marks, map.names, map.frame, RADIUS);
    const marks = map.marks
      .map((mark) => ({ ...mark, x: (mark.x - 350) * 1.15 + 350, y: (mark.y - 320) * 1.15 + 320 }))
      .filter(({ x, y }) => x > 0 && y > 0 && x < DESK.width && y < DESK.height);
    const after = placeNames(marks, map.names, map.frame, RADIUS, before);
    assertTrue(after, { ...map, marks });
    for (const old of before) {
      if (!marks.some(({ index }) => index === old.anchor)) continue;
      const box = boxOf(old, marks, map.names);
      if (box.left < 2 || box.top < 2 || box.right > DESK.width - 2 || box.bottom > DESK.height - 2) continue;
      all += 1;
      const place = after.find(({ group }) => group === old.group);
      if (place?.anchor === old.anchor && place.dx === old.dx && place.dy === old.dy) kept += 1;
    }
  }
  assert.ok(all > 60);
  assert.ok(kept >= 0.95 * all, `${kept} of ${all} stay`);
});

test("a class among others, without space beside it, has a line or no name", () => {
  // One mark of class 0 in the midst of a grid of class 1.
  const marks = [{ index: 0, group: 0, x: 200, y: 200 }];
  for (let x = 110; x <= 290; x += 12)
    for (let y = 110; y <= 290; y += 12)
      if (Math.hypot(x - 200, y - 200) > 6) marks.push({ index: marks.length, group: 1, x, y });
  const names = new Map([
    [0, { width: 60, height: 18 }],
    [1, { width: 60, height: 18 }],
  ]);
  const frame = { width: 400, height: 400 };
  const place = placeNames(marks, names, frame, RADIUS).find(({ group }) => group === 0);
  assert.ok(place.leader);
  const line = leaderOf(boxOf(place, marks, names), marks[0]);
  assert.deepEqual([line.x2, line.y2], [200, 200]);
  // Without free space around there is none.
  const close = { width: 300, height: 300 };
  const moved = marks.map((mark) => ({ ...mark, x: mark.x - 50, y: mark.y - 50 }));
  for (let x = 0; x <= 300; x += 12)
    for (const y of [0, 12, 24, 36, 48, 252, 264, 276, 288, 300]) moved.push({ index: moved.length, group: 1, x, y });
  for (let y = 60; y <= 240; y += 12)
    for (const x of [0, 12, 24, 36, 48, 252, 264, 276, 288, 300]) moved.push({ index: moved.length, group: 1, x, y });
  assert.equal(
    placeNames(moved, names, close, RADIUS).find(({ group }) => group === 0),
    undefined,
  );
});

test("a name stands at the cluster of its class and not at a stray, and its line crosses no others without need", () => {
  // A cluster of class 0 between two walls of others, and one of its marks far below, where there is room for a name.
  const marks = [];
  const add = (group, x, y) => marks.push({ index: marks.length, group, x, y });
  add(0, 200, 330);
  for (let x = 180; x <= 220; x += 8) for (let y = 180; y <= 220; y += 8) add(0, x, y);
  for (let y = 160; y <= 240; y += 8)
    for (const x of [160, 240]) {
      add(1, x, y);
      add(1, x + (x < 200 ? -8 : 8), y);
    }
  for (let x = 168; x <= 232; x += 8) add(2, x, 160);
  const names = new Map([0, 1, 2].map((group) => [group, { width: 70, height: 18 }]));
  const map = { marks, names, frame: { width: 400, height: 400 } };
  const places = placeNames(marks, names, map.frame, RADIUS);
  assertTrue(places, map);
  const place = places.find(({ group }) => group === 0);
  assert.ok(place.leader);
  const line = leaderOf(boxOf(place, marks, names), marks[place.anchor]);
  assert.equal(crossed(line, marks, 0), 0);
  // Who has a name keeps it only as long as it is not that of a stray.
  const stray = { group: 0, anchor: 0, dx: 0, dy: 20, leader: false };
  assertTrue(placeNames(marks, names, map.frame, RADIUS, [stray]), map);
});

test("a line ends on a picture of the class rather than on a dot beside it", () => {
  const marks = [{ index: 0, group: 0, x: 200, y: 200, radius: 18 }];
  for (const [x, y] of [
    [185, 165],
    [200, 162],
    [215, 165],
  ])
    marks.push({ index: marks.length, group: 0, x, y, radius: 4 });
  for (let angle = 0; angle < 6.2; angle += 0.35)
    marks.push({
      index: marks.length,
      group: 1,
      x: 200 + 55 * Math.cos(angle),
      y: 190 + 55 * Math.sin(angle),
      radius: 12,
    });
  const names = new Map([[0, { width: 80, height: 18 }]]);
  const [place] = placeNames(marks, names, { width: 400, height: 400 }, 18);
  assert.ok(place.leader);
  assert.equal(place.anchor, 0);
});

test("a class whose every mark others cover has no name", () => {
  const marks = [
    { index: 0, group: 0, x: 100, y: 100 },
    { index: 1, group: 1, x: 102, y: 100, radius: 20 },
  ];
  const names = new Map([
    [0, { width: 60, height: 18 }],
    [1, { width: 60, height: 18 }],
  ]);
  const places = placeNames(
    marks.map((mark) => ({ radius: 4, ...mark })),
    names,
    { width: 300, height: 300 },
    20,
  );
  assert.deepEqual(
    places.map(({ group }) => group),
    [1],
  );
});

test("shapes without a class have no name and are in the way", () => {
  const names = new Map([[0, { width: 60, height: 18 }]]);
  const marks = [
    { index: 0, group: 0, x: 100, y: 100 },
    { index: 1, group: -1, x: 100, y: 85 },
  ];
  const places = placeNames(marks, names, { width: 200, height: 200 }, RADIUS);
  assert.equal(places.length, 1);
  assertTrue(places, { marks, names, frame: { width: 200, height: 200 } });
});
