// Two groups of different sizes on an equal footing, for linear classifiers; shapeviz_report/scorers/balance.py says it
// in full.

import { valuesAt } from "./table.js";

/**
 * Columns of weighted mean 0 and weighted variance 1, where either group has half the weight.
 *
 * Returns `{ values, weights, count, hits }`: one column after the other, each over the `count` rows of the contest, of
 * which the first `hits` are the positive group; and the weight of each row.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 */
export function standardise(table, { positive, negative }, columns) {
  const rows = Int32Array.from([...positive, ...negative]);
  const count = rows.length;
  const hits = positive.length;
  const weights = Float64Array.from(rows, (_, i) => 0.5 / (i < hits ? hits : count - hits));
  const values = new Float64Array(columns.length * count);
  const held = new Float32Array(count);
  for (let place = 0; place < columns.length; place += 1) {
    const column = values.subarray(place * count, (place + 1) * count);
    column.set(valuesAt(table, columns[place], rows, held));
    let mean = 0;
    for (let i = 0; i < count; i += 1) mean += weights[i] * column[i];
    let variance = 0;
    for (let i = 0; i < count; i += 1) {
      column[i] -= mean;
      variance += weights[i] * column[i] * column[i];
    }
    const deviation = Math.sqrt(variance);
    for (let i = 0; i < count; i += 1) column[i] /= deviation;
  }
  return { values, weights, count, hits };
}
