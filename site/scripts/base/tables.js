// The charts as tables: every figure a page draws, to read, and for screen readers.

import { element } from "./dom.js";
import { grouped } from "./words.js";

/** @import { Children } from "./dom.js" */

/**
 * Make the button open a dialog with what `content` returns at that moment: a title and elements.
 * @param {() => { title: string, tables: HTMLElement[] }} content
 */
export function watchTables(content) {
  const dialog = document.getElementById("tables");
  document.getElementById("open-tables").addEventListener("click", () => {
    const { title, tables } = content();
    dialog.replaceChildren(
      element(
        "div",
        { class: "detail-head" },
        element("h2", {}, title),
        element("button", { type: "button", class: "plain", onclick: () => dialog.close() }, "Close"),
      ),
      ...tables,
    );
    dialog.showModal();
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
}

/**
 * Numbers that come as such are counts.
 * @param {string} title
 * @param {Children[]} columns
 * @param {Children[][]} rows
 */
export function table(title, columns, rows) {
  return element(
    "table",
    {},
    element("caption", {}, title),
    element(
      "thead",
      {},
      element(
        "tr",
        {},
        columns.map((column) => element("th", { scope: "col" }, column)),
      ),
    ),
    element(
      "tbody",
      {},
      rows.map(([first, ...rest]) =>
        element(
          "tr",
          {},
          element("th", { scope: "row", dir: "auto" }, first),
          rest.map((value) => element("td", {}, typeof value === "number" ? grouped(value) : value)),
        ),
      ),
    ),
  );
}
