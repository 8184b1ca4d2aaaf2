// Bins as cards: what it says in a sentence, and how much of it both groups have.

import { element } from "../base/dom.js";
import { percents } from "../base/words.js";
import { exactly, inWords } from "../bins-kit/bin-name.js";
import { distribution, mean } from "./distribution.js";
import { called, meaning, numbers, pairs, statement } from "./words.js";

/** @import { Contrast } from "./contrasts.js" */
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
  const share = bins.isShare(column);
  /**
   * @param {Group | View["rest"]} group
   * @param {number[]} rows
   */
  const row = (group, rows) => ({
    mark: group.mark(),
    name: group.name,
    color: group.color(),
    values: rows.map((index) => bins.share(column, index)),
  });
  const rows = [row(a, contrast.sample.a), row(b, contrast.sample.b)];
  if (shared) rows.push(row(rest, contrast.sample.rest));
  const means = rows.map(({ values }) => mean(values));
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
    element("p", { class: "says" }, shared ? common(column, view, means) : statement(column, contrast, a, b, data)),
    distribution(rows, share),
    !shared && element("p", { class: "quiet" }, ahead(column, contrast, a, b)),
    exactly(bins, column, meaning(column, bins)),
  );
}

/**
 * What two groups have in common against the rest.
 * @param {number} column
 * @param {View} view
 * @param {number[]} means
 */
function common(column, { a, b, bins, data, rest }, means) {
  const [first, second, others] = means;
  const told = (bins.isShare(column) ? percents : numbers)(first, second, others);
  const more = (first + second) / 2 > others;
  const figures = [called(a), ` ${told[0]}, `, called(b), ` ${told[1]}, `, called(rest), ` ${told[2]}`];
  if (!bins.isShare(column))
    return [
      "In ",
      called(a),
      " and ",
      called(b),
      ", ",
      element("bdi", {}, bins.names[column]),
      ` is ${more ? "higher" : "lower"} than in other shapes: `,
      ...figures,
      ".",
    ];
  return [
    `In both, compared with other shapes, ${more ? "more" : "less"} of ${data.whole} ${data.clauses[column]}: `,
    ...figures,
    ".",
  ];
}

/**
 * How sure one may be for two single shapes.
 * @param {number} column
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 */
function ahead(column, contrast, a, b) {
  const share = contrast.ahead(column);
  const [more, less] = share >= 0.5 ? [a, b] : [b, a];
  return [
    "A shape of ",
    element("bdi", {}, more.name),
    ` has more of it than one of `,
    element("bdi", {}, less.name),
    ` ${pairs(Math.max(share, 1 - share))}.`,
  ];
}
