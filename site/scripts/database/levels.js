// The values of all shapes of a database that has too many of them for one chunk, in parts that are loaded when asked for.

import { chunk, part } from "../base/chunks.js";
import { weightOf } from "./similarity.js";

/** @import { Bins } from "./bins.js" */

/** Numbers of all shapes, and what a squared difference of one counts in squared distances. */
/** @typedef {{ values: Uint8Array, unit: number }} Numbers */

/**
 * What maps of some bins compare, a column each.
 * @param {Bins} bins
 * @param {ArrayLike<number>} columns
 * @returns {Promise<Numbers[]>}
 */
export async function numbersOfBins(bins, columns) {
  const { low, high, variances } = await chunk("levels");
  return Promise.all(
    Array.from(columns, async (column) => {
      const unit = ((high[column] - low[column]) / STEPS) ** 2 * weightOf(bins, variances[column]);
      return { values: await levelsOf(bins, column), unit };
    }),
  );
}

/**
 * What maps of some features compare, to a good approximation: their principal components.
 * @param {number[]} features
 * @param {number} count of all shapes
 * @returns {Promise<Numbers[]>}
 */
export async function numbersOfFeatures(features, count) {
  const found = await Promise.all(features.map((feature) => part("components", feature)));
  return found.flatMap(({ unit, values }) =>
    Array.from({ length: values.length / count }, (_, component) => ({
      values: values.slice(component * count, (component + 1) * count),
      unit,
    })),
  );
}

/** From the lowest to the highest value of a column. */
export const STEPS = 255;

/**
 * The level of every shape in a column.
 * @param {Bins} bins
 * @param {number} column
 */
export async function levelsOf(bins, column) {
  const { order, columnsAPart } = await chunk("levels");
  const feature = bins.featureOf(column);
  const before = bins.features
    .slice(0, feature)
    .reduce((sum, { dimensions, bins: width }) => sum + Math.ceil((dimensions * width) / columnsAPart), 0);
  const place = column - bins.features[feature].start;
  const held = new Uint8Array(await part("columns", before + Math.floor(place / columnsAPart)));
  const start = (place % columnsAPart) * order.length;
  return held.slice(start, start + order.length);
}
