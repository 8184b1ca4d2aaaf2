// What letters of chunks stand for.

import assert from "node:assert/strict";
import { test } from "node:test";

import { bytesOf } from "../../site/scripts/base/chunks.js";

/** Of sixteen letters, those that are given; the others stand for nothing. */
const group = (letters) => Array.from({ length: 16 }, (_, place) => letters[place] ?? "\u0100").join("");

test("a letter has fifteen bits of a number of two bytes, its lower byte first", () => {
  assert.deepEqual(bytesOf(group({ 0: "\u0101", 1: "\u1334" }), 4), new Uint8Array([1, 0, 0x34, 0x12]));
  assert.deepEqual(bytesOf("", 0), new Uint8Array());
});

test("the last letter of sixteen has the highest bits", () => {
  const found = bytesOf(group({ 15: "\u4101" }), 30);
  assert.deepEqual(
    [...found.entries()].filter(([, byte]) => byte > 0),
    [
      [1, 128],
      [29, 128],
    ],
  );
  assert.deepEqual(bytesOf("\u80ff".repeat(32), 60), new Uint8Array(60).fill(255));
});

test("what is decoded piece by piece goes where it is told to", () => {
  const into = new Uint8Array(60).fill(7);
  assert.deepEqual(bytesOf(group({ 0: "\u0105" }), 3, into), new Uint8Array([5, 0, 0]));
  assert.deepEqual(into.slice(30), new Uint8Array(30).fill(7));
});
