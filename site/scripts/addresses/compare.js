// The two groups of the Compare page in its address, each by name: a link stays good when the database grows.

import { pageAddress, readHash, replaceHash } from "../base/place.js";
import { readSelection, writeSelection } from "../database/selection.js";

/**
 * The address of the Compare page with two groups beside each other. A group is one of
 *
 * - `{ kind: "class", group }`, a class by its number
 * - `{ kind: "cluster", name }`
 * - `{ kind: "search", text }`, the shapes that a search finds
 * - `{ kind: "shapes", shapes }`, a set of shapes by their numbers
 * - `{ kind: "rest" }`, all shapes that the other group does not have.
 */
export function compareAddress(database, a, b) {
  const query = new URLSearchParams();
  writeGroups(query, database, a, b);
  return pageAddress("compare.html", query);
}

/** Add two groups to the parameters of an address. */
function writeGroups(query, database, a, b) {
  writeGroup(query, database, "a", a);
  writeGroup(query, database, "b", b);
}

/** The groups that an address names, `{ a, b }`; null for one that it does not name, or that is no longer there. */
function readCompareAddress(query, database) {
  const [a, b] = [readGroup(query, database, "a"), readGroup(query, database, "b")];
  if (a !== null || query.has("a")) return { a, b };
  // The selection that came along from another page.
  const shapes = readSelection(query, database);
  return { a: shapes.size > 0 ? { kind: "shapes", shapes } : null, b };
}

function writeGroup(query, database, name, group) {
  if (group.kind === "class") query.set(name, `class:${database.classes[group.group]}`);
  else if (group.kind === "cluster") query.set(name, `cluster:${group.name}`);
  else if (group.kind === "search") query.set(name, `search:${group.text}`);
  else query.set(name, group.kind);
  if (group.kind !== "shapes") return;
  const own = new URLSearchParams();
  writeSelection(own, database, group.shapes);
  for (const [key, value] of own) query.append(`${name}-${key}`, value);
}

function readGroup(query, database, name) {
  const text = query.get(name) ?? "";
  const [kind, rest] = [text.split(":", 1)[0], text.slice(text.indexOf(":") + 1)];
  if (kind === "rest") return { kind };
  if (kind === "shapes") {
    const own = new URLSearchParams();
    for (const [key, value] of query) if (key.startsWith(`${name}-`)) own.append(key.slice(name.length + 1), value);
    const shapes = readSelection(own, database);
    return shapes.size > 0 ? { kind, shapes } : null;
  }
  if (kind === "class") {
    const group = database.classes.indexOf(rest);
    return group >= 0 ? { kind, group } : null;
  }
  if (kind === "cluster") return { kind, name: rest };
  return kind === "search" && rest !== "" ? { kind, text: rest } : null;
}

const VIEWS = ["groups", "outliers", "classes"];
const READINGS = ["value", "inside"];

/** What the page shows: the two groups and what is looked at. */
export function readView(database, data, neighbours) {
  const query = readHash();
  const groups = readCompareAddress(query, database);
  const group = (name) => {
    const place = database.classes.indexOf(query.get(name));
    return place < 0 ? null : place;
  };
  return {
    view: VIEWS.includes(query.get("view")) ? query.get("view") : VIEWS[0],
    ...(groups.a === null && groups.b === null
      ? firstGroups(database, neighbours)
      : { a: groups.a, b: groups.b ?? { kind: "rest" } }),
    bin: query.get("bin"),
    reading: READINGS.includes(query.get("reading")) ? query.get("reading") : READINGS[0],
    of: group("of"),
    space: data.spaces.includes(query.get("by")) ? query.get("by") : data.spaces[0],
    row: group("row"),
    column: group("column"),
    selection: readSelection(query, database),
  };
}

export function writeView(database, state) {
  const query = new URLSearchParams();
  if (state.get("view") !== VIEWS[0]) query.set("view", state.get("view"));
  const [a, b] = [state.get("a"), state.get("b")];
  if (a !== null && b !== null) writeGroups(query, database, a, b);
  if (state.get("bin") !== null) query.set("bin", state.get("bin"));
  if (state.get("reading") !== READINGS[0]) query.set("reading", state.get("reading"));
  for (const name of ["of", "row", "column"])
    if (state.get(name) !== null) query.set(name, database.classes[state.get(name)]);
  if (state.get("space") !== "features") query.set("by", state.get("space"));
  writeSelection(query, database, state.get("selection"));
  replaceHash(query);
}

/** The groups that a page opens with: the two classes that are most alike, which are the hardest to tell apart. */
function firstGroups(database, neighbours) {
  if (database.classes.length === 0) return { a: null, b: null };
  const single = { a: { kind: "class", group: 0 }, b: { kind: "rest" } };
  if (database.classes.length === 1) return single;
  const [pair] = neighbours.likest();
  return pair
    ? { a: { kind: "class", group: pair.group }, b: { kind: "class", group: pair.other } }
    : { a: single.a, b: { kind: "class", group: 1 } };
}
