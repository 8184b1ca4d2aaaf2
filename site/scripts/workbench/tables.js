// What the Workbench draws, as tables.

import { difference } from "../base/figures.js";
import { table } from "../base/tables.js";
import { capitalised, figure } from "../base/words.js";
import { binTables } from "../bins-kit/bin-list.js";
import { kind } from "../database/kind.js";
import { MEASURES, measureOf } from "../map/measures.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database, ShapeMap } from "../database/database.js" */
/** @import { MeasureName } from "../map/measures.js" */

const MOST_ROWS = 500;

const MEASURE_NAMES = /** @type {MeasureName[]} */ (Object.keys(MEASURES));

/**
 * @param {Database} database
 * @param {Bins} bins
 * @param {WorkState} state
 */
export function workTables(database, bins, state) {
  const [original, refined] = [state.get("originalMap"), state.get("refinedMap")];
  const hidden = state.get("hidden");
  const groups = [...database.classes.keys()].filter((group) => !hidden.has(group));
  /**
   * @param {number | null} before
   * @param {number | null} after
   */
  const change = (before, after) => (before === null || after === null ? "–" : difference(before, after));
  /**
   * @param {string} name
   * @param {number | null} before
   * @param {number | null} after
   */
  const row = (name, before, after) => [name, figure(before), figure(after), change(before, after)];
  /** @param {number} group */
  const hits = (group) =>
    row(database.className(group), original?.hitOfClass[group] ?? null, refined?.hitOfClass[group] ?? null);
  const scores = state.get("scores");
  const shapes = [...database.ids.keys()].filter((index) => !hidden.has(database.groups[index])).slice(0, MOST_ROWS);
  /**
   * @param {ShapeMap | null} map
   * @param {number} index
   */
  const place = (map, index) => (map === null ? ["–", "–"] : [figure(map.x[index]), figure(map.y[index])]);
  /**
   * @param {ShapeMap | null} map
   * @param {MeasureName} name
   */
  const measured = (map, name) => {
    const { value, chance } = map?.faith ? measureOf(map.faith, name) : { value: null, chance: null };
    return [figure(value), figure(chance)];
  };
  return {
    title: "The Workbench in figures",
    tables: [
      database.labelled &&
        table(
          "Neighbourhood hit",
          [capitalised(kind(database)), "Original map", "Refined map", "Change"],
          [row("All classes in use", original?.hitOfAll ?? null, refined?.hitOfAll ?? null), ...groups.map(hits)],
        ),
      table(
        "Who is like whom, by what each map is made from",
        ["Measure", "Original map", "at random", "Refined map", "at random"],
        MEASURE_NAMES.map((name) => [MEASURES[name].title, ...measured(original, name), ...measured(refined, name)]),
      ),
      ...(scores === null ? [] : binTables(bins, scores, state.get("bins"))),
      table(
        "Shapes",
        ["Shape", capitalised(kind(database)), "original x", "y", "refined x", "y"],
        shapes.map((index) => [
          database.ids.at(index),
          database.className(database.groups[index]),
          ...place(original, index),
          ...place(refined, index),
        ]),
      ),
    ].filter(Boolean),
  };
}
