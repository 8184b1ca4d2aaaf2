// What the reader has chosen. Views listen; nothing else is kept anywhere.

/** @typedef {(changed: Set<string>) => void} Listener is told the names of what changed */

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
    /** @type {Set<string>} */
    const changed = new Set();
    /** @type {Record<string, any>} */
    const values = this.#values;
    for (const [name, value] of Object.entries(patch)) {
      if (values[name] === value) continue;
      values[name] = value;
      changed.add(name);
    }
    if (changed.size === 0) return;
    for (const listener of this.#listeners) listener(changed);
  }

  /** @param {Listener} listener */
  listen(listener) {
    this.#listeners.push(listener);
  }
}
