// The chi-squared statistic of a column's sums in the two groups; shapeviz_report/scorers/chi2.py says it in full.

import { valuesAt } from "./table.js";

/**
 * Scores of `columns`, all of which vary over the contest's rows.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 * @returns {Steps<Float64Array>}
 */
export function* scoreByChi2(table, contest, columns) {
  const { positive, negative } = contest;
  const share = positive.length / (positive.length + negative.length);
  const factor = 1 / share + 1 / (1 - share);
  const scores = new Float64Array(columns.length);
  const [own, others] = [new Float32Array(positive.length), new Float32Array(negative.length)];
  for (let place = 0; place < columns.length; place += 1) {
    valuesAt(table, columns[place], positive, own);
    valuesAt(table, columns[place], negative, others);
    let low = 0;
    let first = 0;
    let second = 0;
    for (let i = 0; i < own.length; i += 1) {
      const value = own[i];
      first += value;
      if (value < low) low = value;
    }
    for (let i = 0; i < others.length; i += 1) {
      const value = others[i];
      second += value;
      if (value < low) low = value;
    }
    // The statistic is one of counts: a column with negative values is shifted by its minimum.
    first -= low * positive.length;
    second -= low * negative.length;
    const excess = first - share * (first + second);
    scores[place] = ((excess * excess) / (first + second)) * factor;
    if (place % 256 === 255) yield { progress: (place + 1) / columns.length };
  }
  return scores;
}
