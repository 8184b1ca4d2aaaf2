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

const NUMBERS = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"];

/**
 * A small number as a word, a larger one in figures.
 * @param {number} number
 */
export function numberWord(number) {
  return NUMBERS[number] ?? grouped(number);
}

/**
 * Thousands set apart by a narrow space at which no line breaks, as `grouped` of `pages/base.py` does.
 * @param {number} number
 */
export function grouped(number) {
  const [whole, ...decimals] = String(number).split(".");
  return [whole.replace(/\B(?=(\d{3})+$)/g, "\u202f"), ...decimals].join(".");
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

/**
 * A share in percent, short; with more digits where asked.
 * @param {number} share
 * @param {number} [more]
 */
export function percent(share, more = 0) {
  // What sums of floats miss is nothing, and has no sign.
  const value = Math.round(1e6 * share) / 1e4 + 0;
  const least = 10 ** -(more + 1);
  if (value > 0 && value < least / 2) return `<${least}\u00a0%`;
  return `${value.toFixed(value === 0 || value >= 9.95 ? more : more + 1)}\u00a0%`;
}

/**
 * A share in whole percent; all and nothing only where it is just that.
 * @param {number} share
 */
export function wholePercent(share) {
  const value = Math.round(100 * share);
  return `${share >= 1 ? 100 : share <= 0 ? 0 : value === 0 ? "<1" : Math.min(value, 99)}\u00a0%`;
}

/**
 * A number that is no share, in three digits.
 * @param {number} value
 */
export function measured(value) {
  return grouped(Number(value.toPrecision(3))).replace("-", "−");
}

/** Digits beyond those of `percent` at which two shares are told as the same. */
const MOST_DIGITS = 2;

/**
 * Shares in percent, with as many digits as tell each apart from the last one.
 * @param {...number} shares
 */
export function percents(...shares) {
  const last = shares[shares.length - 1];
  /** @param {number} digits */
  const apart = (digits) => shares.every((share) => share === last || percent(share, digits) !== percent(last, digits));
  const more = Array.from({ length: MOST_DIGITS + 1 }, (_, digits) => digits).find(apart) ?? 0;
  return shares.map((share) => percent(share, more));
}

/** Letters that go on to the left, and marks that turn the way of those after them. */
const TURNING = /[\u0590-\u08ff\u200f\u202a-\u202e\ufb1d-\ufdff\ufe70-\ufeff]/;

/**
 * A name in a sentence that is no element, as `<bdi>` has it in one: what stands beside it keeps its place.
 * @param {string} name
 */
export function isolated(name) {
  return TURNING.test(name) ? `\u2068${name}\u2069` : name;
}

/**
 * "one", "one and two", "one, two and three".
 * @param {string[]} words
 */
export function listed(words) {
  return words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words.at(-1)}`;
}

/**
 * The beginning of a sentence as it stands within one.
 * @param {string} words
 */
export function lowered(words) {
  return words.slice(0, 1).toLowerCase() + words.slice(1);
}

/**
 * Words as a sentence begins.
 * @param {string} words
 */
export function capitalised(words) {
  return words.slice(0, 1).toUpperCase() + words.slice(1);
}
