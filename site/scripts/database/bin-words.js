// Bins by what they are in words: their plain names, what small and large values mean, what their feature looks at, and
// their definitions. What says it plainly goes before what says it exactly, and the end of a scale that is asked for
// before the rest of it.

import { pause } from "../base/dom.js";
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

/** In milliseconds: less than a reader notices, and much more than a dimension takes. */
const STEP = 20;

export class BinWords {
  /** By each word, what it says of the columns: only what is said of any. */
  /** @type {Map<string, Map<number, number>>} */
  #said = new Map();

  /** @type {Generator<void>} */
  #learning;

  /** @type {Told["features"]} */
  #features;

  /** @param {Told} told */
  constructor(told) {
    this.#features = told.features;
    this.ease = told.features.flatMap(({ dimensions, bins, ease }) => Array(dimensions * bins).fill(ease));
    this.#learning = this.#learn(told);
  }

  /** The words that one may look for bins by, in the order of the alphabet. */
  listed() {
    return [...new Set(this.#features.flatMap(({ sought }) => wordsOf(sought.flat().join(" "))))].sort();
  }

  /** Learn what is said of the bins before it is asked for, in steps between which the page answers. */
  async prepare() {
    let until = performance.now() + STEP;
    while (!this.#learning.next().done) {
      if (performance.now() < until) continue;
      await pause();
      until = performance.now() + STEP;
    }
  }

  /**
   * A dimension at a time.
   * @param {Told} told
   */
  *#learn({ features, called, sentences }) {
    for (const feature of features) {
      const { start, dimensions, bins } = feature;
      const own = wordsOf(`${feature.title} ${feature.aspect} ${feature.measures}`);
      for (let dimension = 0; dimension < dimensions; dimension += 1) {
        const [low, high] = feature.sought[dimension];
        const ends = [wordsOf(`${feature.lowMeans} ${low}`), wordsOf(`${feature.highMeans} ${high}`)];
        for (let place = 0; place < bins; place += 1) {
          const column = start + dimension * bins + place;
          this.#say(column, wordsOf(called[column]), NAME);
          this.#say(column, wordsOf(sentences[column]), DEFINITION);
          this.#say(column, own, FEATURE);
          // From -1 at the low end to 1 at the high one.
          const height = bins > 1 ? (2 * place) / (bins - 1) - 1 : 0;
          if (height !== 0) this.#say(column, ends[Number(height > 0)], END * (1 + Math.abs(height)));
          // What is a value of its own, and no end of a scale, is looked for whatever its size.
          if (bins === 1) this.#say(column, ends[1], END);
        }
        yield;
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
    while (!this.#learning.next().done);
    const words = wordsOf(text).map((word) => this.#saidBy(word));
    if (words.length === 0) return [];
    const worth = this.ease.map((ease, column) =>
      words.every((said) => said[column] > 0) ? ease * words.reduce((sum, said) => sum + said[column], 0) : 0,
    );
    const found = [...worth.keys()].filter((column) => worth[column] > 0);
    return found.sort((one, other) => worth[other] - worth[one] || one - other);
  }

  /**
   * What a word says of each column.
   * @param {string} word
   */
  #saidBy(word) {
    const all = new Float64Array(this.ease.length);
    for (const [known, said] of this.#said) {
      if (!isMeant(word, known)) continue;
      for (const [column, worth] of said) if (worth > all[column]) all[column] = worth;
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
