// What the page of a shape shows, in its address: the shape by its id, what similar means, the map, the painted bin, the
// parts of features in sight, another shape beside it, and the selection that came along.

import { Address, flag, named, text } from "../base/address.js";
import { pageAddress } from "../base/place.js";
import { binNames } from "../database/bins.js";
import { readShortNames } from "./bin-names.js";
import { namedElsewhere } from "./classes.js";
import { missMap } from "./maps.js";
import { splitNames } from "./names.js";
import { selected } from "./selected.js";

/** @import { Kind, Ways } from "../base/address.js" */
/** @import { Miss } from "../base/missing.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */

/**
 * What the page of a shape has in its state: features, bins and parts as text, since these come later.
 * @typedef {object} ShapeValues
 * @property {number | null} shape
 * @property {string | null} unknown an id that the database does not have
 * @property {number} method the map
 * @property {string} features
 * @property {string} bins
 * @property {boolean} neighbourhood whether similar shapes are those by neighbourhood, of all features
 * @property {string | null} bin
 * @property {boolean} clay whether the model is drawn in clay, whatever colours its file has
 * @property {string} parts
 * @property {number | null} beside a shape whose surface is compared with this one's
 * @property {string} within the feature that it is compared by; all of them where it is none
 *
 * @typedef {State<ShapeValues & Shared>} ShapeState
 */

/**
 * Features and bins stay text here: which ones there are is only known with the features themselves, which are large
 * and come later. `unknown` is an id that the database does not have.
 * @param {Database} database
 */
export function shapePageAddress(database) {
  return new Address([
    { names: ["shape", "unknown"], ...shapeOrUnknown(database), place: true, words: "the shape" },
    { name: "method", key: "map", kind: mapOf(database), standard: 0 },
    { name: "features", key: "features", kind: text, standard: "", words: "what similar means" },
    { name: "bins", key: "bins", kind: text, standard: "" },
    { name: "neighbourhood", key: "neighbourhood", kind: flag, standard: false, words: "the order by neighbourhood" },
    { name: "bin", key: "bin", kind: text, standard: null },
    { name: "clay", key: "clay", kind: flag, standard: false, words: "the shape in clay" },
    { name: "parts", key: "parts", kind: text, standard: "" },
    { name: "beside", key: "beside", kind: named(database.ids, "shape"), standard: null, words: "the shape beside it" },
    { name: "within", key: "within", kind: text, standard: "" },
    selected(database),
    namedElsewhere(database),
  ]);
}

/**
 * Whether a state names features or bins.
 * @param {Record<string, any>} values
 */
export function namesFeatures({ features, bins, bin, parts, within }) {
  return bin !== null || [features, bins, parts, within].some((text) => text !== "");
}

/**
 * Tell of those that are not there.
 * @param {Record<string, any>} values
 * @param {Chunk.Feature[]} features
 * @param {Miss} miss
 */
export function missFeatures(values, features, miss) {
  const names = features.map(({ name }) => name);
  splitNames(values.features, names, miss);
  if (values.within !== "" && !names.includes(values.within)) miss("feature", values.within);
  for (const text of [values.bins, values.parts]) readShortNames(text, features, miss);
  if (values.bin !== null && !binNames(features).includes(values.bin)) miss("bin", values.bin);
}

/**
 * The address of another shape's page, seen in the same way.
 * @param {Database} database
 * @param {State} state
 * @param {number} shape
 */
export function shapeAddress(database, state, shape) {
  /** @type {Partial<ShapeValues>} */
  const other = { shape, beside: null, within: "" };
  /** @param {string} name */
  const get = (name) => (name in other ? other[/** @type {keyof ShapeValues} */ (name)] : state.get(name));
  return pageAddress("shape.html", shapePageAddress(database).write({ get }));
}

/**
 * The page of a shape, with another beside it.
 * @param {Database} database
 * @param {number} shape
 * @param {number} beside
 */
export function besideAddress(database, shape, beside) {
  return pageAddress("shape.html", { id: database.ids.at(shape), beside: database.ids.at(beside) });
}

/**
 * A map, by its key.
 * @param {Database} database
 * @returns {Kind}
 */
function mapOf(database) {
  const keys = database.methods.map(({ key }) => key);
  return {
    read([key], miss) {
      missMap(key, database, miss);
      return keys.includes(key) ? keys.indexOf(key) : undefined;
    },
    write: (method) => [keys[method]],
  };
}

/**
 * @param {Database} database
 * @returns {Ways}
 */
function shapeOrUnknown(database) {
  return {
    keys: /^id$/,
    read(query) {
      const id = query.get("id") || null;
      const found = database.ids.indexOf(id ?? "");
      const shape = found < 0 ? null : found;
      return { shape, unknown: shape === null ? id : null };
    },
    write(query, { shape, unknown }) {
      const id = shape === null ? unknown : database.ids.at(shape);
      if (id !== null) query.set("id", id);
    },
  };
}
