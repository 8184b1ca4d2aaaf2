// The values of a group of which every shape is known, in a database that has more of them than a page can hold.

import { RowValues } from "../database/group-values.js";
import { CountedValues, countedClasses } from "../database/level-counts.js";
import { MOST_DOTS } from "./distribution.js";

/** @import { Database } from "../database/database.js" */
/** @import { LevelBins } from "../database/level-bins.js" */

/** So many shapes are looked at one by one. */
const MOST_READ = 500;

/**
 * The values of some shapes, if they are whole classes, or few that lie in few parts; else null, at once. Of so few that
 * each is shown, one by one.
 * @param {LevelBins} bins
 * @param {number[]} shapes rising
 * @param {Database} database
 * @returns {Promise<RowValues | CountedValues> | null}
 */
export function wholeValues(bins, shapes, database) {
  /** @param {number} most */
  const few = (most) => shapes.length <= most && bins.some(shapes, database.groups, most).length === shapes.length;
  const counted = few(MOST_DOTS) ? null : countedClasses(bins, shapes, database);
  if (counted !== null || !few(MOST_READ)) return counted;
  return bins.know(shapes).then(() => new RowValues(bins, shapes));
}

/**
 * The same as counts.
 * @param {RowValues | CountedValues} values
 * @param {LevelBins} bins
 */
export function counts(values, bins) {
  return values instanceof CountedValues ? values : CountedValues.of(values, bins);
}
