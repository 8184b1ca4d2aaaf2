// What the page of a shape shows, as tables.

import { table } from "../base/tables.js";
import { count, figure } from "../base/words.js";
import { whole } from "./similar-shapes.js";

/** `similar` and `histograms` are null as long as the features are not there. */
export function shapeTables(model, state, { facts, similar, histograms }) {
  const shape = state.get("shape");
  if (shape === null) return { title: "No such shape", tables: [] };
  const named = (index) => [model.ids[index], model.names[index], ...(model.labelled ? [model.className(model.groups[index])] : [])];
  const heads = ["Shape", "Name", ...(model.labelled ? [model.data.standIn ? "Cluster" : "Class"] : [])];
  const method = model.methods[state.get("method")];
  const near = model.count > 1 ? model.neighbours(shape, state.get("method")) : [];
  const { features } = similar?.bins ?? {};
  return {
    title: `${model.names[shape]} in figures`,
    tables: [
      ...facts.groups.map(({ title, rows }) => table(title, ["Fact", "Value"], rows)),
      near.length > 0 && table(`Its ${count(near.length, "nearest neighbour")} on the ${method.title} map`, [...heads, "NH"], near.map((other) => [...named(other), figure(method.hit[other])])),
      similar?.found.length > 0 && table(
        "Most similar shapes, and the share of all shapes that are farther away in each feature",
        [...heads, "Distance", ...features.map(({ name }) => name)],
        similar.found.map(({ row, distance, closer }) => [...named(row), figure(distance), ...closer.map(whole)]),
      ),
      histograms && table("Its features", ["Bin", "This shape", model.data.standIn ? "Half of its cluster" : "Half of its class", "Half of all shapes"], histograms.rows()),
    ].filter(Boolean),
  };
}
