// In which order, and in which groups, the shapes that passed stand.

import { entry } from "../base/entry.js";
import { groupOf, NONE, numberText, valueName } from "../database/fields.js";
import { interval } from "./sieve.js";

/** @import { Database } from "../database/database.js" */
/** @import { ChoiceField, Field, Fields, RangeField } from "../database/fields.js" */
/** @import { Group } from "./layout.js" */

export class Arrangement {
  /** @type {Map<string, Int32Array>} */
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
    if (!field) return [{ key: "", title: null, group: null, note: "", rows: Array.from(order).filter(passes) }];
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
    return entry(this.#orders, key, () => sorted(this.fields, sort, down));
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
  if (!field) return down ? byName.slice().reverse() : byName;
  const sign = down ? -1 : 1;
  const values = field.numbers ?? field.of ?? [];
  const keys = Float64Array.from(values, (value) =>
    Number.isNaN(value) || (field.numbers === null && value === NONE) ? Infinity : sign * value,
  );
  // Sorting keeps the order of equals; of two without a value the difference is no number.
  return byName.slice().sort((a, b) => keys[a] - keys[b] || 0);
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
      return Number.isNaN(number) ? NONE : interval(edges, number);
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
