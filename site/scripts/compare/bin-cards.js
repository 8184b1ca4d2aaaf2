// Bins as cards: what it says in a sentence, and how much of it both groups have.

import { element } from "../base/dom.js";
import { exactly, inWords } from "../bins-kit/bin-name.js";
import { distribution } from "./distribution.js";
import { inBoth, meaning, pairs, statement } from "./words.js";

/** @import { View } from "./groups-view.js" */
/** @import { Group } from "./groups.js" */

/**
 * A card a bin; a click on its name shows it on shapes.
 * @param {number} column
 * @param {View} view
 * @param {{ shared?: boolean }} [how]
 */
export function binCard(column, view, { shared = false } = {}) {
  const { contrast, a, b, bins, data, rest } = view;
  const hue = element("i", { class: "hued" });
  hue.style.background = bins.color(column);
  /**
   * @param {Group | View["rest"]} group
   */
  const row = (group) => {
    const values = contrast.values[group.side];
    return {
      mark: group.mark(),
      name: group.label,
      color: group.color(),
      points: values.points(column),
      each: values.each,
      mean: values.mean(column),
    };
  };
  const rows = (shared ? [a, b, rest] : [a, b]).map(row);
  const means = rows.map(({ mean }) => mean);
  return element(
    "li",
    { class: "bin-of-two" },
    element(
      "p",
      { class: "bin-name" },
      element(
        "button",
        {
          type: "button",
          class: "bin-chip",
          "data-column": column,
          "aria-pressed": String(column === view.bin),
          title: "Show it on shapes",
          onclick: () => view.look(column),
        },
        hue,
        element("bdi", {}, bins.shortName(column, 18)),
        inWords(bins, column),
      ),
    ),
    element("p", { class: "says" }, shared ? inBoth(column, means, view) : statement(column, contrast, a, b, data)),
    distribution(rows, bins.inPercent(column)),
    !shared && element("p", { class: "quiet" }, ahead(column, view)),
    exactly(bins, column, meaning(column, bins)),
  );
}

/**
 * How sure one may be for two single shapes.
 * @param {number} column
 * @param {View} view
 */
function ahead(column, { bins, contrast, a, b }) {
  const share = contrast.ahead(column);
  return [
    "Taken two by two, the one of ",
    element("bdi", {}, (share >= 0.5 ? a : b).name),
    ` has ${bins.inPercent(column) ? "more of it" : "the higher value"} ${pairs(Math.max(share, 1 - share))}.`,
  ];
}
