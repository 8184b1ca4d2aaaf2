// Shapes that a map was not made of stand beside the one that is most like them.

import assert from "node:assert/strict";
import { test } from "node:test";
import { placeBeside, spread } from "../../site/scripts/engine/beside.js";
import { Nearest } from "../../site/scripts/engine/nearest.js";

/** Numbers from 0 to 1, the same with every run. */
function numbers(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function brute({ count, width, values }, point) {
  let [row, least] = [0, Infinity];
  for (let other = 0; other < count; other += 1) {
    let sum = 0;
    for (let place = 0; place < width; place += 1) sum += (values[other * width + place] - point[place]) ** 2;
    if (sum < least) [row, least] = [other, sum];
  }
  return { row, squared: least };
}

for (const [name, count, width, grid] of [
  ["in few dimensions", 400, 2, 0],
  ["in many", 300, 30, 0],
  ["with many that are equally near", 500, 3, 4],
  ["where all are in one place", 40, 5, 1],
  ["of one point", 1, 4, 0],
])
  test(`the nearest is found ${name}`, () => {
    const next = numbers(count);
    const value = () => (grid ? Math.floor(next() * grid) / grid : next() ** 3);
    const points = { count, width, values: Float32Array.from({ length: count * width }, value) };
    const nearest = new Nearest(points);
    for (let asked = 0; asked < 200; asked += 1) {
      const point = Float32Array.from({ length: width }, value);
      assert.deepEqual(nearest.find(point), brute(points, point));
    }
    // Far from all as well, and where one of them is.
    const away = new Float32Array(width).fill(-7);
    assert.equal(nearest.find(away).row, brute(points, away).row);
    assert.equal(nearest.find(points.values.slice(0, width)).squared, 0);
  });

test("few of many points in groups are looked at", () => {
  const next = numbers(5);
  const [count, width] = [2500, 8];
  const clump = () => Math.floor(next() * 20);
  const near = (group) => Float32Array.from({ length: width }, (_, place) => ((group * (place + 3)) % 7) + next() / 5);
  const values = new Float32Array(count * width);
  for (let row = 0; row < count; row += 1) values.set(near(clump()), row * width);
  const nearest = new Nearest({ count, width, values });
  nearest.work = 0;
  for (let asked = 0; asked < 100; asked += 1) nearest.find(near(clump()));
  assert.ok(nearest.work < (100 * count * width) / 4, `${nearest.work}`);
});

const [COUNT, FURTHER, WIDTH] = [60, 600, 4];
const COLUMNS = Int32Array.of(2, 0, 3);

for (const kind of /** @type {const} */ (["columns of the table", "numbers of their own"]))
  test(`each stands beside the one of the map that it is most like by ${kind}, the most alike the nearest`, () => {
    const next = numbers(9);
    const rows = COUNT + FURTHER;
    const values = Float32Array.from({ length: rows * WIDTH }, next);
    const held = { steps: values, most: 1, low: [0], high: [1] };
    const table = { rows, columns: WIDTH, ...held, blocks: new Int32Array(WIDTH), weights: [1], scaling: "balanced" };
    // Every eleventh shape is on the map.
    const all = Array.from({ length: rows }, (_, row) => row);
    const shapes = Int32Array.from(all.filter((row) => row % 11 === 0));
    const others = Int32Array.from(all.filter((row) => row % 11 > 0));
    const xy = Float32Array.from({ length: 2 * shapes.length }, () => 2 * next() - 1);
    const own = Array.from({ length: 5 }, () => Uint8Array.from(all, () => 256 * next()));
    const units = [0.1, 2, 1, 0.5, 0.3];
    const compared =
      kind === "columns of the table"
        ? { columns: COLUMNS, by: /** @type {const} */ ("bins") }
        : { numbers: own.map((held, place) => ({ values: held, unit: units[place] })) };
    const steps = placeBeside(table, { compared, shapes, xy, others });
    let step = steps.next();
    while (!step.done) step = steps.next();
    const placed = step.value.xy;

    // By hand: columns divided by their spread over the table.
    const deviations = Array.from(COLUMNS, (column) => {
      const held = values.subarray(column * rows, (column + 1) * rows);
      const mean = held.reduce((sum, value) => sum + value, 0) / rows;
      return Math.sqrt(held.reduce((sum, value) => sum + (value - mean) ** 2, 0) / rows);
    });
    const distance = (one, other) =>
      kind === "columns of the table"
        ? Math.hypot(
            ...Array.from(
              COLUMNS,
              (column, place) => (values[column * rows + one] - values[column * rows + other]) / deviations[place],
            ),
          )
        : Math.hypot(...own.map((held, place) => Math.sqrt(units[place]) * (held[one] - held[other])));
    const away = (place, row) => Math.hypot(placed[2 * place] - xy[2 * row], placed[2 * place + 1] - xy[2 * row + 1]);
    const smallest = (found) => found.indexOf(Math.min(...found));
    const beside = Array.from(others, (other) =>
      smallest(Array.from(shapes, (shape) => Math.fround(distance(other, shape)))),
    );
    for (const place of others.keys())
      assert.equal(smallest(Array.from(shapes.keys(), (row) => away(place, row))), beside[place]);
    for (const [row, shape] of shapes.entries()) {
      const around = [...beside.keys()].filter((place) => beside[place] === row);
      const byPlace = around.toSorted((a, b) => away(a, row) - away(b, row));
      const byLikeness = around.toSorted((a, b) => distance(others[a], shape) - distance(others[b], shape));
      assert.deepEqual(byPlace, byLikeness);
    }
  });

test("none hides another, also where shapes of the map do", () => {
  const xy = Float32Array.of(0.1, 0.1, 0.1, 0.1, -0.5, 0.2);
  const beside = Int32Array.from({ length: 90 }, (_, other) => other % 3);
  const placed = spread(xy, beside, new Float64Array(90));
  const places = new Set(Array.from(beside, (row, other) => `${row}: ${placed[2 * other]} ${placed[2 * other + 1]}`));
  assert.equal(places.size, 90);
  assert.ok(placed.every(Number.isFinite));
});
