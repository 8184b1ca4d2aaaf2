// What the groups of the database are: classes, or the clusters that stand in for them.

import { isolated } from "../base/words.js";

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

/**
 * The name of a group within a sentence. A cluster is called "like ant 03", so its shapes are "those like ant 03".
 * @param {Pick<Database, "data">} database
 * @param {string} name
 */
export function inSentence({ data }, name) {
  return data.standIn ? `those ${isolated(name)}` : name;
}
