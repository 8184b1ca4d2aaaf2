// The colours of a model: those of its file, or clay.

import assert from "node:assert/strict";
import { test } from "node:test";
import { unpackModel } from "../../site/scripts/viewer/model.js";
import { Paint } from "../../site/scripts/viewer/paint.js";

const CLAY = [0.5, 0.4, 0.3];

/**
 * A packed triangle without dimensions, and what stands behind it.
 * @param {number[]} colors
 */
function packed(colors) {
  const bytes = new Uint8Array(12 + 36 + 18 + 12 + colors.length);
  const numbers = new DataView(bytes.buffer);
  for (const [place, value] of [3, 1, 0].entries()) numbers.setUint32(4 * place, value, true);
  for (const [place, value] of [1, 2].entries()) numbers.setInt32(70 + 4 * place, value, true);
  bytes.set(colors, 78);
  return bytes.buffer;
}

const paint = new Paint({ ramp: ["#000000"], clay: CLAY, marked: [1, 0, 0] });

test("a model without colours is of clay", () => {
  const shown = paint.plain(unpackModel(packed([])));
  assert.deepEqual(Array.from(shown), Array.from(Float32Array.from([...CLAY, ...CLAY, ...CLAY])));
});

test("a model with colours is of clay where they are not wanted", () => {
  const [bare, model] = [unpackModel(packed([])), unpackModel(packed([255, 0, 188, 255, 0, 0, 255, 0, 0]))];
  assert.deepEqual([bare.colored, model.colored], [false, true]);
  assert.deepEqual(paint.plain(model, { clay: true }), paint.plain(bare));
});

test("a model with colours has them, black and white within what things send back", () => {
  // red, green, then blue of the three vertices: white, black, and a red
  const model = unpackModel(packed([255, 0, 188, 255, 0, 0, 255, 0, 0]));
  assert.deepEqual([...model.faces], [0, 1, 2]);
  const shown = Array.from(paint.plain(model), (value) => Math.round(1000 * value) / 1000);
  assert.deepEqual(shown, [0.72, 0.72, 0.72, 0.03, 0.03, 0.03, 0.377, 0.03, 0.03]);
});
