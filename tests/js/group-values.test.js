// What is told of groups by counts says the same as their shapes one by one.

import assert from "node:assert/strict";
import { test } from "node:test";
import { CountedValues } from "../../site/scripts/database/level-counts.js";
import { RowValues, shareAbove, shareAhead } from "../../site/scripts/database/group-values.js";
import { LevelBins } from "../../site/scripts/database/level-bins.js";
import { sampledByParts } from "../../site/scripts/database/sample.js";
import { apartBy, contrast, pooled } from "../../site/scripts/engine/contrast.js";
import { Random } from "../../site/scripts/engine/random.js";

const STEPS = 255;
const [SHAPES, FIRST, SECOND] = [900, 300, 250];
const random = new Random(7);
const normal = () => random.normal();

// A feature of two histograms with five bins each, and one of a single value.
const features = [
  { name: "Hist", title: "Hist", dimensions: 2, bins: 5, start: 0, ease: 2, rooted: false },
  { name: "Size", title: "Size", dimensions: 1, bins: 1, start: 10, ease: 1, rooted: false },
];
const COLUMNS = 11;
const WEIGHTS = [2.5, 0.4];

/** Shares of the surface by bin, and a size; those of the first group have more of the first bins. */
const values = Array.from({ length: SHAPES }, (_, shape) => {
  const lean = shape < FIRST ? 1 : shape < FIRST + SECOND ? 0.3 : 0;
  const histograms = [0, 1].flatMap((dimension) => {
    const raw = Array.from({ length: 5 }, (_, bin) => Math.exp(normal() - lean * bin * (dimension + 1) * 0.3));
    const sum = raw.reduce((total, value) => total + value, 0);
    return raw.map((value) => value / sum);
  });
  return [...histograms, 40 + 6 * lean + 8 * normal()];
});
const compared = values.map((row) => row.map((value, column) => (column < 10 ? Math.sqrt(value) : value)));
const columns = Array.from({ length: COLUMNS }, (_, column) => compared.map((row) => row[column]));
const low = Float32Array.from(columns, (own) => Math.min(...own));
const high = Float32Array.from(columns, (own) => Math.max(...own));
const levels = columns.map((own, column) =>
  own.map((value) => Math.round(((value - low[column]) / (high[column] - low[column])) * STEPS)),
);

class Known extends LevelBins {
  reader(shapes) {
    return (column) => shapes.map((shape) => levels[column][shape]);
  }
}
const bins = new Known(
  { features, called: [], sentences: [], marks: {}, scaling: "balanced", sample: null },
  { low, high, order: new Int32Array(SHAPES), levelsACell: 4, rowsAPart: 25 },
);

const numbers = (from, count) => Array.from({ length: count }, (_, place) => from + place);
const groups = {
  a: numbers(0, FIRST),
  b: numbers(FIRST, SECOND),
  rest: numbers(FIRST + SECOND, SHAPES - FIRST - SECOND),
};
const rows = (shapes) => new RowValues(bins, shapes);
const counts = (shapes) => CountedValues.of(rows(shapes), bins);
const near = (one, other, most, what) =>
  assert.ok(Math.abs(one - other) <= most, `${what}: ${one} and ${other}, not within ${most}`);

/** By the values themselves, before they were brought to levels. */
const exact = (shapes, told) => {
  const own = shapes.map(told);
  const mean = own.reduce((sum, value) => sum + value, 0) / own.length;
  return { mean, variance: own.reduce((sum, value) => sum + (value - mean) ** 2, 0) / own.length };
};

test("means and spreads by counts are those of the values, to a level", () => {
  for (const shapes of Object.values(groups)) {
    const counted = counts(shapes);
    for (let column = 0; column < COLUMNS; column += 1) {
      const range = Math.max(...values.map((row) => row[column]));
      near(counted.mean(column), exact(shapes, (shape) => values[shape][column]).mean, range / 1000, "mean");
      if (column === 10) continue;
      const start = column - (column % 5);
      const upTo = exact(shapes, (shape) =>
        values[shape].slice(start, column + 1).reduce((sum, value) => sum + value, 0),
      );
      near(counted.upTo(column).mean, upTo.mean, 0.002, "mean of the shares up to a bin");
      near(Math.sqrt(counted.upTo(column).variance), Math.sqrt(upTo.variance), 0.004, "their spread");
    }
  }
});

test("counts of two groups together, and of all without some, are those of their shapes", () => {
  const all = counts(numbers(0, SHAPES));
  const both = counts([...groups.a, ...groups.b]);
  for (const made of [counts(groups.a).with(counts(groups.b)), all.without(counts(groups.rest))]) {
    assert.equal(made.count, both.count);
    assert.deepEqual([...made.counted.cells], [...both.counted.cells]);
    for (const name of ["means", "variances", "upTo"])
      for (let column = 0; column < COLUMNS; column += 1)
        near(made.counted[name][column], both.counted[name][column], 1e-8 * STEPS ** 2, name);
  }
});

test("pairs, and shapes above a value, are counted alike by counts and one by one", () => {
  for (let column = 0; column < COLUMNS; column += 1) {
    const [a, b] = [rows(groups.a).points(column), rows(groups.b).points(column)];
    const [counted, others] = [counts(groups.a).points(column), counts(groups.b).points(column)];
    let pairs = 0;
    for (const { value } of a) for (const { value: other } of b) pairs += value > other ? 1 : value === other ? 0.5 : 0;
    near(shareAhead(a, b), pairs / (FIRST * SECOND), 1e-12, "pairs");
    near(shareAhead(counted, others), shareAhead(a, b), 0.005, "pairs by counts");
    const middle = counts(groups.rest).mean(column);
    near(shareAbove(counted, middle), shareAbove(a, middle), 0.03, "above a mean");
  }
});

/** What the engine answers. */
function answers(contests, of = numbers(0, SHAPES)) {
  const table = new Float32Array(COLUMNS * of.length);
  for (let column = 0; column < COLUMNS; column += 1)
    for (const [place, shape] of of.entries()) table[column * of.length + place] = compared[shape][column];
  const blocks = Int32Array.from({ length: COLUMNS }, (_, column) => (column < 10 ? 0 : 1));
  const steps = contrast(null, { rows: of.length, values: table, blocks, weights: WEIGHTS, contests, seed: 0 });
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}
const GIVEN = { blocks: Int32Array.from({ length: COLUMNS }, (_, column) => (column < 10 ? 0 : 1)), weights: WEIGHTS };

test("groups are as far apart by counts as by their rows, to what levels hold", () => {
  const whole = apartBy(counts(groups.a).moments(), counts(groups.b).moments(), GIVEN);
  const [found] = answers([{ first: groups.a, second: groups.b, shuffles: 0 }]);
  for (let column = 0; column < COLUMNS; column += 1)
    near(whole.effect[column], found.effect[column], 0.002, `effect of ${column}`);
  assert.deepEqual(whole.sizes, [FIRST, SECOND]);
  for (const [place, { share }] of [...found.features, found.all].entries())
    near(whole.shares[place], share, 0.001, "share of a feature");
});

test("by the same values, moments tell what rows do to single precision", () => {
  const [a, b, rest] = Object.values(groups).map((shapes) => {
    const own = numbers(0, COLUMNS).map((column) => exact(shapes, (shape) => compared[shape][column]));
    return {
      count: shapes.length,
      means: Float64Array.from(own, ({ mean }) => mean),
      variances: Float64Array.from(own, ({ variance }) => variance),
    };
  });
  for (const [whole, first, second] of [
    [apartBy(a, b, GIVEN), groups.a, groups.b],
    [apartBy(b, a, GIVEN), groups.b, groups.a],
    [apartBy(pooled(a, b), rest, GIVEN), [...groups.a, ...groups.b], groups.rest],
  ]) {
    const [found] = answers([{ first, second, shuffles: 0 }]);
    for (let column = 0; column < COLUMNS; column += 1)
      near(whole.effect[column], found.effect[column], 1e-5, "effect");
    for (const [place, { share }] of [...found.features, found.all].entries())
      near(whole.shares[place], share, 1e-5, "share");
  }
});

test("a bin that all shapes share sets no groups apart", () => {
  const same = { count: 5, means: Float64Array.of(0.1), variances: Float64Array.of(0) };
  const whole = apartBy(same, { ...same, count: 9 }, { blocks: Int32Array.of(0), weights: [1] });
  assert.deepEqual([...whole.effect, ...whole.shares], [0, 0, 0]);
});

test("what chance does to all shapes is known by a part of them", () => {
  const [a, b] = [numbers(0, 450), numbers(450, 450)];
  const whole = apartBy(counts(a).moments(), counts(b).moments(), GIVEN);
  const part = [a, b].map((own) => own.filter((shape) => shape % 5 === 0));
  const [byAll, byPart] = answers([
    { first: a, second: b, shuffles: 499 },
    { first: part[0], second: part[1], shuffles: 499, whole },
  ]);
  // Of deals, a column's mean share is 1 / (n - 1).
  near(byPart.all.chance, 1 / 899, 0.0002, "chance");
  assert.ok(byPart.limit / byAll.limit > 0.7 && byPart.limit / byAll.limit < 1.4);
  assert.ok(byPart.all.limit / byAll.all.limit > 0.6 && byPart.all.limit / byAll.all.limit < 1.6);
  assert.equal(byPart.all.share, whole.shares.at(-1));
});

test("a sample by parts takes every shape as often as any other, and few parts", () => {
  const [aPart, count] = [25, 5000];
  const order = numbers(0, count);
  for (let place = count - 1; place > 0; place -= 1) {
    const other = random.below(place + 1);
    [order[place], order[other]] = [order[other], order[place]];
  }
  const places = new Int32Array(count);
  for (const [place, shape] of order.entries()) places[shape] = place;
  const partsOf = (shapes) => new Set(shapes.map((shape) => Math.floor(places[shape] / aPart))).size;
  const all = numbers(0, count);
  const dense = sampledByParts(all, places, aPart, 500);
  assert.equal(dense.length, 500);
  assert.equal(partsOf(dense), 20);
  assert.deepEqual(
    dense,
    [...dense].sort((a, b) => a - b),
  );
  // Every sixth shape: some four a part.
  const scattered = all.filter((shape) => shape % 6 === 0);
  const sparse = sampledByParts(scattered, places, aPart, 500);
  assert.ok(partsOf(sparse) <= 100 && sparse.length > 350 && sparse.length < 550);
  assert.ok(sparse.every((shape) => shape % 6 === 0));
  // A part that is taken is taken whole.
  const taken = new Set(sparse.map((shape) => Math.floor(places[shape] / aPart)));
  assert.equal(sparse.length, scattered.filter((shape) => taken.has(Math.floor(places[shape] / aPart))).length);
  const few = numbers(10, 60);
  assert.equal(sampledByParts(few, places, aPart, 60), few);
});

test("in a sample that speaks for many classes each of them is there in proportion", () => {
  // The parts follow class by class: 50 classes of 100 shapes, 25 a part.
  const places = Int32Array.from(numbers(0, 5000));
  const sample = sampledByParts(numbers(0, 5000), places, 25, 200, 100);
  const classes = new Map();
  for (const shape of sample) {
    const own = Math.floor(shape / 100);
    classes.set(own, (classes.get(own) ?? 0) + 1);
  }
  assert.equal(classes.size, 50);
  assert.ok([...classes.values()].every((count) => count >= 3 && count <= 6));
});
