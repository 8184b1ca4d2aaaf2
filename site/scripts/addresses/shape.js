// What the page of a shape shows, in its address: the shape by its id, what similar means, the map, the painted bin, the
// parts of features in sight, and the selection that came along.

import { pageAddress, pushHash, readHash, replaceHash } from "../base/place.js";
import { readSelection, writeSelection } from "../database/selection.js";

/**
 * Features and bins stay text here: which ones there are is only known with the features themselves, which are large
 * and come later. `unknown` is an id that the database does not have.
 */
export function readShapeAddress(database) {
  const query = readHash();
  const id = query.get("id");
  const shape = database.indexOfId.get(id) ?? null;
  return {
    shape,
    unknown: shape === null ? id : null,
    method: Math.max(
      database.methods.findIndex(({ key }) => key === query.get("map")),
      0,
    ),
    features: query.get("features") ?? "",
    bins: query.get("bins") ?? "",
    bin: query.get("bin"),
    parts: query.get("parts") ?? "",
    selection: readSelection(query, database),
  };
}

/** Write what is shown into the address. */
export function writeShapeAddress(database, state) {
  replaceHash(shapeQuery(database, state, state.get("shape")));
}

/** The address of another shape's page, seen in the same way. */
export function shapeAddress(database, state, shape) {
  return pageAddress("shape.html", shapeQuery(database, state, shape));
}

/** Go to another shape's page, from which the way back leads here. */
export function goToShape(database, state, shape) {
  pushHash(shapeQuery(database, state, shape));
  state.set({ shape, unknown: null });
}

function shapeQuery(database, state, shape) {
  const query = new URLSearchParams();
  const id = shape === null ? state.get("unknown") : database.ids[shape];
  if (id !== null) query.set("id", id);
  if (state.get("method") > 0) query.set("map", database.methods[state.get("method")].key);
  for (const name of ["features", "bins", "bin", "parts"]) if (state.get(name)) query.set(name, state.get(name));
  writeSelection(query, database, state.get("selection"));
  return query;
}
