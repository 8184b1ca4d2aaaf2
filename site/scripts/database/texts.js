// Texts of very many shapes. Each is made when it is asked for: as strings of their own they would take several times the
// memory, and a browser lets the room for new objects grow by dozens of megabytes when so many are made at once.

import { entry } from "../base/entry.js";

const DECODER = new TextDecoder("utf-8", { ignoreBOM: true });

/** @type {WeakMap<Chunk.Texts, Texts>} a page may have several databases of one chunk */
const made = new WeakMap();

/**
 * The texts of a chunk.
 * @param {Chunk.Texts} data
 */
export function textsOf(data) {
  return entry(made, data, () => new Texts(data));
}

export class Texts {
  #bytes;
  #starts;

  /** @param {Chunk.Texts} data */
  constructor({ bytes, lengths }) {
    this.#bytes = bytes;
    this.length = lengths.length;
    this.#starts = new Uint32Array(this.length + 1);
    for (let index = 0; index < this.length; index += 1)
      this.#starts[index + 1] = this.#starts[index] + lengths[index] + 1;
  }

  /** @param {number} index */
  at(index) {
    return DECODER.decode(this.#bytes.subarray(this.#starts[index], this.#starts[index + 1] - 1));
  }

  /**
   * The first that is this text; -1 where none is.
   * @param {string} wanted
   */
  indexOf(wanted) {
    const bytes = new TextEncoder().encode(wanted);
    for (let index = 0; index < this.length; index += 1) {
      const start = this.#starts[index];
      if (this.#starts[index + 1] - start !== bytes.length + 1) continue;
      // Names of many begin alike.
      let place = bytes.length - 1;
      while (place >= 0 && this.#bytes[start + place] === bytes[place]) place -= 1;
      if (place < 0) return index;
    }
    return -1;
  }

  /** The numbers of all. */
  keys() {
    return this.#starts.subarray(1).keys();
  }

  /** All in one, a line each. */
  lines() {
    const bytes = this.#bytes;
    let breaks = 0;
    for (let place = 0; place < bytes.length; place += 1) if (bytes[place] === BREAK) breaks += 1;
    return breaks < this.length ? DECODER.decode(bytes) : linesOf(this);
  }

  *[Symbol.iterator]() {
    for (let index = 0; index < this.length; index += 1) yield this.at(index);
  }
}

/** What ends a line. */
const BREAK = 10;

/**
 * Texts in one, a line each, whatever is in them.
 * @param {Iterable<string>} texts
 */
export function linesOf(texts) {
  return Array.from(texts, (text) => text.replaceAll("\n", " ")).join("\n");
}
