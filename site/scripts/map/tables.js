// The maps of the Overview as tables.

import { dataLink, element } from "../base/dom.js";
import { highestOf, rangeOf } from "../database/hit-range.js";
import { table } from "../base/tables.js";
import { count, figure } from "../base/words.js";

const MOST_ROWS = 500;

export function mapTables(model, state) {
  const method = model.methods[state.get("method")];
  const selection = state.get("selection");
  const hidden = state.get("hidden");
  const shown = model.ids
    .map((_, index) => index)
    .filter((index) => !hidden.has(model.groups[index]) && (selection.size === 0 || selection.has(index)));
  const groups = model.classes.map((_, group) => group);
  groups.sort((a, b) => (method.hitOfClass[b] ?? -1) - (method.hitOfClass[a] ?? -1) || a - b);
  const tables = [
    model.labelled && table(
      "Neighbourhood hit by class",
      ["Class", "Shapes", "NH", "NH at most"],
      groups.map((group) => [model.className(group), String(model.sizes.get(group)), figure(method.hitOfClass[group]), figure(rangeOf(model, method).highestOfClass.get(group))]),
    ),
    shapesTable(selection.size > 0 ? "Selected shapes" : "Shapes", model, method, shown),
    shown.length > MOST_ROWS && element("p", {}, `The first ${MOST_ROWS} of ${count(shown.length, "shape")}. All are in `, dataLink("data/shapes.csv"), "."),
  ].filter(Boolean);
  return { title: `The ${method.title} map in figures`, tables };
}

/** Where the first of some shapes lie on a map, and what share of their neighbours is of their class. */
export function shapesTable(title, model, method, indices) {
  return table(
    title,
    ["Shape", "Class", "NH", "NH at most", "x", "y"],
    indices.slice(0, MOST_ROWS).map((index) => [
      model.ids[index],
      model.className(model.groups[index]),
      figure(method.hit[index]),
      figure(highestOf(model, method, index)),
      figure(method.x[index]),
      figure(method.y[index]),
    ]),
  );
}
