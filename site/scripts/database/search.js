// What a search looks through, and what it finds.

import { chunk } from "../base/chunks.js";
import { entry } from "../base/entry.js";

/** @import { Database } from "./database.js" */

/** @type {WeakMap<Database, Promise<string[]>>} */
const known = new WeakMap();

/**
 * One searchable text a shape: its id, name, class, labels and metadata.
 * @param {Database} database
 */
export function searchTexts(database) {
  return entry(known, database, () => makeTexts(database));
}

/** @param {Database} database */
async function makeTexts(database) {
  const { shapes } = await chunk("details");
  return shapes.map(({ labels, metadata }, index) =>
    plain(
      [
        database.ids[index],
        database.names[index],
        database.groups[index] < 0 ? "" : database.className(database.groups[index]),
        ...labels.filter(Boolean),
        ...metadata.map(([, value]) => value),
      ].join("\n"),
    ),
  );
}

/**
 * The numbers of the texts that hold all words of a query, parts of words included.
 * @param {string[]} texts
 * @param {string} query
 */
export function findWords(texts, query) {
  const words = plain(query).split(/\s+/);
  /** @type {number[]} */
  const found = [];
  for (const [index, text] of texts.entries()) if (words.every((word) => text.includes(word))) found.push(index);
  return found;
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
