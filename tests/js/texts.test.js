// Texts of very many shapes, which chunks hold in one.

import assert from "node:assert/strict";
import { test } from "node:test";
import { linesOf } from "../../site/scripts/database/texts.js";
import { textsOf } from "./texts.js";

const WHOLE = ["cups/1", "", "M\u00fcnze", "\ud83d\ude00", "\ufeff\ufffd bad", "cups/10", "\u6771\u4eac"];
const BROKEN = ["a\nb", "", "c", "\n"];

test("each is as it was", () => {
  for (const texts of [WHOLE, BROKEN, [], [""]]) {
    const held = textsOf(...texts);
    assert.deepEqual([...held], texts);
    assert.deepEqual(
      [...held.keys()].map((index) => held.at(index)),
      texts,
    );
    assert.equal(held.length, texts.length);
  }
});

test("one is found by all of it", () => {
  for (const texts of [WHOLE, BROKEN]) {
    const held = textsOf(...texts);
    for (const wanted of [...texts, "cups", "ups/1", "cups/100", "b", "1\n"])
      assert.equal(held.indexOf(wanted), texts.indexOf(wanted), JSON.stringify(wanted));
  }
  assert.equal(textsOf().indexOf(""), -1);
});

test("in lines, each is one", () => {
  for (const texts of [WHOLE, BROKEN, [], [""]]) assert.equal(textsOf(...texts).lines(), linesOf(texts));
  assert.equal(textsOf(...BROKEN).lines(), "a b\n\nc\n ");
});
