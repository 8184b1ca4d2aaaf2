// What the page of a shape shows, as tables.

import { table } from "../base/tables.js";
import { count, figure, isolated, wholePercent } from "../base/words.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Facts } from "./facts.js" */
/** @import { Histograms } from "./histograms.js" */
/** @import { SideBySide } from "./side-by-side.js" */
/** @import { SimilarShapes } from "./similar-shapes.js" */

/**
 * @param {Database} database
 * @param {ShapeState} state
 * @param {{ facts: Facts, similar?: SimilarShapes, beside?: SideBySide, histograms?: Histograms }} parts those of the features are missing as long as
 *   these are not there
 */
export function shapeTables(database, state, { facts, similar, beside, histograms }) {
  const shape = state.get("shape");
  if (shape === null) return { title: "No such shape", tables: [] };
  /** @param {number} index */
  const named = (index) => [
    database.ids.at(index),
    database.names.at(index),
    ...(database.labelled ? [database.className(database.groups[index])] : []),
  ];
  const heads = ["Shape", "Name", ...(database.labelled ? [database.data.standIn ? "Cluster" : "Class"] : [])];
  const method = database.methods[state.get("method")];
  const near = database.count > 1 ? database.neighbours(shape, state.get("method")) : [];
  const { found = [], bins } = similar ?? {};
  return {
    title: `${isolated(database.names.at(shape))} in figures`,
    tables: [
      ...facts.groups.map(({ title, rows }) => table(title, ["Fact", "Value"], rows)),
      near.length > 0 &&
        table(
          `Its ${count(near.length, "nearest neighbour")} on the ${method.title} map`,
          [...heads, "NH"],
          near.map((other) => [...named(other), figure(method.hit[other])]),
        ),
      found.length > 0 &&
        table(
          "Most similar shapes, and the share of all shapes that are farther away in each feature",
          [...heads, "Distance", ...(bins?.features ?? []).map(({ name }) => name)],
          found.map(({ row, distance, closer }) => [...named(row), figure(distance), ...closer.map(wholePercent)]),
        ),
      beside?.pair &&
        table(
          `Where it and ${isolated(database.names.at(beside.pair[1]))} differ: shares of their squared distance`,
          ["Feature", "Of all", "On this shape", "On the other"],
          beside.rows(),
        ),
      histograms &&
        table(
          "Its features",
          [
            "Bin",
            "This shape",
            database.data.standIn ? "Half of its cluster" : "Half of its class",
            "Half of all shapes",
          ],
          histograms.rows(),
        ),
    ].filter(Boolean),
  };
}
