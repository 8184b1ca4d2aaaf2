// What the page of a shape shows, in its address: the shape by its id, what similar means, the map, the painted bin, the
// parts of features in sight, and the selection that came along.

import { Address, named, text } from "../base/address.js";
import { pageAddress } from "../base/place.js";
import { selected } from "./selected.js";

/** @import { Ways } from "../base/address.js" */
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
 * @property {string | null} bin
 * @property {string} parts
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
    { names: ["shape", "unknown"], ...shapeOrUnknown(database), place: true },
    { name: "method", key: "map", kind: named(database.methods.map(({ key }) => key)), standard: 0 },
    { name: "features", key: "features", kind: text, standard: "" },
    { name: "bins", key: "bins", kind: text, standard: "" },
    { name: "bin", key: "bin", kind: text, standard: null },
    { name: "parts", key: "parts", kind: text, standard: "" },
    selected(database),
  ]);
}

/**
 * The address of another shape's page, seen in the same way.
 * @param {Database} database
 * @param {State} state
 * @param {number} shape
 */
export function shapeAddress(database, state, shape) {
  /** @param {string} name */
  const get = (name) => (name === "shape" ? shape : state.get(name));
  return pageAddress("shape.html", shapePageAddress(database).write({ get }));
}

/**
 * @param {Database} database
 * @returns {Ways}
 */
function shapeOrUnknown(database) {
  return {
    read(query) {
      const id = query.get("id");
      const shape = database.indexOfId.get(id ?? "") ?? null;
      return { shape, unknown: shape === null ? id : null };
    },
    write(query, { shape, unknown }) {
      const id = shape === null ? unknown : database.ids[shape];
      if (id !== null) query.set("id", id);
    },
  };
}
