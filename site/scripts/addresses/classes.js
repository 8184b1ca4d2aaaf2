// Classes in an address, by name; or the clusters that stand in for them.

import { lookUp } from "../base/missing.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { Database } from "../database/database.js" */

/**
 * What one of them is.
 * @param {Pick<Database, "data">} database
 */
export function classNoun({ data }) {
  return data.standIn ? "cluster" : "class";
}

/**
 * The numbers of those that are there.
 * @param {string[]} names
 * @param {Pick<Database, "data" | "classes">} database
 * @param {Miss} miss
 */
export function classesNamed(names, database, miss) {
  const { classes } = database;
  const places = new Map(classes.map((name, place) => [name, place]));
  return lookUp(names, (name) => places.get(name), classNoun(database), miss);
}
