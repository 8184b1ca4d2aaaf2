// The nearest neighbours of every shape, in the space of all features and on every map.

import { part } from "../base/chunks.js";
import { entry } from "../base/entry.js";

/** @import { Database } from "../database/database.js" */

export class Neighbours {
  /**
   * `comparison` is the chunk "compare".
   * @param {Database} database
   * @param {Chunk.Comparison} comparison
   */
  constructor(database, { k, spaces }) {
    this.database = database;
    this.k = k;
    this.spaces = spaces;
  }

  /** @type {Map<string, Uint32Array>} by space, as many of each shape */
  #rows = new Map();
  /** @type {Map<string, number[][]>} */
  #matrices = new Map();

  /**
   * Have the neighbours in a space at hand.
   * @param {string} [space]
   */
  async know(space = this.spaces[0]) {
    if (!this.#rows.has(space))
      this.#rows.set(space, new Uint32Array(await part("neighbours", this.spaces.indexOf(space))));
  }

  /** Whether all other shapes are neighbours of each, so that who they are says nothing. */
  get ofAll() {
    return this.k >= this.database.count - 1;
  }

  /**
   * Of one shape, nearest first.
   * @param {number} index
   * @param {any} [space]
   */
  of(index, space = this.spaces[0]) {
    const rows = /** @type {Uint32Array} */ (this.#rows.get(space));
    return rows.subarray(index * this.k, (index + 1) * this.k);
  }

  /**
   * Of the neighbours of some shapes, the share that belongs to others; null without neighbours.
   * @param {number[]} shapes
   * @param {number[]} others
   * @param {any} [space]
   */
  between(shapes, others, space = this.spaces[0]) {
    if (this.k === 0 || shapes.length === 0) return null;
    const wanted = new Set(others);
    let found = 0;
    for (const index of shapes) for (const other of this.of(index, space)) if (wanted.has(other)) found += 1;
    return found / (shapes.length * this.k);
  }

  /**
   * How many neighbours of a shape of each class (rows) belong to each class (columns).
   * @param {string} space
   */
  matrix(space) {
    // The address of the page asks for it again and again.
    return entry(this.#matrices, space, () => {
      const { classes, groups } = this.database;
      const counts = classes.map(() => new Array(classes.length).fill(0));
      for (const [index, group] of groups.entries()) {
        if (group < 0) continue;
        for (const other of this.of(index, space)) if (groups[other] >= 0) counts[group][groups[other]] += 1;
      }
      return counts;
    });
  }

  /**
   * Pairs of classes whose shapes are each other's neighbours, the most alike first: `share` is the mean of the shares
   * of the neighbours of the one that belong to the other, and the other way round.
   */
  likest(space = this.spaces[0]) {
    const counts = this.matrix(space);
    const shares = counts.map((row, group) =>
      row.map((number) => number / ((this.database.sizes.get(group) ?? 0) * this.k)),
    );
    const pairs = [];
    for (let group = 0; group < counts.length; group += 1) {
      for (let other = group + 1; other < counts.length; other += 1) {
        const [there, back] = [shares[group][other], shares[other][group]];
        if (there + back > 0) pairs.push({ group, other, there, back, share: (there + back) / 2 });
      }
    }
    return pairs.sort((a, b) => b.share - a.share || a.group - b.group || a.other - b.other);
  }

  /**
   * The pairs behind a cell: shapes of a class with those of their neighbours that belong to another.
   * @param {number} group
   * @param {number} other
   * @param {string} space
   */
  pairs(group, other, space) {
    const { database } = this;
    const found = [];
    for (const [index, own] of database.groups.entries()) {
      if (own !== group) continue;
      const near = [...this.of(index, space)].filter((neighbour) => database.groups[neighbour] === other);
      if (near.length > 0) found.push({ index, near });
    }
    return found.sort((a, b) => b.near.length - a.near.length || a.index - b.index);
  }
}
