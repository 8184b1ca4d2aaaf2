// A search finds the texts that hold all its words.

import assert from "node:assert/strict";
import { test } from "node:test";
import { findWords, holding, lineOf, plain, searchable } from "../../site/scripts/database/search.js";
import { linesOf } from "../../site/scripts/database/texts.js";

/** The slow way. */
function expected(texts, query) {
  const words = plain(query).split(/\s+/);
  return [...texts.keys()].filter((index) =>
    words.every((word) => plain(texts[index].replaceAll("\n", " ")).includes(word)),
  );
}

/** Texts as they are searched. */
const among = (...all) => all.map((texts) => searchable(linesOf(texts), texts.length));

const TEXTS = [
  "cups/1 Münze aus Gold",
  "",
  "a\nb",
  "İstanbul ΣΊΣΥΦΟΣ",
  "gold gold gold",
  "ends with a",
  "Gold\u00a0leaf and münzen",
  "",
  "東京 vase",
];

test("words are found in any order and form, and only where all of them are", () => {
  for (const query of [
    "gold",
    "munze",
    "MÜNZE gold",
    "gold gold",
    "a",
    "a b",
    "vase 東",
    "nowhere",
    "old l",
    "σισυφος",
    "",
  ])
    assert.deepEqual(findWords(among(TEXTS), query), expected(TEXTS, query), query);
});

test("nothing is found among nothing", () => {
  assert.deepEqual(findWords(among([]), "a"), []);
  assert.deepEqual(findWords(among([""]), "a"), []);
  assert.deepEqual(findWords(among([""]), ""), [0]);
});

test("a word does not reach from one text into the next", () => {
  assert.deepEqual(findWords(among(["go", "ld"]), "gold"), []);
});

test("words may stand in texts beside each other", () => {
  const [names, classes] = [
    ["gold leaf", "old vase", "gold"],
    ["coin", "gold", "coin coin"],
  ];
  assert.deepEqual(findWords(among(names, classes), "gold coin"), [0, 2]);
  assert.deepEqual(findWords(among(names, classes), "old"), [0, 1, 2]);
  assert.deepEqual(findWords(among(names, classes), "leaf vase"), []);
});

test("what many shapes share is searched once for all of them", () => {
  const [names] = among(["cup", "vase", "cup of gold"]);
  const classes = { ...among(["gold", "clay"])[0], of: Int32Array.of(1, 0, -1) };
  assert.deepEqual(findWords([names, classes], "gold"), [1, 2]);
  assert.deepEqual(findWords([names, classes], "cup clay"), [0]);
  assert.deepEqual(findWords([names, classes], ""), [0, 1, 2]);
});

test("lines are the texts", () => {
  const searched = searchable(linesOf(TEXTS), TEXTS.length);
  assert.deepEqual(
    TEXTS.map((_, line) => lineOf(searched, line)),
    TEXTS.map((text) => plain(text.replaceAll("\n", " "))),
  );
});

test("many texts are searched as few are", () => {
  const texts = Array.from({ length: 5000 }, (_, number) => `shape ${number} of ${number % 7} kinds`);
  for (const query of ["shape", "99", "4999", "of 3", "7 kinds 12"])
    assert.deepEqual(findWords(among(texts), query), expected(texts, query), query);
});

test("a list finds among its texts what a search finds in them", () => {
  for (const query of ["munze", "MÜNZE gold", "  gold ", "old l", "nowhere", ""])
    assert.deepEqual(
      [...TEXTS.keys()].filter((index) => holding(query)(TEXTS[index])),
      findWords(among(TEXTS), query),
    );
});
