// The selection as a file, the same from every page; and what other exports share.

import { highestOf } from "../database/hit-range.js";

export function saveCsv(model, chosen) {
  const header = ["id", "name", "class", ...model.data.methods.flatMap(({ key }) => [`nh:${key}`, `nh_max:${key}`])];
  const rows = chosen.map((index) => [
    model.ids[index],
    model.names[index],
    model.groups[index] < 0 ? "" : model.className(model.groups[index]),
    ...model.data.methods.flatMap((method) => [method.hit[index] ?? "", highestOf(model, method, index) ?? ""]),
  ]);
  saveText("selection.csv", "text/csv", csvText([header, ...rows]));
}

export function saveJson(model, chosen) {
  const shapes = chosen.map((index) => ({
    id: model.ids[index],
    name: model.names[index],
    class: model.groups[index] < 0 ? null : model.className(model.groups[index]),
    nh: Object.fromEntries(model.data.methods.map(({ key, hit }) => [key, hit[index]])),
    nh_max: Object.fromEntries(model.data.methods.map((method) => [method.key, highestOf(model, method, index)])),
  }));
  saveText("selection.json", "application/json", `${JSON.stringify({ shapes }, null, 1)}\n`);
}

/** Rows as lines of comma-separated values. */
export function csvText(rows) {
  return `${rows.map((row) => row.map(quoted).join(",")).join("\n")}\n`;
}

const NUMBER = /^[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?$/i;
const FORMULA = /^'*[=+\-@\t\r\n\uff1d\uff0b\uff0d\uff20]/;

/** A cell; text that a spreadsheet program would take for a formula has an apostrophe before it, as cells.py writes it. */
function quoted(value) {
  const plain = String(value);
  const text = typeof value === "string" && FORMULA.test(plain) && !NUMBER.test(plain) ? `'${plain}` : plain;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** Hand a text to the reader as a file. */
export function saveText(name, type, text) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}
