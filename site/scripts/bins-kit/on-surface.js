// A bin on the surface of a shape: coloured by its values, or by what falls into it; and plain where there is nothing to
// colour.

/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Paint } from "../viewer/paint.js" */
/** @import { Showing } from "./stage.js" */

/** Why nothing is coloured by a feature of whole shapes, or by one that was brought along. */
export const UNPAINTED = "A value of the whole shape: it lies on no part of the surface, so nothing is coloured.";

/**
 * How a shape shows a bin.
 * @param {number} shape
 * @param {number} column
 * @param {{ database: Database, bins: Bins, paint: Paint, inside: boolean }} how `inside` for what falls into the bin
 * @returns {Showing}
 */
export function showingBin(shape, column, { database, bins, paint, inside }) {
  const label = `${database.names.at(shape)} in 3D`;
  const dimension = bins.dimensionOf(column);
  if (dimension === null) return { label, paint: (solid) => paint.plain(solid) };
  return inside
    ? {
        label: `${label}, which points fall into ${bins.names[column]}`,
        paint: (solid) => paint.inside(solid, dimension, bins.binOf(column)),
      }
    : { label: `${label}, values of ${bins.names[column]}`, paint: (solid) => paint.values(solid, dimension) };
}
