// Bins are found by what one sees.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Bins } from "../../site/scripts/database/bins.js";

/**
 * A feature of a single dimension, in three bins.
 * @param {string} name
 * @param {number} start
 * @param {object} words
 */
const feature = (name, start, words) => ({ name, start, dimensions: 1, bins: 3, hue: 0, low: 0, high: 1, ...words });

const features = [
  feature("PFH", 0, {
    title: "Point feature histogram",
    aspect: "fine bends",
    measures: "How the surface curves.",
    lowMeans: "patches with few such pairs",
    highMeans: "patches with many such pairs",
    sought: [["", "even smooth"]],
    ease: 1,
  }),
  feature("Gc", 3, {
    title: "Gaussian curvature",
    aspect: "curvature",
    measures: "Where the surface bulges.",
    lowMeans: "saddles, as where a limb leaves the body",
    highMeans: "bumps and tips",
    sought: [["hollow", "round tip"]],
    ease: 2,
  }),
  feature("Nd", 6, {
    title: "Normal diameter",
    aspect: "thickness",
    measures: "How thick the shape is.",
    lowMeans: "thin sheets and limbs",
    highMeans: "full bodies",
    sought: [["flat slim", "thick fat"]],
    ease: 2,
  }),
  {
    name: "Sfl",
    start: 9,
    dimensions: 2,
    bins: 1,
    hue: 0,
    low: 0,
    high: 1,
    title: "Surflet pairs",
    aspect: "lie of the parts",
    measures: "How places lie.",
    lowMeans: "",
    highMeans: "",
    sought: [
      ["corner", "corner"],
      ["plane", "plane"],
    ],
    rooted: true,
    ease: 1,
  },
];
const called = [
  ["patch flat: under 1 %", "patch flat: 1 to 50 %", "patch flat: over 50 %"],
  ["saddle over 4°", "flat, −4 to 4°", "bump over 4°"],
  ["thickness under 0.3", "thickness 0.3 to 0.6", "thickness over 0.6"],
  ["pairs near, square", "pairs near, parallel"],
].flat();
const sentences = called.map((_, column) => `What share of the surface lies where quantity ${column} is measured.`);
const bins = new Bins(
  /** @type {any} */ ({ features, called, sentences, marks: {}, scaling: "balanced", sample: null }),
  new Uint16Array([...Array(9).fill(0), 0x8000, 0]).buffer,
);
/** @param {string} text */
const named = (text) => bins.find(text).map((column) => bins.names[column]);

test("plain words find bins, at the end of the scale that they are for first", () => {
  assert.deepEqual(named("thick"), ["Nd:3", "Nd:1", "Nd:2"]);
  assert.equal(named("fat")[0], "Nd:3");
  assert.deepEqual(named("thin"), ["Nd:1"]);
  assert.equal(named("saddles")[0], "Gc:1");
  assert.equal(named("bumpy")[0], "Gc:3");
  assert.equal(named("round")[0], "Gc:3");
});

test("what is easily pictured comes before what is not", () => {
  const flat = named("flat");
  assert.ok(flat.indexOf("Gc:2") < flat.indexOf("PFH:1"));
  assert.ok(flat.includes("PFH:3"));
});

test("several words narrow what is found, and titles and definitions are searched too", () => {
  assert.deepEqual(named("flat patch 50"), ["PFH:3", "PFH:2"]);
  assert.deepEqual(named("thickness over"), ["Nd:3"]);
  assert.deepEqual(new Set(named("gaussian")), new Set(["Gc:1", "Gc:2", "Gc:3"]));
  assert.deepEqual(named("quantity 7"), ["Nd:2"]);
  assert.deepEqual(named("no such thing"), []);
});

test("names are found as names, one or several", () => {
  assert.deepEqual(named("Gc:2"), ["Gc:2"]);
  assert.deepEqual(named("nd"), ["Nd:1", "Nd:2", "Nd:3"]);
  assert.deepEqual(named("h:3"), ["PFH:3"]);
  assert.deepEqual(named("Gc:1, Nd:2"), ["Gc:1", "Nd:2"]);
});

test("values of whole shapes are found whatever their size", () => {
  assert.deepEqual(named("corner"), ["Sfl[0]"]);
  assert.deepEqual(named("plane"), ["Sfl[1]"]);
});

test("who finds nothing is told the words that find something", () => {
  assert.deepEqual(named("gearbox"), []);
  const hint = bins.searchHint;
  const words = hint.slice(hint.indexOf(":") + 1, hint.indexOf(";")).split(", ");
  assert.ok(words.length > 10);
  for (const word of words) assert.ok(named(word.trim()).length > 0, word);
});

test("roots of shares are told as shares, which no other value of a whole shape is", () => {
  assert.equal(bins.telling(9)(bins.share(9, 0)), "25\u00a0%");
  assert.deepEqual(bins.tell(9, [0.031, 0.012]), ["3.1\u00a0%", "1.2\u00a0%"]);
  assert.equal(bins.isShare(9), false);
});
