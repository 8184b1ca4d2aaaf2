// What the reader has chosen. Views listen; nothing else is kept anywhere.

export class State {
  #values;
  #listeners = [];

  constructor(values) {
    this.#values = values;
  }

  get(name) {
    return this.#values[name];
  }

  /** Change some values; every listener hears which ones really changed. */
  set(patch) {
    const changed = new Set();
    for (const [name, value] of Object.entries(patch)) {
      if (this.#values[name] === value) continue;
      this.#values[name] = value;
      changed.add(name);
    }
    if (changed.size === 0) return;
    for (const listener of this.#listeners) listener(changed);
  }

  listen(listener) {
    this.#listeners.push(listener);
  }
}
