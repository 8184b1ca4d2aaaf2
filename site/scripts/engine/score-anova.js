// The F statistic of a one-way analysis of variance; shapeviz_report/scorers/anova.py says it in full.

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
  let widest = 0;
  for (let place = 0; place < columns.length; place += 1) {
    const start = columns[place] * table.rows;
    const first = spread(table.values, start, positive);
    const second = spread(table.values, start, negative);
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
 * @param {number} start
 * @param {Int32Array} rows
 */
function spread(values, start, rows) {
  let mean = 0;
  for (let i = 0; i < rows.length; i += 1) mean += values[start + rows[i]];
  mean /= rows.length;
  let squares = 0;
  for (let i = 0; i < rows.length; i += 1) squares += (values[start + rows[i]] - mean) ** 2;
  return { mean, squares };
}
