// Shares of shapes as chunks hold them: in whole steps.

import { entry } from "../base/entry.js";

/** To the letter as SHARE_STEPS and NO_SHARE in shapeviz_report/pages/base.py. */
const STEPS = 65520;
const NONE = 65535;

/** @type {WeakMap<Uint16Array, (number | null)[]>} a page may have several databases of one chunk */
const made = new WeakMap();

/**
 * @param {Uint16Array} steps
 * @returns {(number | null)[]} never to be changed
 */
export function sharesOf(steps) {
  return entry(made, steps, () => makeShares(steps));
}

/** @param {Uint16Array} steps */
function makeShares(steps) {
  /** @type {(number | null | undefined)[]} each number once, however many shapes have it */
  const known = new Array(NONE + 1);
  known[NONE] = null;
  /** @type {(number | null)[]} */
  const shares = new Array(steps.length);
  // A loop: `Array.from` with a function takes ten times as long.
  for (let index = 0; index < steps.length; index += 1) {
    const step = steps[index];
    let share = known[step];
    if (share === undefined) {
      share = step / STEPS;
      known[step] = share;
    }
    shares[index] = share;
  }
  return shares;
}
