// Bins and features as words of an address.

import assert from "node:assert/strict";
import { test } from "node:test";
import { readShortNames, shortNames } from "../../site/scripts/addresses/bin-names.js";
import { joinNames, splitNames } from "../../site/scripts/addresses/names.js";

const FEATURES = [
  { name: "Gc", start: 0, dimensions: 1, bins: 10 },
  { name: "FPFH", start: 10, dimensions: 33, bins: 10 },
  { name: "50 % of it", start: 340, dimensions: 4, bins: 1 },
];
const COLUMNS = 344;

test("names of features survive an address, whatever is in them", () => {
  const names = FEATURES.map(({ name }) => name);
  for (const chosen of [[], ["Gc"], ["50 % of it"], names]) {
    const query = new URLSearchParams({ features: joinNames(chosen) }).toString();
    assert.deepEqual(splitNames(new URLSearchParams(query).get("features"), names), chosen);
  }
});

test("bins are named by the shortest words", () => {
  assert.equal(shortNames([0, 1, 2, 3, 4, 5, 6, 7, 8, 9], FEATURES), "Gc");
  assert.equal(shortNames([2, 0, 1, 5], FEATURES), "Gc:1-3 Gc:6");
  assert.equal(shortNames([150, 151, 152, 153, 154, 155, 156, 157, 158, 159, 161], FEATURES), "FPFH[14] FPFH[15]:2");
});

test("any choice of bins survives an address", () => {
  let state = 1;
  const random = () => {
    state = (Math.imul(state, 48271) >>> 0) % 0x7fffffff;
    return state / 0x7fffffff;
  };
  for (const share of [0, 0.01, 0.2, 0.6, 1]) {
    const chosen = Array.from({ length: COLUMNS }, (_, column) => column).filter(() => random() < share);
    assert.deepEqual(
      [...readShortNames(shortNames(chosen, FEATURES), FEATURES)].sort((a, b) => a - b),
      chosen,
    );
  }
});

test("words that name no bin are passed over", () => {
  for (const text of [null, "", "Gc:0", "Gc:11", "Gc:3-2", "FPFH[33]", "FPFH:3", "Xy", "Gc:1;"]) {
    assert.equal(readShortNames(text, FEATURES).size, 0, String(text));
  }
});
