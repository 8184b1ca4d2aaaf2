// The state of the gallery in its address.

import { Address, choice, flag, named, text, texts, within } from "../base/address.js";
import { pageAddress } from "../base/place.js";
import { lookUp } from "../base/missing.js";
import { NONE } from "../database/fields.js";
import { readSelection, writeSelection } from "../database/selection.js";
import { namedElsewhere, classNoun } from "./classes.js";
import { missField } from "./fields.js";
import { asNamed } from "./names.js";
import { selected } from "./selected.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { Kind, Ways } from "../base/address.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Field, Fields } from "../database/fields.js" */
/** @import { Shared } from "../database/selection.js" */

/**
 * What the gallery has in its state.
 * @typedef {object} GalleryValues
 * @property {string} query
 * @property {Set<number> | null} matches shapes that the search finds
 * @property {boolean} only whether only the selected shapes are shown
 * @property {Map<string, Filter>} filters by the keys of their fields
 * @property {string} group key of the field that groups, or nothing
 * @property {string} sort key of the field that sorts; by name without one
 * @property {boolean} down
 * @property {number} size of a picture
 * @property {Set<string>} closed keys of groups
 * @property {number | null} at the shape to begin at
 *
 * @typedef {State<GalleryValues & Shared>} GalleryState
 */

/**
 * A filter of a field: values, or nodes of its tree, by their numbers; or a range. It is never changed, only replaced.
 * @typedef {Set<number> | { low: number, high: number }} Filter
 */

export const SIZES = { least: 56, usual: 148, most: 320 };

/** What each filter's parameter starts with; the key of its field follows. */
const FILTER = /^(?:is|lacks|range)\.(.+)$/;
const [IS, LACKS, RANGE] = ["is.", "lacks.", "range."];

/**
 * @param {Database} database
 * @param {Fields} fields
 */
export function galleryAddress(database, fields) {
  /** @param {Field[]} some */
  const keys = (some) => some.map(({ key }) => key);
  const usualGroup = database.separable ? (fields.active?.key ?? "") : "";
  return new Address([
    { name: "query", key: "find", kind: text, standard: "", often: true, words: "the search" },
    {
      name: "only",
      ...onlySelected(database),
      standard: false,
      place: true,
      words: "that only selected shapes are shown",
    },
    { name: "filters", ...filters(database, fields), place: true, often: true, words: "the filters" },
    {
      name: "group",
      key: "group",
      kind: fieldOf(["", ...keys(fields.groupable)], database, fields),
      standard: usualGroup,
      place: true,
      words: "the groups",
    },
    {
      name: "sort",
      key: "sort",
      kind: fieldOf(keys(fields.sortable), database, fields),
      standard: "",
      place: true,
      words: "the order",
    },
    { name: "down", key: "down", kind: flag, standard: false, place: true },
    { name: "size", key: "size", kind: within(SIZES.least, SIZES.most), standard: SIZES.usual, often: true },
    { name: "closed", key: "closed", kind: texts },
    selected(database),
    namedElsewhere(database),
    { name: "at", key: "at", kind: named(database.ids, "shape"), standard: null },
  ]);
}

/**
 * The address of the gallery with some shapes selected, and none but these shown.
 * @param {Database} database
 * @param {Set<number>} shapes
 */
export function galleryOf(database, shapes) {
  const query = new URLSearchParams([["only", ""]]);
  writeSelection(query, database, shapes);
  return pageAddress("shapes.html", query);
}

/**
 * None but the selected shapes, where there are some.
 * @param {Database} database
 */
function onlySelected(database) {
  return {
    keys: /^only$/,
    /** @param {URLSearchParams} query */
    read: (query) => query.has("only") && readSelection(query, database).size > 0,
    /** @param {URLSearchParams} query */
    write: (query) => query.set("only", ""),
  };
}

/**
 * What shapes can be grouped or sorted by.
 * @param {string[]} keys
 * @param {Database} database
 * @param {Fields} fields
 * @returns {Kind}
 */
function fieldOf(keys, database, fields) {
  const own = choice(keys);
  return {
    read(words, miss) {
      if (words[0]) missField(words[0], database, fields, miss);
      return own.read(words, miss);
    },
    write: own.write,
  };
}

/**
 * @param {Database} database
 * @param {Fields} fields
 * @returns {Ways}
 */
function filters(database, fields) {
  return {
    keys: FILTER,
    read(query, miss) {
      for (const parameter of query.keys()) {
        const [, key] = FILTER.exec(parameter) ?? [];
        if (key !== undefined) missField(key, database, fields, miss);
      }
      /** @type {Map<string, Filter>} */
      const found = new Map();
      for (const field of fields.filters) {
        const filter = readFilter(query, field, database, miss);
        if (filter !== null) found.set(field.key, filter);
      }
      return found;
    },
    write(query, all) {
      for (const [key, filter] of all) {
        const field = fields.byKey.get(key);
        if (field) writeFilter(query, field, filter);
      }
    },
  };
}

/**
 * @param {URLSearchParams} query
 * @param {Field} field
 * @param {Database} database
 * @param {Miss} miss
 */
function readFilter(query, field, database, miss) {
  const text = query.get(RANGE + field.key) ?? "";
  const range = text.split("..").map(Number);
  if (field.edges !== null && range.length === 2 && range.every(Number.isFinite))
    return { low: range[0], high: range[1] };
  if (text !== "") miss("range", text);
  if (field.names === null && field.tree === null) return null;
  const values = lookUp(
    query.getAll(IS + field.key),
    (name) => namedValue(field, name),
    nounOf(field, database),
    (noun, name) => miss(noun, field.tree === null ? name : asNamed(name)),
  );
  if (query.has(LACKS + field.key)) values.push(NONE);
  return values.length > 0 ? new Set(values) : null;
}

/**
 * What a value of a field is.
 * @param {Field} field
 * @param {Database} database
 */
function nounOf({ active, key }, database) {
  if (active) return classNoun(database);
  return key === "folders" ? "folder" : "value";
}

/**
 * @param {URLSearchParams} query
 * @param {Field} field
 * @param {Filter} filter
 */
function writeFilter(query, field, filter) {
  if (!(filter instanceof Set)) {
    query.set(RANGE + field.key, `${filter.low}..${filter.high}`);
    return;
  }
  for (const value of filter) {
    if (value === NONE) query.set(LACKS + field.key, "");
    else query.append(IS + field.key, nameInAddress(field, value));
  }
}

/**
 * A value by its name, a node by the names that lead to it.
 * @param {Field} field
 * @param {number} value
 */
function nameInAddress(field, value) {
  return field.tree === null ? (field.names?.[value] ?? "") : field.tree.ways[value].map(encodeURIComponent).join("/");
}

/**
 * @param {Field} field
 * @param {string} name
 */
function namedValue(field, name) {
  const { length } = field.tree?.nodes ?? field.names ?? [];
  field.numberOfName ??= new Map(Array.from({ length }, (_, value) => [nameInAddress(field, value), value]));
  return field.numberOfName.get(name);
}
