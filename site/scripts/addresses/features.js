// The state of the Features page in its address.

import { readHash, replaceHash } from "../base/place.js";
import { readSelection, writeSelection } from "../database/selection.js";
import { joinNames, splitNames } from "./names.js";

/** The chosen subset, the greedy path, the colours of the map, and the selection. */
export function readFeaturesAddress(subsets, database) {
  const query = readHash();
  const sizes = subsets.data.greedy.map(({ s }) => s);
  const s = Number(query.get("s"));
  return {
    chosen:
      subsets.find(splitNames(query.get("features"), subsets.features)) ?? (subsets.labelled ? 0 : subsets.everything),
    s: query.get("s") === "none" ? null : sizes.includes(s) ? s : (sizes[0] ?? null),
    color: subsets.labelled && query.get("color") === "hit" ? "hit" : "class",
    selection: readSelection(query, database),
  };
}

export function writeFeaturesAddress(subsets, database, state) {
  const query = new URLSearchParams();
  query.set("features", joinNames(subsets.names(state.get("chosen"))));
  const sizes = subsets.data.greedy.map(({ s }) => s);
  if (state.get("s") !== (sizes[0] ?? null)) query.set("s", state.get("s") ?? "none");
  if (state.get("color") !== "class") query.set("color", state.get("color"));
  writeSelection(query, database, state.get("selection"));
  replaceHash(query);
}
