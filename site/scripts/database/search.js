// What a search looks through, and what it finds.

import { chunk } from "../base/chunks.js";
import { entry } from "../base/entry.js";

/** @import { Database } from "./database.js" */

/**
 * Texts to be searched, one a line, and where each line starts; the last start is where a further one would.
 * @typedef {{ text: string, starts: Int32Array }} Searchable
 */

/** @type {WeakMap<Database, Promise<Searchable>>} */
const known = new WeakMap();

/**
 * One searchable text a shape: its id, name, class, labels and metadata.
 * @param {Database} database
 */
export function searchTexts(database) {
  return entry(known, database, async () => searchableWith(database, await chunk("texts")));
}

/**
 * The id, name and class of every shape, and what else is said of it.
 * @param {Database} database
 * @param {string[]} more
 */
export function searchableWith({ ids, names, groups, classes }, more) {
  return searchable(
    ids.map((id, index) => [id, names[index], classes[groups[index]] ?? "", more[index] ?? ""].join(" ")),
  );
}

/**
 * Texts in one: going through it is far quicker than from text to text.
 * @param {string[]} texts
 * @returns {Searchable}
 */
export function searchable(texts) {
  const text = plain(texts.map((one) => one.replaceAll("\n", " ")).join("\n"));
  const starts = new Int32Array(texts.length + 1);
  for (let line = 1; line < texts.length; line += 1) starts[line] = text.indexOf("\n", starts[line - 1]) + 1;
  starts[texts.length] = text.length + 1;
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
 * The numbers of the texts that hold all words of a query, parts of words included.
 * @param {Searchable} searched
 * @param {string} query
 */
export function findWords({ text, starts }, query) {
  const words = plain(query).split(/\s+/);
  const count = starts.length - 1;
  const held = new Uint16Array(count);
  for (const [place, word] of words.entries()) {
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
