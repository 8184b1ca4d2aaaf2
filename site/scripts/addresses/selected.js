// The selected shapes in the address of a page of shapes.

import { readSelection, writeSelection } from "../database/selection.js";

/** A row of every such address. */
export function selected(database) {
  return {
    name: "selection",
    read: (query) => readSelection(query, database),
    write: (query, selection) => writeSelection(query, database, selection),
  };
}

/** The same where a brush changes it with every movement of the pointer. */
export function brushed(database) {
  return { ...selected(database), often: true };
}
