// The charts of the Features page as tables.

import { dataLink, element } from "../base/dom.js";
import { table } from "../base/tables.js";
import { capitalised, count, figure, grouped } from "../base/words.js";
import { shapesTable } from "../map/tables.js";
import { measureTitle } from "./ranking.js";
import { kind } from "../database/kind.js";

/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Subsets } from "../database/subsets.js" */

const MOST_ROWS = 300;

/**
 * @param {Database} database
 * @param {Subsets} subsets
 * @param {FeaturesState} state
 * @param {{ tables: () => any[] } | null} retrieval that section
 */
export function subsetTables(database, subsets, state, retrieval) {
  const { data } = subsets;
  const chosen = state.get("chosen");
  /** @param {number} place */
  const names = (place) => subsets.names(place).join(", ");
  const ranked = subsets.ranked(undefined, state.get("among"));
  const places = ranked.slice(0, MOST_ROWS);
  // It went among all subsets.
  const greedy = state.get("among") === "all" && data.greedy.find(({ s }) => s === state.get("s"));
  const classes = subsets
    .boxes(state.get("among"))
    .map((box, column) => [
      database.className(data.classes[column]),
      ...[data.hitOfClass[chosen][column], box.least, box.lower, box.median, box.upper, box.most].map(figure),
    ]);
  const method = state.get("method");
  const map = method === null ? null : database.methods[method];
  const tables = [
    greedy &&
      table(
        `Greedy search, s = ${greedy.s}`,
        ["Step", "NH", "Features"],
        greedy.path.map((place, step) => [String(step + 1), figure(data.hit[place]), names(place)]),
      ),
    classes.length > 0 &&
      table(
        `Neighbourhood hit by ${kind(database)}`,
        [capitalised(kind(database)), "chosen", "least", "lower quartile", "median", "upper quartile", "most"],
        classes,
      ),
    table(
      "Subsets",
      [subsets.labelled ? "Rank" : "Number", ...subsets.measures.map(({ name }) => measureTitle(name)), "Features"],
      places.map((place, position) => [
        grouped(position + 1),
        ...subsets.measures.map(({ values }) => figure(values?.[place])),
        names(place),
      ]),
    ),
    ranked.length > MOST_ROWS &&
      element(
        "p",
        {},
        `The first ${MOST_ROWS} of ${count(ranked.length, "subset")}. All are in `,
        dataLink("data/subsets.csv"),
        ".",
      ),
    map && shapesTable("The map of the chosen subset", database, map, [...database.ids.keys()]),
    ...(retrieval?.tables() ?? []),
  ].filter(Boolean);
  return { title: "Subsets of the features in figures", tables };
}
