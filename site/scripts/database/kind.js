// What the groups of the database are: classes, or the clusters that stand in for them.

/** @import { Database } from "./database.js" */

/** @param {Database} database */
export function kind({ data }) {
  return data.standIn ? "cluster" : "class";
}

/** @param {Database} database */
export function kinds({ data }) {
  return data.standIn ? "clusters" : "classes";
}
