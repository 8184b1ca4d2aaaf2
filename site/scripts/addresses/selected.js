// The selected shapes in the address of a page of shapes.

import { readSelection, writeSelection } from "../database/selection.js";

/** @import { Ways } from "../base/address.js" */
/** @import { Database } from "../database/database.js" */

/**
 * A row of every such address.
 * @param {Database} database
 * @returns {Ways & { name: "selection", words: string }}
 */
export function selected(database) {
  return {
    name: "selection",
    words: "the selection",
    keys: /^select(ed)?$/,
    read: (query) => readSelection(query, database),
    write: (query, selection) => writeSelection(query, database, selection),
  };
}

/**
 * The same where a brush changes it with every movement of the pointer.
 * @param {Database} database
 */
export function brushed(database) {
  return { ...selected(database), often: true };
}
