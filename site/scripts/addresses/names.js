// Names of features in an address.

/** @import { Miss } from "../base/missing.js" */

/**
 * Names of features as one word list; spaces in a name are written so that they do not part it.
 * @param {string[]} names
 */
export function joinNames(names) {
  return names.map((name) => name.replace(/[%\s]/gu, encodeURIComponent)).join(" ");
}

/**
 * The features named in an address, in their own order. Other pages may have more of them, which are `known` all the same.
 * @param {string | null} text
 * @param {string[]} features
 * @param {Miss} [miss]
 * @param {string[]} [known]
 */
export function splitNames(text, features, miss = () => {}, known = features) {
  const words = wordsOf(text);
  const there = new Set(known.map((name) => joinNames([name])));
  for (const word of words) if (!there.has(word)) miss("feature", asNamed(word));
  return features.filter((name) => words.has(joinNames([name])));
}

/** @param {string | null} text */
export function wordsOf(text) {
  return new Set((text ?? "").split(" ").filter(Boolean));
}

/**
 * A word of an address as `joinNames` was given it.
 * @param {string} word
 */
export function asNamed(word) {
  try {
    return decodeURIComponent(word);
  } catch {
    return word;
  }
}
