// What the groups of the database are: classes, or the clusters that stand in for them.

/** @import { Database } from "./database.js" */

/** @param {Pick<Database, "data">} database */
export function kind({ data }) {
  return data.standIn ? "cluster" : "class";
}

/** @param {Pick<Database, "data">} database */
export function kinds({ data }) {
  return data.standIn ? "clusters" : "classes";
}

/**
 * What says which shapes belong together.
 * @param {Pick<Database, "data">} database
 */
export function labels({ data }) {
  return data.standIn ? "clusters" : "labels";
}
