// The two groups: who belongs to them, what they are called, and how they are marked.

import { swatch } from "../base/dom.js";
import { count, grouped, isolated, shortened } from "../base/words.js";
import { inSentence } from "../database/kind.js";
import { findWords, searchTexts } from "../database/search.js";

/** @import { GroupSpec } from "../addresses/compare.js" */
/** @import { Database } from "../database/database.js" */

/**
 * @typedef {"a" | "b"} Side
 *
 * How a group is called and marked.
 * @typedef {object} Look
 * @property {GroupSpec} spec
 * @property {Side} side
 * @property {string} name within a sentence
 * @property {string} label where it stands alone
 * @property {() => string} color
 * @property {() => SVGElement} mark
 *
 * @typedef {Look & { shapes: number[] }} Group
 */

const LONGEST = 40;

export class Groups {
  /**
   * @param {Database} database
   * @param {Chunk.Clusters | null} clusters
   */
  constructor(database, clusters) {
    this.database = database;
    // Clusters that stand in for labels are the classes already.
    this.clusters = clusters !== null && !clusters.standIn ? clusters : null;
  }

  /**
   * Two groups with their shapes: `{ a, b, common }`, where `common` is the number of shapes that both would have had;
   * the smaller group keeps them. A group is null where the address names none.
   * @param {GroupSpec | null} a
   * @param {GroupSpec | null} b
   * @returns {Promise<{ a: Group | null, b: Group | null, common: number }>}
   */
  async resolve(a, b) {
    const [first, second] = await Promise.all([this.#shapes(a), this.#shapes(b)]);
    /**
     * @param {number[] | null} shapes
     * @param {number[] | null} other
     */
    const known = (shapes, other) => shapes ?? this.#rest(other);
    const given = a && known(first, b?.kind === "rest" ? null : second);
    const otherwise = b && known(second, a?.kind === "rest" ? null : first);
    let [own, others] = [given ?? [], otherwise ?? []];
    let common = 0;
    if (a && b) {
      const theirs = new Set(others);
      const shared = new Set(own.filter((shape) => theirs.has(shape)));
      common = shared.size;
      if (common > 0 && own.length <= others.length) others = others.filter((shape) => !shared.has(shape));
      else if (common > 0) own = own.filter((shape) => !shared.has(shape));
    }
    return {
      a: a && { ...this.#look(a, "a", b), shapes: own },
      b: b && { ...this.#look(b, "b", a), shapes: others },
      common,
    };
  }

  /**
   * The shapes of a group, rising; null for the rest.
   * @param {GroupSpec | null} spec
   * @returns {Promise<number[] | null>}
   */
  async #shapes(spec) {
    const { database } = this;
    /** @param {(index: number) => boolean} holds */
    const where = (holds) => [...database.ids.keys()].filter(holds);
    switch (spec?.kind) {
      case "class":
        return where((index) => database.groups[index] === spec.group);
      case "cluster": {
        const { clusters, of } = this.clusters ?? { clusters: [], of: [] };
        const place = clusters.findIndex(({ name }) => name === spec.name);
        return place < 0 ? [] : where((index) => of[index] === place);
      }
      case "search":
        return findWords(await searchTexts(database), spec.text);
      case "shapes":
        return [...spec.shapes].sort((one, other) => one - other);
      default:
        return null;
    }
  }

  /** @param {number[] | null} other */
  #rest(other) {
    const taken = new Set(other ?? []);
    return [...this.database.ids.keys()].filter((index) => !taken.has(index));
  }

  /**
   * Name and mark of a group. A class keeps its colour; other groups have that of their side.
   * @param {GroupSpec} spec
   * @param {Side} side
   * @param {GroupSpec | null} other
   * @returns {Look}
   */
  #look(spec, side, other) {
    const { database } = this;
    const own = spec.kind === "class";
    const color = () =>
      own
        ? database.color(spec.group)
        : spec.kind === "rest"
          ? "var(--quiet)"
          : `var(--${side === "a" ? "accent" : "warn"})`;
    const name = nameOf(spec, database, { side, other });
    return {
      spec,
      side,
      name,
      label: spec.kind === "cluster" ? spec.name : own ? database.className(spec.group) : name,
      color,
      mark: () => swatch(own ? database.symbol(spec.group) : database.data.marks.plain, color()),
    };
  }
}

/**
 * The name of a group within a sentence; of two that are of selected shapes, it says which side each of them is.
 * @param {GroupSpec} spec
 * @param {Database} database
 * @param {{ side: Side, other: GroupSpec | null } | null} [among]
 */
export function nameOf(spec, database, among = null) {
  if (spec.kind === "class") return groupName(database, spec.group);
  // A cluster is called "like ant 03".
  if (spec.kind === "cluster") return `those ${isolated(shortened(spec.name, LONGEST))}`;
  if (spec.kind === "search") return `“${isolated(shortened(spec.text, LONGEST))}”`;
  if (spec.kind === "rest") return "the other shapes";
  const words = selectionName(spec.shapes, database);
  const single = spec.shapes.size === 1;
  if (among?.other?.kind === "shapes" && !(single && words !== selectionName(among.other.shapes, database)))
    return `${among.side.toUpperCase()}: ${isolated(words)}`;
  return single ? words : "the selected shapes";
}

/**
 * "8 fish", where all shapes are of one class, else "8 shapes"; a single one by its name.
 * @param {Set<number>} shapes
 * @param {Database} database
 */
function selectionName(shapes, database) {
  const [first] = shapes;
  if (shapes.size === 1) return shortened(database.names.at(first), LONGEST);
  const [[group], ...others] = database.census(shapes);
  return group < 0 || others.length > 0
    ? count(shapes.size, "shape")
    : `${grouped(shapes.size)} ${isolated(shortened(database.className(group), LONGEST))}`;
}

/**
 * The name of a class within a sentence, or of a cluster that stands in for one: "those like ant 03".
 * @param {Database} database
 * @param {number} group
 */
export function groupName(database, group) {
  const name = shortened(database.className(group), LONGEST);
  return group >= 0 ? inSentence(database, name) : name;
}

/**
 * Whether two descriptions mean the same group.
 * @param {GroupSpec | null} one
 * @param {GroupSpec | null} other
 */
export function isSame(one, other) {
  return key(one) === key(other);
}

/** @param {GroupSpec | null} spec */
function key(spec) {
  return spec === null
    ? ""
    : JSON.stringify({ ...spec, shapes: "shapes" in spec && [...spec.shapes].sort((a, b) => a - b) });
}
