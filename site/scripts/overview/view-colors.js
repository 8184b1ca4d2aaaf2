// Colours as one of the views of the map.

import { viewsOf } from "../addresses/overview.js";
import { Colors, isKnown } from "../colors/colors.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Miss } from "../base/missing.js" */
/** @import { Database } from "../database/database.js" */

/**
 * What the address holds, with colours that there are.
 * @param {Database} database
 * @param {Record<string, any>} found
 * @param {Miss} miss
 */
export async function knownView(database, { by, ...values }, miss) {
  if (by === undefined) return values;
  return (await isKnown(by, database, miss)) ? { ...values, by } : { ...values, view: viewsOf(database)[0] };
}

/**
 * @param {Database} database
 * @param {OverviewState} state
 */
export function viewColors(database, state) {
  return new Colors(database, state, {
    key: () => (state.get("view") === "color" ? state.get("by") : null),
    choose: (by) => state.set({ view: "color", by }),
  });
}
