// What the Bins page shows, as tables.

import { table } from "../base/tables.js";
import { capitalised, count, figure, grouped, percent } from "../base/words.js";
import { kind, kinds } from "../database/kind.js";

/** @import { BinsState } from "../addresses/bins.js" */
/** @import { BinCard } from "../bins-kit/bin-card.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */

const MOST_ROWS = 500;

/**
 * @param {Database} database
 * @param {Bins} bins
 * @param {Chunk.Selection} selection
 * @param {BinsState} state
 * @param {BinCard} card
 */
export function binsTables(database, bins, selection, state, card) {
  /** @param {number[]} columns */
  const names = (columns) => columns.map((column) => bins.names[column]).join(", ");
  const bin = state.get("bin");
  const told = bins.telling(bin);
  /** @param {string} kind */
  const fold =
    (kind) =>
    (/** @type {Chunk.Fold} */ { deal, bins: own, shapes, nh, nhAll, recognised, recognisedAll }) => [
      kind,
      String(deal),
      own.length,
      shapes,
      figure(nh),
      figure(nhAll),
      percent(recognised),
      percent(recognisedAll),
    ];
  const folds = [
    ...(selection.heldOut ?? []).map(fold("own labels")),
    ...(selection.shuffled ?? []).map(fold("shuffled labels")),
  ];
  return {
    title: "Bins in figures",
    tables: [
      selection.minimal.length > 0 &&
        table(
          `Each ${kind(database)} from the rest`,
          [
            capitalised(kind(database)),
            "Bins",
            `NH of the ${kind(database)} on their map`,
            "in their space",
            "at most",
            "random shapes",
          ],
          selection.minimal.flatMap(({ group, sets, highest, byChance }) =>
            sets.map((found) => [
              database.className(group),
              names(found.bins),
              figure(found.nh),
              figure(found.nhSpace),
              figure(highest),
              figure(byChance[found.bins.length - 1]?.nh),
            ]),
          ),
        ),
      selection.path.length > 0 &&
        table(
          `All ${kinds(database)} from each other, step by step`,
          ["Step", "Bins", "Added", "Removed", "NH of the map", "in their space"],
          selection.path.map((step, place) => [
            String(place + 1),
            step.bins.length,
            names(step.added),
            names(step.removed),
            figure(step.nh),
            figure(step.nhSpace),
          ]),
        ),
      folds.length > 0 &&
        table(
          "What such a choice is worth on shapes it never saw",
          [
            "Chosen by",
            "Deal",
            "Bins",
            "Unseen shapes",
            "NH, unseen shapes",
            "with all features",
            "recognised",
            "with all features",
          ],
          folds,
        ),
      table(
        `${bins.names[bin]} by ${kind(database)}`,
        [capitalised(kind(database)), "Median"],
        card.rows(bin).map(({ name, median }) => [name, told(median)]),
      ),
      table(
        `The shapes with the most of ${bins.names[bin]}${bins.sample ? `, of ${grouped(bins.rows)} of ${count(database.count, "shape")}` : ""}`,
        ["Shape", capitalised(kind(database)), "Value"],
        most(bins, bin).map((index) => [
          database.ids.at(index),
          database.className(database.groups[index]),
          told(bins.share(bin, index)),
        ]),
      ),
    ].filter(Boolean),
  };
}

/**
 * The shapes with the most of a bin, first the one with most.
 * @param {Bins} bins
 * @param {number} bin
 */
function most(bins, bin) {
  const amounts = bins.column(bin);
  const rows = [...amounts.keys()].sort((a, b) => amounts[b] - amounts[a] || a - b);
  return rows.slice(0, MOST_ROWS).map((row) => bins.shapeOf(row));
}
