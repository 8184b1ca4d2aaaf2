// The selection as a file, the same from every page; and what other exports share.

import { saveFile } from "../base/saving.js";
import { highestOf } from "../database/hit-range.js";

/** @import { Database } from "../database/database.js" */

/**
 * @param {Database} database
 * @param {number[]} chosen
 */
export function saveCsv(database, chosen) {
  const header = ["id", "name", "class", ...database.projections.flatMap(({ key }) => [`nh:${key}`, `nh_max:${key}`])];
  const rows = chosen.map((index) => [
    database.ids.at(index),
    database.names.at(index),
    database.groups[index] < 0 ? "" : database.className(database.groups[index]),
    ...database.projections.flatMap((method) => [method.hit[index] ?? "", highestOf(database, method, index) ?? ""]),
  ]);
  saveFile("selection.csv", new Blob([csvText([header, ...rows])], { type: "text/csv" }));
}

/**
 * @param {Database} database
 * @param {number[]} chosen
 */
export function saveJson(database, chosen) {
  const shapes = chosen.map((index) => ({
    id: database.ids.at(index),
    name: database.names.at(index),
    class: database.groups[index] < 0 ? null : database.className(database.groups[index]),
    nh: Object.fromEntries(database.projections.map(({ key, hit }) => [key, hit[index]])),
    nh_max: Object.fromEntries(database.projections.map((method) => [method.key, highestOf(database, method, index)])),
  }));
  saveFile("selection.json", new Blob([`${JSON.stringify({ shapes }, null, 1)}\n`], { type: "application/json" }));
}

/**
 * Rows as lines of comma-separated values.
 * @param {(string | number)[][]} rows
 */
export function csvText(rows) {
  return `${rows.map((row) => row.map(quoted).join(",")).join("\n")}\n`;
}

const NUMBER = /^[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?$/i;
const FORMULA = /^'*[=+\-@\t\r\n\uff1d\uff0b\uff0d\uff20]/;

/**
 * A cell; text that a spreadsheet program would take for a formula has an apostrophe before it, as cells.py writes it.
 * @param {string | number} value
 */
function quoted(value) {
  const plain = String(value);
  const text = typeof value === "string" && FORMULA.test(plain) && !NUMBER.test(plain) ? `'${plain}` : plain;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
