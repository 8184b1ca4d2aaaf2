// The state of the gallery in its address: filters and groups by name, so that a link stays good when the database grows.

import { pageAddress, readHash, replaceHash } from "../base/place.js";
import { NONE } from "../database/fields.js";
import { readSelection, writeSelection } from "../database/selection.js";

export const SIZES = { least: 56, usual: 148, most: 320 };

/** What each filter's parameter starts with; the key of its field follows. */
const [IS, LACKS, RANGE] = ["is.", "lacks.", "range."];

/** How the gallery is arranged where the address says nothing. */
function usual(database, fields) {
  return { group: database.separable ? (fields.active?.key ?? "") : "", sort: "", size: SIZES.usual };
}

export function readGalleryAddress(database, fields) {
  const query = readHash();
  const standard = usual(database, fields);
  const group = query.get("group");
  const sort = query.get("sort") ?? "";
  const selection = readSelection(query, database);
  const size = Number(query.get("size") ?? standard.size);
  return {
    query: query.get("find") ?? "",
    only: query.has("only") && selection.size > 0,
    filters: readFilters(query, fields),
    group: group === "" || fields.groupable.some(({ key }) => key === group) ? group : standard.group,
    sort: fields.sortable.some(({ key }) => key === sort) ? sort : standard.sort,
    down: query.has("down"),
    size: size >= SIZES.least && size <= SIZES.most ? size : standard.size,
    closed: new Set(query.getAll("closed")),
    selection,
    at: database.indexOfId.get(query.get("at")) ?? null,
  };
}

export function writeGalleryAddress(database, fields, state) {
  replaceHash(galleryQuery(database, fields, state));
}

function galleryQuery(database, fields, state) {
  const query = new URLSearchParams();
  const standard = usual(database, fields);
  if (state.get("query") !== "") query.set("find", state.get("query"));
  if (state.get("only")) query.set("only", "");
  for (const [key, filter] of state.get("filters")) writeFilter(query, fields.byKey.get(key), filter);
  if (state.get("group") !== standard.group) query.set("group", state.get("group"));
  if (state.get("sort") !== standard.sort) query.set("sort", state.get("sort"));
  if (state.get("down")) query.set("down", "");
  if (state.get("size") !== standard.size) query.set("size", state.get("size"));
  for (const key of state.get("closed")) query.append("closed", key);
  writeSelection(query, database, state.get("selection"));
  if (state.get("at") !== null) query.set("at", database.ids[state.get("at")]);
  return query;
}

function readFilters(query, fields) {
  const filters = new Map();
  for (const field of fields.filters) {
    const range = query
      .get(RANGE + field.key)
      ?.split("..")
      .map(Number);
    if (field.edges !== null && range?.length === 2 && range.every(Number.isFinite)) {
      filters.set(field.key, { low: range[0], high: range[1] });
      continue;
    }
    const values = query
      .getAll(IS + field.key)
      .map((name) => namedValue(field, name))
      .filter((value) => value !== undefined && value !== NONE);
    if (query.has(LACKS + field.key)) values.push(NONE);
    if (values.length > 0 && (field.names !== null || field.tree !== null)) filters.set(field.key, new Set(values));
  }
  return filters;
}

function writeFilter(query, field, filter) {
  if (!(filter instanceof Set)) {
    query.set(RANGE + field.key, `${filter.low}..${filter.high}`);
    return;
  }
  for (const value of filter) {
    if (value === NONE) query.set(LACKS + field.key, "");
    else query.append(IS + field.key, nameInAddress(field, value));
  }
}

/** A value by its name, a node by the names that lead to it. */
function nameInAddress(field, value) {
  return field.tree === null ? field.names[value] : field.tree.ways[value].map(encodeURIComponent).join("/");
}

function namedValue(field, name) {
  field.numberOfName ??= new Map(
    (field.tree?.nodes ?? field.names ?? []).map((_, value) => [nameInAddress(field, value), value]),
  );
  return field.numberOfName.get(name);
}

/** The address of the gallery with some shapes selected, and none but these shown. */
export function galleryOf(database, shapes) {
  const query = new URLSearchParams([["only", ""]]);
  writeSelection(query, database, shapes);
  return pageAddress("shapes.html", query);
}
