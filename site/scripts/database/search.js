// What a search looks through, and what it finds.

import { chunk } from "../base/chunks.js";
import { entry } from "../base/entry.js";
import { linesOf, textsOf } from "./texts.js";

/** @import { Database } from "./database.js" */

/**
 * Texts to be searched, one a line, and where each line starts; the last start is where a further one would. Each is of one
 * shape, or `of` says which of them a shape has, -1 where it has none.
 * @typedef {{ text: string, starts: Int32Array, of?: Int32Array }} Searchable
 */

/** @type {WeakMap<Database, Searchable[]>} */
const atHand = new WeakMap();

/** @type {WeakMap<Database, Promise<Searchable[]>>} */
const known = new WeakMap();

/**
 * What of the shapes is searched without waiting: their names, their ids, and their classes.
 * @param {Database} database
 */
export function textsAtHand(database) {
  const { count, ids, names, groups, classes } = database;
  return entry(atHand, database, () => [
    searchable(names.lines(), count),
    searchable(ids.lines(), count),
    { ...searchable(linesOf(classes), classes.length), of: groups },
  ]);
}

/**
 * That, and their labels and metadata.
 * @param {Database} database
 */
export function searchTexts(database) {
  return entry(known, database, async () => {
    const more = textsOf(await chunk("texts"));
    return [...textsAtHand(database), searchable(more.lines(), database.count)];
  });
}

/**
 * Texts in one: going through it is far quicker than from text to text.
 * @param {string} lines
 * @param {number} count of them
 * @returns {Searchable}
 */
export function searchable(lines, count) {
  const text = plain(lines);
  const starts = new Int32Array(count + 1);
  for (let line = 1; line < count; line += 1) starts[line] = text.indexOf("\n", starts[line - 1]) + 1;
  starts[count] = text.length + 1;
  return { text, starts };
}

/**
 * A line of what is searched.
 * @param {Searchable} searched
 * @param {number} line
 */
export function lineOf({ text, starts }, line) {
  return text.slice(starts[line], starts[line + 1] - 1);
}

/**
 * The numbers of the shapes that have all words of a query in one text or another, parts of words included.
 * @param {Searchable[]} searched the first of which has a line a shape
 * @param {string} query
 */
export function findWords(searched, query) {
  const words = plain(query).split(/\s+/);
  const count = searched[0].starts.length - 1;
  const held = new Uint16Array(count);
  for (const [place, word] of words.entries())
    for (const one of searched) {
      const lines = linesWith(one, word);
      for (let index = 0; index < count; index += 1)
        if (held[index] === place && lines[one.of ? one.of[index] : index]) held[index] += 1;
    }
  /** @type {number[]} */
  const found = [];
  for (let index = 0; index < count; index += 1) if (held[index] === words.length) found.push(index);
  return found;
}

/**
 * 1 for every line that holds a word.
 * @param {Searchable} searched
 * @param {string} word
 */
function linesWith({ text, starts }, word) {
  const lines = new Uint8Array(starts.length - 1);
  let line = 0;
  for (let at = text.indexOf(word); at >= 0 && line < lines.length; at = text.indexOf(word, starts[line])) {
    line = lineAt(starts, at, line);
    lines[line] = 1;
    line += 1;
  }
  return lines;
}

/**
 * The line that a place in the text lies in.
 * @param {Int32Array} starts
 * @param {number} place
 * @param {number} first which it does not lie before
 */
function lineAt(starts, place, first) {
  let [low, step] = [first, 1];
  while (low + step < starts.length && starts[low + step] <= place) {
    low += step;
    step *= 2;
  }
  let high = Math.min(low + step, starts.length - 1);
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (starts[middle] <= place) low = middle;
    else high = middle;
  }
  return low;
}

/**
 * Whether a text holds all words of a query, of few texts that a list has: what a search finds in one, it finds in the other.
 * @param {string} query
 * @returns {(text: string) => boolean}
 */
export function holding(query) {
  const words = plain(query).split(/\s+/);
  return (text) => {
    const own = plain(text);
    return words.every((word) => own.includes(word));
  };
}

/**
 * Small letters without accents: who types "munze" means "Münze".
 * @param {string} text
 */
export function plain(text) {
  return text
    .toLowerCase()
    .normalize("NFD")
    .replace(/[\u0300-\u036f]/g, "");
}
