// What letters of chunks stand for.

import assert from "node:assert/strict";
import { test } from "node:test";

import { bytesOf } from "../../site/scripts/base/chunks.js";

test("a letter has fifteen bits, the first ones first", () => {
  assert.deepEqual(bytesOf("\u0180\u40c0", 3), new Uint8Array([1, 0, 255]));
  assert.deepEqual(bytesOf("", 0), new Uint8Array());
});

test("eight letters are fifteen bytes, and no bit of one is lost in the next", () => {
  assert.deepEqual(bytesOf("\u80ff".repeat(8), 15), new Uint8Array(15).fill(255));
  assert.deepEqual(bytesOf("\u0101\u4100", 3), new Uint8Array([0, 3, 0]));
});
