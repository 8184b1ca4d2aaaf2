// Bins by what they are in words: their plain names, what small and large values mean, what their feature looks at, and
// their definitions. What says it plainly goes before what says it exactly, and the end of a scale that is asked for
// before the rest of it.

import { entry } from "../base/entry.js";

/**
 * What is known of the bins, in words.
 * @typedef {Pick<Chunk.Workbench, "features" | "called" | "sentences">} Told
 */

/** How much a word says of a bin by where it stands; at the end of a scale up to twice as much as in its middle. */
const NAME = 3;
const END = 2;
const FEATURE = 1;
const DEFINITION = 0.5;

/** From so many letters on, a word that goes on otherwise still means the same: "bumpy" a "bump". */
const STEM = 4;
const ENDING = 3;

export class BinWords {
  /** By each word, what it says of the columns: only what is said of any. */
  /** @type {Map<string, Map<number, number>>} */
  #said = new Map();

  /** @param {Told} told */
  constructor({ features, called, sentences }) {
    this.features = features;
    this.ease = features.flatMap(({ dimensions, bins, ease }) => Array(dimensions * bins).fill(ease));
    for (const [column, text] of called.entries()) this.#say(column, wordsOf(text), NAME);
    for (const [column, text] of sentences.entries()) this.#say(column, wordsOf(text), DEFINITION);
    for (const feature of features) {
      const { start, dimensions, bins } = feature;
      const own = wordsOf(`${feature.title} ${feature.aspect} ${feature.measures}`);
      for (let dimension = 0; dimension < dimensions; dimension += 1) {
        const [low, high] = feature.sought[dimension];
        const ends = [wordsOf(`${feature.lowMeans} ${low}`), wordsOf(`${feature.highMeans} ${high}`)];
        for (let place = 0; place < bins; place += 1) {
          const column = start + dimension * bins + place;
          this.#say(column, own, FEATURE);
          // From -1 at the low end to 1 at the high one.
          const height = bins > 1 ? (2 * place) / (bins - 1) - 1 : 0;
          if (height !== 0) this.#say(column, ends[Number(height > 0)], END * (1 + Math.abs(height)));
        }
      }
    }
  }

  /**
   * @param {number} column
   * @param {string[]} words
   * @param {number} worth
   */
  #say(column, words, worth) {
    for (const word of words) {
      const said = entry(this.#said, word, () => new Map());
      said.set(column, Math.max(said.get(column) ?? 0, worth));
    }
  }

  /**
   * The columns of which all words of a text are said, those first of which they say most.
   * @param {string} text
   * @returns {number[]}
   */
  find(text) {
    const [first, ...rest] = wordsOf(text).map((word) => this.#saidBy(word));
    if (first === undefined) return [];
    /** @type {Map<number, number>} */
    const found = new Map();
    for (const [column, worth] of first) {
      const all = rest.map((said) => said.get(column) ?? 0);
      if (all.every(Boolean)) found.set(column, this.ease[column] * all.reduce((a, b) => a + b, worth));
    }
    return [...found].sort(([one, a], [other, b]) => b - a || one - other).map(([column]) => column);
  }

  /** @param {string} word */
  #saidBy(word) {
    /** @type {Map<number, number>} */
    const all = new Map();
    for (const [known, said] of this.#said) {
      if (!isMeant(word, known)) continue;
      for (const [column, worth] of said) all.set(column, Math.max(all.get(column) ?? 0, worth));
    }
    return all;
  }
}

/**
 * Whether one who types a word, or begins to, means another.
 * @param {string} word
 * @param {string} known
 */
function isMeant(word, known) {
  return (
    known.startsWith(word) || (known.length >= STEM && word.length - known.length <= ENDING && word.startsWith(known))
  );
}

/** @param {string} text */
function wordsOf(text) {
  return [...new Set(text.toLowerCase().match(/[\p{L}\p{N}.°%−<>]+/gu) ?? [])].map((word) => word.replace(/\.$/, ""));
}
