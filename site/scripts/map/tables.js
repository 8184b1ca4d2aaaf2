// The maps of the Overview as tables.

import { dataLink, element } from "../base/dom.js";
import { table } from "../base/tables.js";
import { capitalised, count, figure, grouped } from "../base/words.js";
import { highestOf, rangeOf } from "../database/hit-range.js";
import { kind } from "../database/kind.js";

/** @import { State } from "../base/state.js" */
/** @import { Database, ShapeMap } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Coloring } from "./coloring.js" */
/** @import { MapValues } from "./scene.js" */

const MOST_ROWS = 500;

/**
 * @param {Database} database
 * @param {State<MapValues & Shared>} state
 * @param {Coloring | null} [coloring] what else the map tells
 */
export function mapTables(database, state, coloring = null) {
  const method = database.methods[state.get("method")];
  const selection = state.get("selection");
  const hidden = state.get("hidden");
  const shown = [...database.ids.keys()].filter(
    (index) => !hidden.has(database.groups[index]) && (selection.size === 0 || selection.has(index)),
  );
  const groups = database.classes.map((_, group) => group);
  groups.sort((a, b) => (method.hitOfClass[b] ?? -1) - (method.hitOfClass[a] ?? -1) || a - b);
  const tables = [
    database.labelled &&
      table(
        `Neighbourhood hit by ${kind(database)}`,
        [capitalised(kind(database)), "Shapes", "NH", "NH at most"],
        groups.map((group) => [
          database.className(group),
          grouped(database.sizes.get(group) ?? 0),
          figure(method.hitOfClass[group]),
          figure(rangeOf(database, method).highestOfClass.get(group)),
        ]),
      ),
    shapesTable(selection.size > 0 ? "Selected shapes" : "Shapes", database, method, shown, coloring),
    shown.length > MOST_ROWS &&
      element(
        "p",
        {},
        `The first ${MOST_ROWS} of ${count(shown.length, "shape")}. All are in `,
        dataLink("data/shapes.csv"),
        ".",
      ),
  ].filter(Boolean);
  return { title: `The ${method.title} map in figures`, tables };
}

/**
 * Where the first of some shapes lie on a map, and what share of their neighbours is of their class.
 * @param {string} title
 * @param {Database} database
 * @param {ShapeMap} method
 * @param {number[]} indices
 * @param {Coloring | null} [coloring]
 */
export function shapesTable(title, database, method, indices, coloring = null) {
  return table(
    title,
    ["Shape", capitalised(kind(database)), ...(coloring ? [coloring.title] : []), "NH", "NH at most", "x", "y"],
    indices
      .slice(0, MOST_ROWS)
      .map((index) => [
        database.ids.at(index),
        database.className(database.groups[index]),
        ...(coloring ? [coloring.textOf(index)] : []),
        figure(method.hit[index]),
        figure(highestOf(database, method, index)),
        figure(method.x[index]),
        figure(method.y[index]),
      ]),
  );
}
