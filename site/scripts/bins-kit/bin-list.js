// Bins in the order of their scores, and the same as a table.

import { table } from "../base/tables.js";
import { count, figure } from "../base/words.js";

/** @import { Bins } from "../database/bins.js" */

const MOST_ROWS = 100;

/**
 * The columns in use (those with a score), best first; equal ones as they come.
 * @param {Float64Array} scores
 */
export function ranked(scores) {
  /** @type {number[]} */
  const columns = [];
  for (let column = 0; column < scores.length; column += 1) if (!Number.isNaN(scores[column])) columns.push(column);
  return Int32Array.from(columns).sort((a, b) => scores[b] - scores[a] || a - b);
}

/**
 * Tables of the chosen bins and of the best ones, for the dialog of `watchTables`.
 * @param {Bins} bins
 * @param {Float64Array} scores
 * @param {Set<number>} chosen
 */
export function binTables(bins, scores, chosen) {
  const ranking = ranked(scores);
  const places = [...ranking.keys()];
  /** @param {number} place */
  const row = (place) => {
    const column = ranking[place];
    return [
      bins.names[column],
      String(place + 1),
      figure(scores[column]),
      chosen.has(column) ? "yes" : "no",
      bins.called[column],
      bins.sentence(column),
    ];
  };
  const columns = ["Bin", "Rank", "Score", "Chosen", "In words", "Exactly"];
  const taken = places.filter((place) => chosen.has(ranking[place]));
  const best = places.slice(0, MOST_ROWS);
  const title =
    ranking.length > MOST_ROWS
      ? `The best ${MOST_ROWS} of ${count(ranking.length, "bin")}`
      : "All bins, the best first";
  return [
    taken.length > 0 && table("Chosen bins", columns, taken.map(row)),
    table(title, columns, best.map(row)),
  ].filter(Boolean);
}
