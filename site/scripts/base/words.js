// Numbers and counts as a reader reads them.

/**
 * Three decimals, as all quality figures of the site; a dash for a missing value.
 * @param {number | null | undefined} value
 */
export function figure(value) {
  return value === null || value === undefined ? "–" : value.toFixed(3);
}

/**
 * "1 shape", "1 280 shapes".
 * @param {number} number
 * @param {string} one
 * @param {string} [many]
 */
export function count(number, one, many = `${one}s`) {
  return `${grouped(number)} ${number === 1 ? one : many}`;
}

/**
 * Thousands set apart by a thin space.
 * @param {number} number
 */
export function grouped(number) {
  return String(number).replace(/\B(?=(\d{3})+$)/g, "\u2009");
}

/**
 * At most `length` characters, the last one an ellipsis where something was cut.
 * @param {string} text
 * @param {number} length
 */
export function shortened(text, length) {
  const letters = Array.from(text);
  return letters.length <= length ? text : `${letters.slice(0, length - 1).join("")}…`;
}
