// Classes in an address, by name; or the clusters that stand in for them.

import { lookUp } from "../base/missing.js";
import { missMap } from "./maps.js";

/** @import { Ways } from "../base/address.js" */
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

/** Parameters that name classes, on whatever page. */
const OF_CLASSES = ["class", "hide", "separate", "from"];

/**
 * Classes and maps that an address names for other pages are nothing here; but who reads is told of those that no page has.
 * @param {Pick<Database, "data" | "classes">} database
 * @returns {Ways & { names: [] }}
 */
export function namedElsewhere(database) {
  return {
    names: [],
    keys: null,
    read(query, miss) {
      for (const key of OF_CLASSES) classesNamed(query.getAll(key), database, miss);
      missMap(query.get("map"), database, miss);
      return {};
    },
    write() {},
  };
}
