// What the page shows, as tables.

import { table } from "../base/tables.js";
import { capitalised, figure, grouped, isolated, percent } from "../base/words.js";
import { highestOf } from "../database/hit-range.js";
import { signed } from "./outliers.js";
import { kind } from "../database/kind.js";

/** @import { CompareState } from "../addresses/compare.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Share } from "../engine/contrast.js" */
/** @import { GroupsView, View } from "./groups-view.js" */
/** @import { Matrix } from "./matrix.js" */
/** @import { Outliers } from "./outliers.js" */

const MOST_BINS = 100;
const MOST_SHAPES = 300;

/**
 * @param {Database} database
 * @param {Chunk.Comparison} data
 * @param {CompareState} state
 * @param {{ groups: GroupsView, outliers: Outliers, matrix: Matrix }} parts
 */
export function compareTables(database, data, state, { groups, outliers, matrix }) {
  /** @type {Record<string, () => HTMLElement[]>} */
  const tables = {
    groups: () => ofGroups(groups.view),
    outliers: () => ofOutliers(database, data, outliers),
    classes: () => ofClasses(database, data, matrix),
  };
  return { title: "This comparison in figures", tables: tables[state.get("view")]() };
}

/** @param {View | null} view */
function ofGroups(view) {
  if (!view) return [];
  const { contrast, a, b, bins } = view;
  const { apart, difference, values } = contrast;
  /** @param {number} column */
  const line = (column) => {
    const told = bins.telling(column);
    return [
      bins.names[column],
      told(values.a.mean(column)),
      told(values.b.mean(column)),
      signed(difference[column]),
      figure(contrast.ahead(column)),
      contrast.isBeyond(column) ? "yes" : "no",
    ];
  };
  /**
   * @param {string} title
   * @param {Share} found
   */
  const feature = (title, { share: own, chance, limit, exceeding }) => [
    title,
    percent(own),
    percent(chance),
    percent(limit),
    figure(exceeding),
  ];
  return [
    table(
      `How much of what shapes differ in goes with the group: ${isolated(a.name)} (${grouped(a.shapes.length)}) and ${isolated(b.name)} (${grouped(b.shapes.length)})`,
      ["Feature", "Share", "Chance, mean", "Chance, one in 100", "Deals that reach it"],
      [
        feature("all features", apart.all),
        ...bins.features.map(({ name }, index) => feature(name, apart.features[index])),
      ],
    ),
    table(
      `The ${Math.min(MOST_BINS, contrast.ranked.length)} bins that differ most`,
      [
        "Bin",
        `Mean of ${isolated(a.name)}`,
        `Mean of ${isolated(b.name)}`,
        "Difference in standard deviations",
        "Pairs in which the first has more",
        "Beyond chance",
      ],
      contrast.ranked.slice(0, MOST_BINS).map(line),
    ),
    contrast.shared.length > 0 &&
      table(
        "Bins that both have in common against the others",
        ["Bin", `Mean of ${isolated(a.name)}`, `Mean of ${isolated(b.name)}`, "Mean of the others"],
        contrast.shared
          .slice(0, MOST_BINS)
          .map((column) => [...line(column).slice(0, 3), bins.telling(column)(values.rest.mean(column))]),
      ),
  ].filter(Boolean);
}

/**
 * @param {Database} database
 * @param {Chunk.Comparison} data
 * @param {Outliers} outliers
 */
function ofOutliers(database, data, outliers) {
  const ranked = outliers.list === null ? [] : outliers.ranked().slice(0, MOST_SHAPES);
  return [
    table(
      `Shapes by how well they fit their ${kind(database)}`,
      [
        "Shape",
        capitalised(kind(database)),
        "Fit",
        `Closest other ${kind(database)}`,
        ...database.methods.flatMap(({ title }) => [`NH on ${title}`, "at most"]),
      ],
      ranked.map((index) => [
        database.names.at(index),
        database.className(database.groups[index]),
        signed(data.fit[index]),
        database.className(data.rival[index]),
        ...database.methods.flatMap((method) => [
          figure(method.hit[index]),
          figure(highestOf(database, method, index)),
        ]),
      ]),
    ),
  ];
}

/**
 * @param {Database} database
 * @param {Chunk.Comparison} data
 * @param {Matrix} matrix
 */
function ofClasses(database, data, matrix) {
  if (matrix.node === null) return [];
  const { order } = data;
  return [
    table(
      `Of the nearest neighbours of a ${kind(database)} (rows), the share in each ${kind(database)} (columns)`,
      [capitalised(kind(database)), ...order.map((column) => database.className(column))],
      order.map((row) => [database.className(row), ...order.map((column) => figure(matrix.share(row, column)))]),
    ),
  ];
}
