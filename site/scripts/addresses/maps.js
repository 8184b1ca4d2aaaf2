// Maps in an address, by the keys of their projections, which go along from page to page.

/** @import { Miss } from "../base/missing.js" */
/** @import { Database } from "../database/database.js" */

/** Those of which the Workbench makes maps, of any database. */
export const PROJECTIONS = ["tsne", "umap"];

/**
 * A page may not have the map that another one shows: what no page has is missing.
 * @param {string | null | undefined} key
 * @param {Pick<Database, "data">} database
 * @param {Miss} miss
 */
export function missMap(key, { data }, miss) {
  if (key && !PROJECTIONS.includes(key) && !data.methods.some((method) => method.key === key)) miss("map", key);
}
