// In which order, and in which groups, the shapes that passed stand.

import { groupOf, NONE, numberText, valueName } from "../database/fields.js";
import { interval } from "./sieve.js";

/** @import { Database } from "../database/database.js" */
/** @import { ChoiceField, Field, Fields, RangeField } from "../database/fields.js" */
/** @import { Group } from "./layout.js" */

export class Arrangement {
  #orders = new Map();

  /**
   * @param {Database} database
   * @param {Fields} fields
   */
  constructor(database, fields) {
    this.database = database;
    this.fields = fields;
  }

  /**
   * Groups of shapes in their order; one without a title where they are not grouped.
   * @param {(row: number) => boolean} passes
   * @param {{ group: string, sort: string, down: boolean }} how
   * @returns {Group[]}
   */
  arrange(passes, { group, sort, down }) {
    const order = this.#order(sort, down);
    const field = this.fields.byKey.get(group);
    if (!field) return [{ key: "", title: null, group: null, note: "", rows: order.filter(passes) }];
    const { count, of, describe } = grouping(field);
    /** @type {number[][]} */
    const rows = Array.from({ length: count + 1 }, () => []);
    for (const row of order) {
      if (!passes(row)) continue;
      const value = of(row);
      rows[value < 0 ? count : value].push(row);
    }
    return rows
      .map((members, value) => ({ ...describe(value === count ? NONE : value), rows: members }))
      .filter((found) => found.rows.length > 0);
  }

  /**
   * @param {string} sort
   * @param {boolean} down
   */
  #order(sort, down) {
    const key = `${down} ${sort}`;
    if (!this.#orders.has(key)) this.#orders.set(key, Int32Array.from(sorted(this.fields, sort, down)));
    return this.#orders.get(key);
  }
}

/**
 * All rows in an order; those without a value come last either way, equal ones by name.
 * @param {Fields} fields
 * @param {string} sort
 * @param {boolean} down
 */
function sorted({ byKey, byName }, sort, down) {
  const field = byKey.get(sort);
  if (!field) return down ? [...byName].reverse() : byName;
  const values = field.numbers ?? (field.of ?? []).map((value) => (value < 0 ? null : value));
  const sign = down ? -1 : 1;
  // Sorting keeps the order of equals.
  return [...byName].sort((a, b) => {
    if (values[a] === null || values[b] === null) return Number(values[a] === null) - Number(values[b] === null);
    return sign * (Number(values[a]) - Number(values[b]));
  });
}

/**
 * How a field makes groups: how many, which one a shape is of, and what they are called; -1 for none.
 * @param {Field} field
 * @returns {{ count: number, of: (row: number) => number, describe: (value: number) => Omit<Group, "rows"> }}
 */
function grouping(field) {
  if (field.names !== null) {
    const { names, of } = /** @type {ChoiceField} */ (field);
    return {
      count: names.length,
      of: (row) => of[row],
      describe: (value) => ({
        key: value < 0 ? "" : `=${names[value]}`,
        title: valueName(field, value),
        group: groupOf(field, value),
        note: field.notes?.[value] ?? "",
      }),
    };
  }
  const { edges, numbers } = /** @type {RangeField} */ (field);
  return {
    count: edges.length - 1,
    of: (row) => {
      const number = numbers[row];
      return number === null ? NONE : interval(edges, number);
    },
    describe: (value) => ({
      key: value < 0 ? "" : `=${edges[value]}`,
      title:
        value < 0
          ? `no ${field.title}`
          : `${numberText(edges[value], field)} to ${numberText(edges[value + 1], field)}`,
      group: null,
      note: "",
    }),
  };
}
