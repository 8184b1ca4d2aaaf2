// Names of features in an address.

/**
 * Names of features as one word list; spaces in a name are written so that they do not part it.
 * @param {string[]} names
 */
export function joinNames(names) {
  return names.map((name) => name.replace(/[%\s]/gu, encodeURIComponent)).join(" ");
}

/**
 * The features named in an address, in their own order.
 * @param {string | null} text
 * @param {string[]} features
 */
export function splitNames(text, features) {
  const words = new Set((text ?? "").split(" "));
  return features.filter((name) => words.has(joinNames([name])));
}
