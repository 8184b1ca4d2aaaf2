// What the reader has chosen. Views listen; nothing else is kept anywhere.

/** @typedef {(changed: Set<string>, before: Map<string, any>) => void} Listener is told the names of what changed, and what it was */

/** @template {Record<string, any>} [Values=any] */
export class State {
  /** @type {Values} */
  #values;
  /** @type {Listener[]} */
  #listeners = [];

  /** @param {Values} values by name */
  constructor(values) {
    this.#values = values;
  }

  /**
   * @template {keyof Values} Name
   * @param {Name} name
   * @returns {Values[Name]}
   */
  get(name) {
    return this.#values[name];
  }

  /**
   * Change some values; every listener hears which ones really changed.
   * @param {Partial<Values>} patch
   */
  set(patch) {
    /** @type {Map<string, any>} */
    const before = new Map();
    /** @type {Record<string, any>} */
    const values = this.#values;
    for (const [name, value] of Object.entries(patch)) {
      if (values[name] === value) continue;
      before.set(name, values[name]);
      values[name] = value;
    }
    if (before.size === 0) return;
    const changed = new Set(before.keys());
    for (const listener of this.#listeners) listener(changed, before);
  }

  /** @param {Listener} listener */
  listen(listener) {
    this.#listeners.push(listener);
  }
}
