// The gallery as tables: the shapes that are shown, and how many there are of each value and in each interval.

import { table } from "../base/tables.js";
import { count, grouped } from "../base/words.js";
import { NONE, numberText, valueName } from "../database/fields.js";

/** @import { Database } from "../database/database.js" */
/** @import { ChoiceField, Field, Fields, RangeField } from "../database/fields.js" */
/** @import { Group } from "./layout.js" */
/** @import { Sieve } from "./sieve.js" */

const MOST_SHAPES = 200;
const MOST_VALUES = 100;

/**
 * @param {Database} database
 * @param {Fields} fields
 * @param {Sieve} sieve
 * @param {Group[]} groups
 */
export function galleryTables(database, fields, sieve, groups) {
  const rows = groups.flatMap((group) => [...group.rows]);
  const title = rows.length > MOST_SHAPES ? `The first ${MOST_SHAPES} of ${count(rows.length, "shape")}` : "Shapes";
  const columns = fields.all.filter(({ numbers, names, active }) => active || numbers !== null || names !== null);
  const shapes = rows
    .slice(0, MOST_SHAPES)
    .map((row) => [database.names.at(row), database.ids.at(row), ...columns.map((field) => cell(field, row))]);
  return {
    title: `${grouped(sieve.size)} of ${count(database.count, "shape")}`,
    tables: [
      table(title, ["Name", "Id", ...columns.map((field) => field.title)], shapes),
      ...fields.filters
        .filter(({ names, edges }) => names !== null || edges !== null)
        .map((field) => table(field.title, [field.title, "Shapes"], counted(field, sieve))),
    ],
  };
}

/**
 * @param {Field} field
 * @param {number} row
 */
function cell(field, row) {
  if (field.numbers !== null) return numberText(field.numbers[row], field);
  const { of, names } = /** @type {ChoiceField} */ (field);
  return of[row] === NONE ? "–" : names[of[row]];
}

/**
 * @param {Field} field
 * @param {Sieve} sieve
 */
function counted(field, sieve) {
  if (field.edges !== null) {
    const { edges } = field;
    const counts = sieve.countsOfIntervals(/** @type {RangeField} */ (field));
    return [...counts].map((number, place) => [
      `${numberText(edges[place], field)} to ${numberText(edges[place + 1], field)}`,
      grouped(number),
    ]);
  }
  const choice = /** @type {ChoiceField} */ (field);
  const counts = sieve.counts(choice);
  const values = [...choice.names.keys()].filter((value) => counts[value] > 0).slice(0, MOST_VALUES);
  if (counts[counts.length - 1] > 0) values.push(NONE);
  return values.map((value) => [valueName(field, value), grouped(counts.at(value) ?? 0)]);
}
