// Shares of shapes as chunks hold them: in whole steps.

/** To the letter as SHARE_STEPS and NO_SHARE in shapeviz_report/pages/base.py. */
const STEPS = 65520;
const NONE = 65535;

/**
 * @param {Uint16Array} steps
 * @returns {(number | null)[]}
 */
export function sharesOf(steps) {
  /** @type {(number | null)[]} */
  const shares = new Array(steps.length);
  // A loop: `Array.from` with a function takes ten times as long.
  for (let index = 0; index < steps.length; index += 1)
    shares[index] = steps[index] === NONE ? null : steps[index] / STEPS;
  return shares;
}
