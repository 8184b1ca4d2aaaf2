// The charts as tables: every figure the page draws, to read, and for screen readers.

import { element } from "./dom.js";
import { count, figure } from "./words.js";

const MOST_ROWS = 500;

export function watchTables(model, state) {
  const dialog = document.getElementById("tables");
  document.getElementById("open-tables").addEventListener("click", () => {
    dialog.replaceChildren(...content(model, state, dialog));
    dialog.showModal();
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
}

function content(model, state, dialog) {
  const method = model.methods[state.get("method")];
  const selection = state.get("selection");
  const hidden = state.get("hidden");
  const shown = model.ids
    .map((_, index) => index)
    .filter((index) => !hidden.has(model.groups[index]) && (selection.size === 0 || selection.has(index)));
  const groups = model.classes.map((_, group) => group);
  groups.sort((a, b) => (method.hitOfClass[b] ?? -1) - (method.hitOfClass[a] ?? -1) || a - b);
  return [
    element(
      "div",
      { class: "detail-head" },
      element("h2", {}, `The ${method.title} map in figures`),
      element("button", { type: "button", class: "plain", onclick: () => dialog.close() }, "Close"),
    ),
    model.labelled && table(
      "Neighbourhood hit by class",
      ["Class", "Shapes", "NH"],
      groups.map((group) => [model.className(group), String(model.sizes.get(group)), figure(method.hitOfClass[group])]),
    ),
    table(
      selection.size > 0 ? "Selected shapes" : "Shapes",
      ["Shape", "Class", "NH", "x", "y"],
      shown.slice(0, MOST_ROWS).map((index) => [
        model.ids[index],
        model.className(model.groups[index]),
        figure(method.hit[index]),
        figure(method.x[index]),
        figure(method.y[index]),
      ]),
    ),
    shown.length > MOST_ROWS && element("p", {}, `The first ${MOST_ROWS} of ${count(shown.length, "shape")}. All are in `, element("a", { href: "data/shapes.csv" }, "data/shapes.csv"), "."),
  ].filter(Boolean);
}

function table(title, columns, rows) {
  return element(
    "table",
    {},
    element("caption", {}, title),
    element("thead", {}, element("tr", {}, columns.map((column) => element("th", { scope: "col" }, column)))),
    element(
      "tbody",
      {},
      rows.map(([first, ...rest]) =>
        element("tr", {}, element("th", { scope: "row", dir: "auto" }, first), rest.map((value) => element("td", {}, value))),
      ),
    ),
  );
}
