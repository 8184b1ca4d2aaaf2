// Shares of shapes as chunks hold them: in whole steps.

/** To the letter as SHARE_STEPS and NO_SHARE in shapeviz_report/pages/base.py. */
const STEPS = 65520;
const NONE = 65535;

/**
 * @param {Uint16Array} steps
 * @returns {(number | null)[]}
 */
export function sharesOf(steps) {
  return Array.from(steps, (step) => (step === NONE ? null : step / STEPS));
}
