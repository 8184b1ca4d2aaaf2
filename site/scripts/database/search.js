// What a search looks through, and what it finds.

import { chunk } from "../base/chunks.js";
import { entry } from "../base/entry.js";

/** @import { Database } from "./database.js" */

/**
 * Texts to be searched, one a line, and where each line starts; the last start is where a further one would.
 * @typedef {{ text: string, starts: Int32Array }} Searchable
 */

/** @type {WeakMap<Database, Searchable[]>} */
const atHand = new WeakMap();

/** @type {WeakMap<Database, Promise<Searchable[]>>} */
const known = new WeakMap();

/**
 * What of the shapes is searched without waiting: their names; their ids and classes.
 * @param {Database} database
 */
export function textsAtHand(database) {
  const { count, ids, names, groups, classes } = database;
  return entry(atHand, database, () => [
    searchable(count, (index) => names[index]),
    searchable(count, (index) => `${ids[index]} ${classes[groups[index]] ?? ""}`),
  ]);
}

/**
 * That, and their labels and metadata.
 * @param {Database} database
 */
export function searchTexts(database) {
  return entry(known, database, async () => {
    const more = await chunk("texts");
    return [...textsAtHand(database), searchable(database.count, (index) => more[index] ?? "")];
  });
}

/** Lines that are made at a time: all at once they would take as much memory again. */
const AT_ONCE = 1000;

/**
 * Texts in one: going through it is far quicker than from text to text.
 * @param {number} count
 * @param {(index: number) => string} textOf
 * @returns {Searchable}
 */
export function searchable(count, textOf) {
  const pieces = [];
  for (let start = 0; start < count; start += AT_ONCE) {
    const lines = [];
    for (let index = start; index < Math.min(start + AT_ONCE, count); index += 1)
      lines.push(textOf(index).replaceAll("\n", " "));
    pieces.push(plain(lines.join("\n")));
  }
  const text = pieces.join("\n");
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
 * The numbers of the lines that hold all words of a query in one text or another, parts of words included.
 * @param {Searchable[]} searched texts of as many lines
 * @param {string} query
 */
export function findWords(searched, query) {
  const words = plain(query).split(/\s+/);
  const count = searched[0].starts.length - 1;
  const held = new Uint16Array(count);
  for (const [place, word] of words.entries())
    for (const { text, starts } of searched) {
      let line = 0;
      for (let at = text.indexOf(word); at >= 0 && line < count; at = text.indexOf(word, starts[line])) {
        line = lineAt(starts, at, line);
        if (held[line] === place) held[line] += 1;
        line += 1;
      }
    }
  /** @type {number[]} */
  const found = [];
  for (let line = 0; line < count; line += 1) if (held[line] === words.length) found.push(line);
  return found;
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
