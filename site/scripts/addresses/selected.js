// The selected shapes in the address of a page of shapes: to select others is a step that the browser's way back takes back.

import { readSelection, writeSelection } from "../database/selection.js";

/** @import { Ways } from "../base/address.js" */
/** @import { Database } from "../database/database.js" */

/**
 * A row of every such address.
 * @param {Database} database
 * @returns {Ways & { name: "selection", place: true, words: string }}
 */
export function selected(database) {
  return {
    name: "selection",
    place: true,
    words: "the selection",
    keys: /^select(ed)?$/,
    read: (query, miss) => readSelection(query, database, miss),
    write: (query, selection) => writeSelection(query, database, selection),
  };
}
