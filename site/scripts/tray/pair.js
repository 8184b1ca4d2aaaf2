// The two groups that a reader takes for the Compare page: one is kept, from page to page, until there is the other.

import { mark } from "../database/selection.js";

/** @import { Database } from "../database/database.js" */

/**
 * @typedef {"a" | "b"} Side
 * @typedef {{ side: Side, shapes: Set<number> }} Taken
 */

/** Pages opened by double-click may be refused storage; then what is taken lasts as long as the page. */
export class Pair {
  /** @type {Taken | null} */
  #taken = null;
  #key;

  /** @param {Database} database */
  constructor(database) {
    this.database = database;
    this.#key = `shapeviz-taken ${mark(database)}`;
    try {
      const { side, ids } = JSON.parse(sessionStorage.getItem(this.#key) ?? "null");
      this.#taken = { side, shapes: new Set(ids.map((/** @type {string} */ id) => database.indexOfId.get(id))) };
    } catch {
      this.#taken = null;
    }
  }

  get taken() {
    return this.#taken;
  }

  /**
   * Keep a group, or none with null.
   * @param {Taken | null} taken
   */
  keep(taken) {
    this.#taken = taken;
    const ids = taken && [...taken.shapes].map((index) => this.database.ids.at(index));
    try {
      if (taken) sessionStorage.setItem(this.#key, JSON.stringify({ side: taken.side, ids }));
      else sessionStorage.removeItem(this.#key);
    } catch {
      return;
    }
  }
}
