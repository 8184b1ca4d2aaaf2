// What the page of a shape shows, as tables.

import { table } from "../base/tables.js";
import { count, figure } from "../base/words.js";
import { whole } from "./similar-shapes.js";

/** `similar` and `histograms` are null as long as the features are not there. */
export function shapeTables(database, state, { facts, similar, histograms }) {
  const shape = state.get("shape");
  if (shape === null) return { title: "No such shape", tables: [] };
  const named = (index) => [
    database.ids[index],
    database.names[index],
    ...(database.labelled ? [database.className(database.groups[index])] : []),
  ];
  const heads = ["Shape", "Name", ...(database.labelled ? [database.data.standIn ? "Cluster" : "Class"] : [])];
  const method = database.methods[state.get("method")];
  const near = database.count > 1 ? database.neighbours(shape, state.get("method")) : [];
  const { features } = similar?.bins ?? {};
  return {
    title: `${database.names[shape]} in figures`,
    tables: [
      ...facts.groups.map(({ title, rows }) => table(title, ["Fact", "Value"], rows)),
      near.length > 0 &&
        table(
          `Its ${count(near.length, "nearest neighbour")} on the ${method.title} map`,
          [...heads, "NH"],
          near.map((other) => [...named(other), figure(method.hit[other])]),
        ),
      similar?.found.length > 0 &&
        table(
          "Most similar shapes, and the share of all shapes that are farther away in each feature",
          [...heads, "Distance", ...features.map(({ name }) => name)],
          similar.found.map(({ row, distance, closer }) => [...named(row), figure(distance), ...closer.map(whole)]),
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
