// The map of a subset among those of the database.

/** @import { Database } from "../database/database.js" */
/** @import { Subsets } from "../database/subsets.js" */

/**
 * The index of a subset's map in the database. Shapes that the search left out have no place on it.
 * @param {Database} database
 * @param {Subsets} subsets
 * @param {number} place
 */
export async function shown(database, subsets, place) {
  return database.add(await subsets.map(place, database), -1);
}
