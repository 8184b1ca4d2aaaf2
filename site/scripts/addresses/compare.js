// The two groups of the Compare page, and what is looked at of them, in its address.

import { Address, choice, named, text } from "../base/address.js";
import { pageAddress } from "../base/place.js";
import { readSelection, writeSelection } from "../database/selection.js";
import { namedElsewhere, classesNamed, classNoun } from "./classes.js";
import { selected } from "./selected.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { Ways } from "../base/address.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */

/**
 * What the Compare page has in its state.
 * @typedef {"groups" | "outliers" | "classes"} CompareView
 * @typedef {object} CompareValues
 * @property {CompareView} view
 * @property {GroupSpec | null} a
 * @property {GroupSpec | null} b
 * @property {string | null} bin
 * @property {"value" | "inside" | "apart"} reading what colours show: values of the bin, what falls into it, or where the two shapes differ in all features
 * @property {number | null} of the class whose outliers are shown
 * @property {number | null} row
 * @property {number | null} column
 * @property {string} space
 *
 * @typedef {State<CompareValues & Shared>} CompareState
 */

/**
 * What a group is of: a class by its number, a cluster, what a search finds, some shapes by their numbers, or all shapes
 * that the other group does not have.
 * @typedef {{ kind: "class", group: number } | { kind: "cluster", name: string } | { kind: "search", text: string }
 *   | { kind: "shapes", shapes: Set<number> } | { kind: "rest" }} GroupSpec
 * @typedef {{ likest(): { group: number, other: number }[] }} Likest  knows the classes that are most alike, first those most so
 */

const VIEWS = ["groups", "outliers", "classes"];
const READINGS = ["value", "inside", "apart"];

/**
 * @param {Database} database
 * @param {Chunk.Comparison} data
 * @param {Likest} neighbours
 * @param {string[]} clusters names
 */
export function comparePageAddress(database, data, neighbours, clusters) {
  const ofClass = named(database.classes, classNoun(database));
  return new Address([
    selected(database),
    namedElsewhere(database),
    { name: "view", key: "view", kind: choice(VIEWS, "view"), standard: VIEWS[0], place: true, words: "the view" },
    { names: ["a", "b"], ...twoGroups(database, neighbours, clusters), place: true, words: "the two groups" },
    { name: "bin", key: "bin", kind: text, standard: null, place: true, words: "the bin" },
    { name: "reading", key: "reading", kind: choice(READINGS, "setting"), standard: READINGS[0] },
    { name: "of", key: "of", kind: ofClass, standard: null, place: true },
    { name: "row", key: "row", kind: ofClass, standard: null, place: true, often: true },
    { name: "column", key: "column", kind: ofClass, standard: null, place: true, often: true },
    { name: "space", key: "by", kind: choice(data.spaces, "map"), standard: data.spaces[0], place: true },
  ]);
}

/**
 * The address of the Compare page with two groups beside each other.
 * @param {Database} database
 * @param {GroupSpec} a
 * @param {GroupSpec} b
 */
export function compareAddress(database, a, b) {
  const query = new URLSearchParams();
  writeGroup(query, database, "a", a);
  writeGroup(query, database, "b", b);
  return pageAddress("compare.html", query);
}

/**
 * The groups go along to other pages and back. Those that the page opens with anyway are not written, so that another
 * selection, made meanwhile, is what it opens with then.
 * @param {Database} database
 * @param {Likest} neighbours
 * @param {string[]} clusters names
 * @returns {Ways}
 */
function twoGroups(database, neighbours, clusters) {
  /**
   * @param {URLSearchParams} query
   * @param {Miss} [miss]
   */
  const read = (query, miss = () => {}) => {
    let a = readGroup(query, database, clusters, "a", miss);
    const b = readGroup(query, database, clusters, "b", miss);
    if (a === null && !query.has("a")) {
      // The selection that came along from another page.
      const shapes = readSelection(query, database);
      if (shapes.size > 0) a = { kind: "shapes", shapes };
    }
    return a === null && b === null ? firstGroups(database, neighbours) : { a, b: b ?? { kind: "rest" } };
  };
  /** @param {{ a: GroupSpec | null, b: GroupSpec | null }} groups */
  const written = ({ a, b }) => {
    const query = new URLSearchParams();
    if (a === null || b === null) return query;
    writeGroup(query, database, "a", a);
    writeGroup(query, database, "b", b);
    return query;
  };
  return {
    keys: /^[ab](-select(ed)?)?$/,
    read,
    write(query, groups) {
      const own = written(groups);
      // The selection stands in the address already.
      if (own.toString() === written(read(query)).toString()) return;
      for (const [name, value] of own) query.append(name, value);
    },
  };
}

/**
 * @param {URLSearchParams} query
 * @param {Database} database
 * @param {string} name
 * @param {GroupSpec} group
 */
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

/**
 * The group that an address names; null where it names none, or one that is no longer there.
 * @param {URLSearchParams} query
 * @param {Database} database
 * @param {string[]} clusters names
 * @param {string} name
 * @param {Miss} miss
 * @returns {GroupSpec | null}
 */
function readGroup(query, database, clusters, name, miss) {
  const word = query.get(name) ?? "";
  const [kind, rest] = [word.split(":", 1)[0], word.slice(word.indexOf(":") + 1)];
  if (kind === "rest") return { kind };
  if (kind === "shapes") {
    const own = new URLSearchParams();
    for (const [key, value] of query) if (key.startsWith(`${name}-`)) own.append(key.slice(name.length + 1), value);
    const shapes = readSelection(own, database, miss);
    return shapes.size > 0 ? { kind, shapes } : null;
  }
  // Clusters that stand in for labels are the classes.
  if (kind === "class" || (kind === "cluster" && database.data.standIn)) {
    const [group] = classesNamed([rest], database, miss);
    return group === undefined ? null : { kind: "class", group };
  }
  if (kind === "cluster") {
    if (clusters.includes(rest)) return { kind, name: rest };
    if (rest !== "") miss(kind, rest);
    return null;
  }
  if (kind === "search" && rest !== "") return { kind, text: rest };
  if (kind !== "search" && word !== "") miss("group", word);
  return null;
}

/**
 * The groups that a page opens with: the two classes that are most alike, which are the hardest to tell apart.
 * @param {Database} database
 * @param {Likest} neighbours
 * @returns {{ a: GroupSpec | null, b: GroupSpec | null }}
 */
function firstGroups(database, neighbours) {
  if (database.classes.length === 0) return { a: null, b: null };
  /** @type {{ a: GroupSpec, b: GroupSpec }} */
  const single = { a: { kind: "class", group: 0 }, b: { kind: "rest" } };
  if (database.classes.length === 1) return single;
  const [pair] = neighbours.likest();
  return pair
    ? { a: { kind: "class", group: pair.group }, b: { kind: "class", group: pair.other } }
    : { a: single.a, b: { kind: "class", group: 1 } };
}
