// The selected shapes in an address. Few stand there by name, so that a link stays good when the database grows; many
// as one bit a shape, with a mark of the database that the bits belong to.

import { entry } from "../base/entry.js";
import { lookUp, SELECTION } from "../base/missing.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { Whereabouts } from "../base/place.js" */
/** @import { Theme } from "../base/theme.js" */
/** @import { Database } from "./database.js" */

/**
 * What the state of every page of shapes has.
 * @typedef {object} Shared
 * @property {Set<number>} selection shapes
 * @property {boolean} brushing whether a box or a lasso is being drawn
 * @property {Theme} theme
 * @property {Whereabouts} whereabouts
 */

const MOST_NAMED = 40;

/**
 * Whether a parameter of an address belongs to the selection.
 * @param {string} name
 */
export function isSelection(name) {
  return name === "select" || name === "selected";
}

/**
 * Add a selection to the parameters of an address.
 * @param {URLSearchParams} query
 * @param {Database} database
 * @param {Set<number>} selection
 */
export function writeSelection(query, database, selection) {
  if (selection.size === 0) return;
  // In the order of the database: the same shapes are the same address.
  if (selection.size <= MOST_NAMED)
    for (const index of [...selection].sort((a, b) => a - b)) query.append("select", database.ids.at(index));
  else query.set("selected", `${mark(database)}.${packed(database, selection)}`);
}

/**
 * The selection that an address names; shapes that are no longer there are left out.
 * @param {URLSearchParams} query
 * @param {Database} database
 * @param {Miss} [miss]
 * @returns {Set<number>}
 */
export function readSelection(query, database, miss = () => {}) {
  const [whose, bits] = (query.get("selected") ?? "").split(".");
  if (bits !== undefined) {
    if (whose === mark(database)) return new Set(unpacked(database, bits));
    miss(SELECTION, "");
  }
  const ids = query.getAll("select");
  return new Set(lookUp(ids, finder(database, ids.length), "shape", miss));
}

/**
 * What finds shapes by their ids, of which so many are looked for: only very many are worth a name for every shape.
 * @param {Database} database
 * @param {number} count
 * @returns {(id: string) => number | undefined}
 */
function finder(database, count) {
  if (count > MOST_NAMED) return (id) => database.indexOfId.get(id);
  return (id) => {
    const index = database.ids.indexOf(id);
    return index < 0 ? undefined : index;
  };
}

/**
 * The selection with one shape more, or less.
 * @param {Set<number>} selection
 * @param {number} index
 */
export function toggled(selection, index) {
  const next = new Set(selection);
  if (!next.delete(index)) next.add(index);
  return next;
}

/**
 * What becomes of a selection with some shapes that were found.
 * @typedef {"replace" | "add" | "subtract"} Join
 *
 * @param {Set<number>} before
 * @param {number[]} found
 * @param {Join} join
 */
export function combined(before, found, join) {
  if (join === "replace") return new Set(found);
  if (join === "add") return new Set([...before, ...found]);
  const gone = new Set(found);
  return new Set([...before].filter((index) => !gone.has(index)));
}

/**
 * The selection after a click on a shape with a key held down: Shift takes it in, or out again; Alt takes it out.
 * @param {Set<number>} before
 * @param {number} index
 * @param {{ altKey: boolean }} keys
 */
export function clicked(before, index, { altKey }) {
  return altKey ? combined(before, [index], "subtract") : toggled(before, index);
}

/**
 * @param {Database} database
 * @param {Set<number>} selection
 */
function packed(database, selection) {
  const bytes = new Uint8Array(Math.ceil(database.count / 8));
  for (const index of selection) bytes[index >> 3] |= 1 << (index & 7);
  return btoa(String.fromCharCode(...bytes))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replace(/=+$/, "");
}

/**
 * @param {Database} database
 * @param {string} text
 */
function unpacked(database, text) {
  const whole = /^[\w-]*$/.test(text) && text.length % 4 !== 1;
  const bytes = whole ? atob(text.replaceAll("-", "+").replaceAll("_", "/")) : "";
  return [...Array(database.count).keys()].filter((index) => (bytes.charCodeAt(index >> 3) >> (index & 7)) & 1);
}

/** @type {WeakMap<Database, string>} */
const marks = new WeakMap();

/**
 * What tells a database from others of the same place.
 * @param {Database} database
 */
export function mark(database) {
  return entry(marks, database, () => hashed(`${database.ids.lines()}\n`));
}

/**
 * FNV-1a of a text.
 * @param {string} text
 */
function hashed(text) {
  let hash = 0x811c9dc5;
  for (let place = 0; place < text.length; place += 1) {
    const letter = /** @type {number} */ (text.codePointAt(place));
    if (letter > 0xffff) place += 1;
    hash = Math.imul(hash ^ letter, 0x01000193);
  }
  return (hash >>> 0).toString(36);
}
