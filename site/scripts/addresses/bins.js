// What the Bins page shows, in its address.

import { pageAddress, readHash, replaceHash } from "../base/place.js";
import { readSelection, writeSelection } from "../database/selection.js";
import { shortNames } from "./bin-names.js";

const SIZES = ["fewest", "1", "2", "3"];
const READINGS = ["value", "inside"];
const ENDS = ["most", "least"];

/** `first` is the bin that is looked at unless the address names one, and the class that it is to separate. */
export function readBinsAddress(database, bins, selection, first) {
  const query = readHash();
  const bin = bins.names.indexOf(query.get("bin"));
  const group = database.classes.indexOf(query.get("of"));
  const last = Math.max(selection.path.length - 1, 0);
  const step = query.has("step") ? Number(query.get("step")) - 1 : last;
  const shape = query.get("shape");
  return {
    size: SIZES.includes(query.get("size")) ? query.get("size") : SIZES[0],
    step: Number.isInteger(step) && step >= 0 && step <= last ? step : last,
    ...(bin >= 0 ? { bin, group: group >= 0 ? group : null } : first),
    shape: ENDS.includes(shape) ? shape : (database.indexOfId.get(query.get("id")) ?? null),
    reading: READINGS.includes(query.get("reading")) ? query.get("reading") : READINGS[0],
    selection: readSelection(query, database),
  };
}

export function writeBinsAddress(database, bins, selection, state, first) {
  const query = new URLSearchParams();
  if (state.get("size") !== SIZES[0]) query.set("size", state.get("size"));
  if (state.get("step") < selection.path.length - 1) query.set("step", state.get("step") + 1);
  const [bin, group] = [state.get("bin"), state.get("group")];
  if (bin !== first.bin || group !== first.group) {
    query.set("bin", bins.names[bin]);
    if (group !== null) query.set("of", database.classes[group]);
  }
  const shape = state.get("shape");
  if (ENDS.includes(shape)) query.set("shape", shape);
  else if (shape !== null) query.set("id", database.ids[shape]);
  if (state.get("reading") !== READINGS[0]) query.set("reading", state.get("reading"));
  writeSelection(query, database, state.get("selection"));
  replaceHash(query);
}

/** Where the Workbench shows the map of some bins. */
export function workbenchAddress(columns, features) {
  return pageAddress("workbench.html", { bins: shortNames(columns, features), map: "tsne" });
}
