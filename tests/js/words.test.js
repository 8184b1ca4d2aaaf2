// Numbers as a reader reads them, and what a comparison tells first.

import assert from "node:assert/strict";
import { test } from "node:test";
import { changeWords, difference } from "../../site/scripts/base/figures.js";
import { count, grouped, isolated, measured, percent, percents } from "../../site/scripts/base/words.js";
import { waysToDeal } from "../../site/scripts/compare/answer.js";
import { asSure, Contrast, ENOUGH, worth } from "../../site/scripts/compare/contrasts.js";
import { pairs } from "../../site/scripts/compare/words.js";
import { RowValues } from "../../site/scripts/database/group-values.js";

test("shares that differ read differently, with no more digits than that takes", () => {
  assert.deepEqual(percents(0.28, 0.019), ["28\u00a0%", "1.9\u00a0%"]);
  assert.deepEqual(percents(0.281, 0.279), ["28.1\u00a0%", "27.9\u00a0%"]);
  assert.deepEqual(percents(0.0001, 0.0003), ["0.01\u00a0%", "0.03\u00a0%"]);
  assert.deepEqual(percents(0, 0.0004), ["0\u00a0%", "<0.1\u00a0%"]);
  assert.equal(new Set(percents(1, 0.9996)).size, 2);
  assert.deepEqual(
    [1 - (0.1 + 0.2 + 0.70000000001), -0, 1e-12].map((share) => percent(share)),
    Array(3).fill("0\u00a0%"),
  );
  assert.deepEqual(percents(0.5, 0.5), ["50\u00a0%", "50\u00a0%"]);
  // Of three, the first two are told apart from the last one only.
  assert.deepEqual(percents(0.134, 0.134, 0.08), ["13\u00a0%", "13\u00a0%", "8.0\u00a0%"]);
  assert.deepEqual(percents(0.5, 0.5 + 1e-9), ["50\u00a0%", "50\u00a0%"]);
  for (const share of [0, 1e-6, 0.001, 0.0995, 0.5, 1])
    assert.ok(Number.parseFloat(percent(share).replace("<", "")) <= 100);
});

test("thousands are set apart, whatever stands behind the point", () => {
  assert.deepEqual([0, 999, 1000, 1870, 1234567].map(grouped), [
    "0",
    "999",
    "1\u202f000",
    "1\u202f870",
    "1\u202f234\u202f567",
  ]);
  assert.equal(grouped(12345.6789), "12\u202f345.6789");
  assert.equal(grouped(-1250), "-1\u202f250");
  assert.equal(count(1250, "value"), "1\u202f250 values");
  assert.equal(measured(-1254.3), "−1\u202f250");
});

test("what can be pictured goes first unless something else says much more", () => {
  assert.ok(worth(1.6, 2) > worth(ENOUGH, 1));
  assert.ok(worth(1.6, 2) > worth(50, 1));
  assert.ok(worth(1.2, 2) < worth(-2.9, 1));
  assert.equal(worth(4, 2), worth(40, 2));
});

test("a share of pairs of places that hardly differs is told after what one sees, however sure it is", () => {
  // Two shapes a group: of column 0 shares of 0.1 % and nothing, of column 1 of the surface 60 % and 40 %.
  const shares = [
    [0.001, 0.001, 0, 0],
    [0.62, 0.58, 0.42, 0.38],
    [5.1, 5, 2, 2.1],
  ];
  const bins = /** @type {any} */ ({
    /** @type {(rows: number[]) => (column: number) => number[]} */
    reader: (rows) => (column) => rows.map((row) => shares[column][row]),
    /** @type {(column: number, step: number) => number} */
    shareAt: (_column, step) => step,
    /** @type {(column: number) => boolean} */
    inPercent: (column) => column < 2,
    ease: () => 1,
  });
  const sample = { a: [0, 1], b: [2, 3], rest: [] };
  const [a, b, rest] = [sample.a, sample.b, sample.rest].map((rows) => new RowValues(bins, rows));
  const apart = { effect: Float64Array.of(1, 0.9, 0.99), limit: 0.1, away: new Float64Array(4) };
  const contrast = new Contrast(
    bins,
    { a, b, rest },
    sample,
    /** @type {any} */ ({ apart, against: null, sizes: { a: 2, b: 2, rest: 0 } }),
  );
  assert.deepEqual(contrast.told.at(-1), 0);
  assert.ok(Math.abs(contrast.gap(0) - 0.001) < 1e-12);
  // Any other value has no scale on which one could say that it is nothing.
  assert.equal(contrast.gap(2), 1);
});

test("only what holds of all pairs is said of all", () => {
  assert.deepEqual([1, 399 / 400, 0.995, 0.99, 0.5].map(pairs), [
    "in all pairs",
    "in nearly all pairs",
    "in nearly all pairs",
    "in 99 of 100 pairs",
    "in 50 of 100 pairs",
  ]);
});

test("the ways to deal shapes out are those into different pairs of groups", () => {
  assert.deepEqual(
    [
      [1, 12],
      [12, 2],
      [3, 3],
      [4, 4],
    ].map(([first, second]) => waysToDeal(first, second)),
    [13, 91, 10, 35],
  );
  assert.ok(waysToDeal(5000, 90_000) > 100);
});

test("samples are as sure as groups of the same relation of which their chance is that of all shapes", () => {
  assert.deepEqual(asSure([30, 170], [30, 170]), [30, 170]);
  // By 500 of 1000 and 500 of 9000 the difference varies as that of 278 and 2500: 1/500 + 1/500 is 1/278 + 1/2500.
  assert.deepEqual(asSure([1000, 9000], [500, 500]), [278, 2500]);
});

test("a difference is that of the figures as they are shown", () => {
  // 0.9385 and 0.9924 differ by 0.0539, and show as 0.939 and 0.992.
  assert.equal(difference(0.93851, 0.9924), "+0.053");
  assert.equal(difference(0.9424, 0.93851), "−0.003");
  assert.equal(difference(0.50049, 0.49951), "±0.000");
  assert.equal(changeWords(0.50049, 0.50051), "up 0.001");
  assert.equal(changeWords(0.4, 0.4), "unchanged");
});

test("a name that goes on to the left is kept apart from the sentence about it", () => {
  assert.equal(isolated("כיסא 2"), "\u2068כיסא 2\u2069");
  assert.equal(isolated("\u202egnp.exe"), "\u2068\u202egnp.exe\u2069");
  assert.equal(isolated("Stühle 2"), "Stühle 2");
});
