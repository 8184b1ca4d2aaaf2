// What shapes can be grouped, filtered and sorted by: the database's own fields, and the neighbourhood hit on each map.

import { grouped } from "../base/words.js";
import { highestOf } from "./hit-range.js";

/** @import { Database } from "./database.js" */

/**
 * One with values, of a range of numbers, and one of a tree.
 * @typedef {Field & { names: string[], of: Int32Array }} ChoiceField
 * @typedef {Field & { numbers: Float64Array, edges: number[] }} RangeField
 * @typedef {Field & { tree: Chunk.Tree & { ways: string[][] } }} TreeField
 */

/**
 * What shapes can be grouped, filtered and sorted by: a field of the database, a tree of folders, or a hit on a map.
 * @typedef {object} OwnField
 * @property {FieldTree | null} tree of which it is the finest level
 * @property {number[]} [groups] the classes that the values of the active labels are
 * @property {boolean} [hit] whether it is a neighbourhood hit
 * @property {(row: number) => number | null} [highest] what a hit can be
 * @property {Map<string, number>} [numberOfName] values by their names in an address
 *
 * @typedef {Chunk.Field & OwnField} Field
 * @typedef {Chunk.Tree & { ways: string[][] }} FieldTree with the names from the top down to each of its nodes
 */

const HIT_EDGES = [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1];

/** Milliseconds. */
const DAY = 86_400_000;

/** What stands for "no value" among the numbers of values. */
export const NONE = -1;

export class Fields {
  /**
   * @param {Database} database
   * @param {Chunk.Fields} fields
   * @param {Chunk.Hierarchy} hierarchy
   */
  constructor(database, { byName, fields }, { trees }) {
    this.byName = byName;
    // A tree of one level is a list.
    const deep = trees
      .map((tree) => ({ ...tree, ways: ways(tree.nodes) }))
      .filter(({ key, nodes }) => key === "folders" || nodes.some(({ parent }) => parent >= 0));
    /** @type {Field[]} */
    const own = fields.map((field) => ({ ...field, tree: deep.find(({ key }) => key === field.key) ?? null }));
    const folders = deep
      .filter(({ key }) => key === "folders")
      .map((tree) => ({ ...NOTHING, key: tree.key, title: tree.title, tree }));
    const measured = own.filter(({ key }) => key.startsWith("fact:"));
    const given = own.filter((field) => !measured.includes(field));
    /** @type {Field[]} */
    this.all = [...given, ...folders, ...hits(database), ...kept(database), ...measured];
    this.byKey = new Map(this.all.map((field) => [field.key, field]));
    this.active = this.all.find(({ active }) => active) ?? null;
    // Classes stand in the order that people sort by, and the database numbers them in another.
    if (this.active) this.active.groups = this.active.names?.map((name) => database.classes.indexOf(name));
  }

  /** Those that make groups: few values, or intervals. */
  get groupable() {
    return this.all.filter(({ names, edges }) => names !== null || edges !== null);
  }

  /** Those that put shapes in an order, beside their names. */
  get sortable() {
    return this.all.filter(({ active, numbers }) => active || numbers !== null);
  }

  /** Those that a reader can filter by, trees first. */
  get filters() {
    const all = this.all.filter(({ tree, names, edges }) => tree !== null || names !== null || edges !== null);
    return [...all.filter(first), ...all.filter((field) => !first(field))];
  }
}

/** @param {Field} field */
const first = ({ active, tree }) => active || tree !== null;

/** @type {Omit<Field, "key" | "title">} */
const NOTHING = {
  unit: "",
  active: false,
  date: false,
  names: null,
  of: null,
  notes: null,
  numbers: null,
  edges: null,
  tree: null,
};

/**
 * Numbers of the shapes, no numbers where there are none.
 * @param {ArrayLike<number | null>} values
 */
function column(values) {
  return Float64Array.from(values, (value) => value ?? Number.NaN);
}

/**
 * @param {Database} database
 * @returns {Field[]}
 */
function hits(database) {
  if (!database.separable) return [];
  return database.methods.map((method) => ({
    ...NOTHING,
    key: `nh:${method.key}`,
    title: `NH on the ${method.title} map`,
    numbers: column(method.hit),
    edges: HIT_EDGES,
    hit: true,
    highest: (row) => highestOf(database, method, row),
  }));
}

/**
 * Of each map, the share of a shape's true neighbours that are near it there.
 * @param {Database} database
 * @returns {Field[]}
 */
function kept(database) {
  return database.methods.flatMap(({ key, title, faith }) =>
    !faith?.kept
      ? []
      : [
          {
            ...NOTHING,
            key: `kept:${key}`,
            title: `Neighbours kept on the ${title} map`,
            numbers: column(faith.kept),
            edges: HIT_EDGES,
          },
        ],
  );
}

/**
 * The names from the top of a tree down to each of its nodes.
 * @param {Chunk.TreeNode[]} nodes
 */
function ways(nodes) {
  /** @type {string[][]} */
  const found = [];
  for (const { name, parent } of nodes) found.push(parent < 0 ? [name] : [...found[parent], name]);
  return found;
}

/**
 * The words for a value of a field of names.
 * @param {Field} field
 * @param {number} value
 */
export function valueName(field, value) {
  if (value !== NONE) return field.names?.[value] ?? "";
  return field.active || field.key.startsWith("label:") ? "no label" : `no ${field.title}`;
}

/**
 * The class that a value of the active labels is, by which it is marked; null for a value of another field.
 * @param {Field} field
 * @param {number} value
 */
export function groupOf({ active, groups }, value) {
  if (!active) return null;
  return value === NONE || !groups ? NONE : groups[value];
}

/**
 * A number with as many digits as tell shapes apart.
 * @param {number | null | undefined} number
 * @param {{ hit?: boolean, date?: boolean }} [field]
 */
export function numberText(number, { hit = false, date = false } = {}) {
  if (number === null || number === undefined || Number.isNaN(number)) return "–";
  if (date) return new Date(number * DAY).toISOString().replace(/T.*/, "");
  if (hit) return number.toFixed(3);
  const size = Math.abs(number);
  if (size !== 0 && (size >= 1e7 || size < 1e-3))
    return number
      .toExponential(2)
      .replace(/\.?0+e/, "e")
      .replace("e+", "e");
  // Four digits may be those of a year.
  if (Number.isInteger(number) && size < 10000) return String(number);
  const rounded = size >= 1000 ? Math.round(number) : Number(number.toPrecision(4));
  return size >= 10000 ? grouped(rounded) : String(rounded);
}
