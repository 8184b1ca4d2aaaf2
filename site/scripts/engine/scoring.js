// The task "score": how well each column separates groups of shapes.

import { scoreByAnova } from "./score-anova.js";
import { scoreByChi2 } from "./score-chi2.js";
import { scoreByLogistic } from "./score-logistic.js";
import { scoreByRelief } from "./score-relief.js";
import { scoreByRfe } from "./score-rfe.js";
import { scoreByTrees } from "./score-trees.js";
import { differ } from "./table.js";

/**
 * Scores each of the columns, which all vary over the contest's rows.
 * @typedef {(table: FeatureValues, contest: Contest, columns: Int32Array, seed: number) => Steps<Float64Array>} Method
 */

/** @type {Map<string, Method>} the methods by their keys */
const METHODS = new Map([
  ["chi2", scoreByChi2],
  ["anova", scoreByAnova],
  ["trees", scoreByTrees],
  ["logistic", scoreByLogistic],
  ["relief", scoreByRelief],
  ["rfe", scoreByRfe],
]);

/**
 * Relative scores: those of each contest divided by their largest, and averaged over the contests.
 *
 * @param {FeatureValues} table
 * @param {{ method: string, contests: { positive: Iterable<number>, negative: Iterable<number> }[], columns: Int32Array, seed: number }} task
 * @returns {Steps<{ scores: Float64Array }>} one in [0, 1] for each of the columns
 */
export function* score(table, { method, contests, columns, seed }) {
  const measure = /** @type {Method} */ (METHODS.get(method));
  const scores = new Float64Array(columns.length);
  for (let number = 0; number < contests.length; number += 1) {
    // In one order, whichever way the reader came to the groups.
    const contest = {
      positive: Int32Array.from(contests[number].positive).sort(),
      negative: Int32Array.from(contests[number].negative).sort(),
    };
    const places = varying(table, contest, columns);
    if (places.length === 0) continue;
    const steps = measure(
      table,
      contest,
      places.map((place) => columns[place]),
      seed,
    );
    let step = steps.next();
    let progress = 0;
    while (step.done !== true) {
      // A method may find that there is more to do than it thought; the reader's bar only moves on.
      progress = Math.max(progress, step.value.progress);
      yield { progress: (number + progress) / contests.length };
      step = steps.next();
    }
    const found = step.value;
    const highest = found.reduce((most, value) => Math.max(most, value), 0);
    if (highest > 0) places.forEach((place, index) => (scores[place] += found[index] / highest / contests.length));
    yield { progress: (number + 1) / contests.length };
  }
  return { scores };
}

/**
 * The places in `columns` of those that are not constant over the contest's rows.
 * @param {FeatureValues} table
 * @param {Contest} contest
 * @param {Int32Array} columns
 */
function varying(table, { positive, negative }, columns) {
  const rows = Int32Array.from([...positive, ...negative]);
  return Int32Array.from(columns.keys()).filter((place) => differ(table, columns[place], rows));
}
