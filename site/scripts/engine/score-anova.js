// The F statistic of a one-way analysis of variance; shapeviz_report/scorers/anova.py says it in full.

import { valuesAt } from "./table.js";

/**
 * Scores of `columns`, all of which vary over the contest's rows.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 * @returns {Steps<Float64Array>}
 */
export function* scoreByAnova(table, contest, columns) {
  const { positive, negative } = contest;
  const count = positive.length + negative.length;
  const weight = (positive.length * negative.length) / count;
  const between = new Float64Array(columns.length);
  const within = new Float64Array(columns.length);
  const [own, others] = [new Float32Array(positive.length), new Float32Array(negative.length)];
  let widest = 0;
  for (let place = 0; place < columns.length; place += 1) {
    const first = spread(valuesAt(table, columns[place], positive, own));
    const second = spread(valuesAt(table, columns[place], negative, others));
    between[place] = weight * (first.mean - second.mean) ** 2;
    within[place] = first.squares + second.squares;
    widest = Math.max(widest, between[place] + within[place]);
    if (place % 256 === 255) yield { progress: (place + 1) / columns.length };
  }
  // Where neither group has any spread, F would be infinite.
  const floor = Number.EPSILON * widest;
  const freedom = Math.max(count - 2, 1);
  return between.map((value, place) => (freedom * value) / Math.max(within[place], floor));
}

/**
 * Mean and sum of squared deviations from it.
 * @param {Float32Array} values
 */
function spread(values) {
  let mean = 0;
  for (let i = 0; i < values.length; i += 1) mean += values[i];
  mean /= values.length;
  let squares = 0;
  for (let i = 0; i < values.length; i += 1) squares += (values[i] - mean) ** 2;
  return { mean, squares };
}
