// The state of the Overview in its address. Shapes and classes by name, not by number: a link stays good when the
// database grows.

import { pageAddress, readHash, replaceHash } from "../base/place.js";
import { readSelection, writeSelection } from "../database/selection.js";
import { joinNames, splitNames } from "./names.js";

export function readAddress(database) {
  const query = readHash();
  const method = database.methods.findIndex(({ key }) => key === query.get("map"));
  const known = (name) =>
    query
      .getAll(name)
      .map((id) => database.indexOfId.get(id))
      .filter((index) => index !== undefined);
  const groups = new Map(database.classes.map((name, group) => [name, group]));
  const hidden = query
    .getAll("hide")
    .map((name) => groups.get(name))
    .filter((group) => group !== undefined);
  if (query.has("hide-unlabelled")) hidden.push(-1);
  const camera = (query.get("at") ?? "").split(",").map(Number);
  const { subsets } = database.data;
  return {
    method: Math.max(method, 0),
    // A subset is one of the maps that were searched, whatever else the address says.
    features: subsets ? splitNames(query.get("features"), subsets.features) : [],
    view: ["class", "hit", "thumbnail"].includes(query.get("view")) ? query.get("view") : "class",
    hidden: new Set(hidden),
    selection: readSelection(query, database),
    opened: known("open")[0] ?? null,
    query: query.get("find") ?? "",
    camera:
      camera.length === 3 && camera.every(Number.isFinite) ? { x: camera[0], y: camera[1], zoom: camera[2] } : null,
  };
}

export function writeAddress(database, state) {
  const query = new URLSearchParams();
  const { base, features } = database.methods[state.get("method")];
  if (base !== 0) query.set("map", database.methods[base].key);
  if (base !== state.get("method")) query.set("features", joinNames(features));
  if (state.get("view") !== "class") query.set("view", state.get("view"));
  for (const group of state.get("hidden")) {
    if (group < 0) query.set("hide-unlabelled", "");
    else query.append("hide", database.classes[group]);
  }
  writeSelection(query, database, state.get("selection"));
  if (state.get("opened") !== null) query.set("open", database.ids[state.get("opened")]);
  if (state.get("query") !== "") query.set("find", state.get("query"));
  const camera = state.get("camera");
  if (camera) query.set("at", [camera.x, camera.y, camera.zoom].map((value) => Number(value.toPrecision(5))).join(","));
  replaceHash(query);
}

/** The address of a subset's map on the Overview. */
export function overviewAddress(names) {
  return pageAddress("index.html", { features: joinNames(names) });
}
