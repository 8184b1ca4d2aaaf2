// The state of the view in the address, so that a link reproduces it. Shapes and classes by name, not by number:
// a link stays good when the database grows.

import { pageAddress, readHash, replaceHash } from "./place.js";
import { readSelection, writeSelection } from "./selection.js";

/** Names of features as one word list; spaces in a name are written so that they do not part it. */
export function joinNames(names) {
  return names.map((name) => name.replace(/[%\s]/gu, encodeURIComponent)).join(" ");
}

/** The features named in an address, in their own order. */
export function splitNames(text, features) {
  const words = new Set((text ?? "").split(" "));
  return features.filter((name) => words.has(joinNames([name])));
}

export function readAddress(model) {
  const query = readHash();
  const method = model.methods.findIndex(({ key }) => key === query.get("map"));
  const known = (name) => query.getAll(name).map((id) => model.indexOfId.get(id)).filter((index) => index !== undefined);
  const groups = new Map(model.classes.map((name, group) => [name, group]));
  const hidden = query.getAll("hide").map((name) => groups.get(name)).filter((group) => group !== undefined);
  if (query.has("hide-unlabelled")) hidden.push(-1);
  const camera = (query.get("at") ?? "").split(",").map(Number);
  const { subsets } = model.data;
  return {
    method: Math.max(method, 0),
    // A subset is one of the maps that were searched, whatever else the address says.
    features: subsets ? splitNames(query.get("features"), subsets.features) : [],
    view: ["class", "hit", "thumbnail"].includes(query.get("view")) ? query.get("view") : "class",
    hidden: new Set(hidden),
    selection: readSelection(query, model),
    opened: known("open")[0] ?? null,
    query: query.get("find") ?? "",
    camera: camera.length === 3 && camera.every(Number.isFinite) ? { x: camera[0], y: camera[1], zoom: camera[2] } : null,
  };
}

export function writeAddress(model, state) {
  const query = new URLSearchParams();
  const { base, features } = model.methods[state.get("method")];
  if (base !== 0) query.set("map", model.methods[base].key);
  if (base !== state.get("method")) query.set("features", joinNames(features));
  if (state.get("view") !== "class") query.set("view", state.get("view"));
  for (const group of state.get("hidden")) {
    if (group < 0) query.set("hide-unlabelled", "");
    else query.append("hide", model.classes[group]);
  }
  writeSelection(query, model, state.get("selection"));
  if (state.get("opened") !== null) query.set("open", model.ids[state.get("opened")]);
  if (state.get("query") !== "") query.set("find", state.get("query"));
  const camera = state.get("camera");
  if (camera) query.set("at", [camera.x, camera.y, camera.zoom].map((value) => Number(value.toPrecision(5))).join(","));
  replaceHash(query);
}

/** The Features page: the chosen subset, the greedy path, the colours of the map, and the selection. */
export function readFeaturesAddress(subsets, model) {
  const query = readHash();
  const sizes = subsets.data.greedy.map(({ s }) => s);
  const s = Number(query.get("s"));
  return {
    chosen: subsets.find(splitNames(query.get("features"), subsets.features)) ?? (subsets.labelled ? 0 : subsets.everything),
    s: query.get("s") === "none" ? null : sizes.includes(s) ? s : (sizes[0] ?? null),
    color: subsets.labelled && query.get("color") === "hit" ? "hit" : "class",
    selection: readSelection(query, model),
  };
}

export function writeFeaturesAddress(subsets, model, state) {
  const query = new URLSearchParams();
  query.set("features", joinNames(subsets.names(state.get("chosen"))));
  const sizes = subsets.data.greedy.map(({ s }) => s);
  if (state.get("s") !== (sizes[0] ?? null)) query.set("s", state.get("s") ?? "none");
  if (state.get("color") !== "class") query.set("color", state.get("color"));
  writeSelection(query, model, state.get("selection"));
  replaceHash(query);
}

/** The address of a subset's map on the Overview. */
export function overviewAddress(names) {
  return pageAddress("index.html", { features: joinNames(names) });
}
