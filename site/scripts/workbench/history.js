// The steps of the work, for undo, redo and the strip of small maps. A step is what undo takes back: the classes, the
// features and the bins in use. It keeps the maps that were made for it.

/** @import { ShapeMap } from "../database/database.js" */

/**
 * What is in use at a step, and the maps of it as far as they are made.
 * @typedef {object} Use
 * @property {Set<number>} hidden classes that are not
 * @property {Set<number>} features
 * @property {Set<number>} bins
 *
 * @typedef {Use & { originalMap: ShapeMap | null, refinedMap: ShapeMap | null }} Step
 */

const MOST_STEPS = 200;

export class History {
  /** @type {Step[]} */
  steps = [];
  at = -1;

  get current() {
    return this.steps[this.at];
  }

  get canUndo() {
    return this.at > 0;
  }

  get canRedo() {
    return this.at < this.steps.length - 1;
  }

  /**
   * A new step after the current one; what had been undone is gone.
   * @param {Step} step
   */
  push(step) {
    this.steps.length = this.at + 1;
    this.steps.push(step);
    if (this.steps.length > MOST_STEPS) this.steps.shift();
    this.at = this.steps.length - 1;
  }

  /**
   * The step nearest to the current one that has the same classes, features and bins; -1 if there is none.
   * @param {Use} step
   */
  find(step) {
    let best = -1;
    for (const [place, other] of this.steps.entries()) {
      if (alike(step, other) && (best < 0 || Math.abs(place - this.at) < Math.abs(best - this.at))) best = place;
    }
    return best;
  }
}

/**
 * Whether two steps have the same classes, features and bins.
 * @param {Use} one
 * @param {Use} other
 */
export function alike(one, other) {
  return /** @type {(keyof Use)[]} */ (["hidden", "features", "bins"]).every((name) =>
    sameMembers(one[name], other[name]),
  );
}

/**
 * @param {Set<number>} one
 * @param {Set<number>} other
 */
function sameMembers(one, other) {
  return one.size === other.size && [...one].every((member) => other.has(member));
}

/** @type {{ name: keyof Use, word: string, sign: number }[]} */
const CHANGES = [
  { name: "bins", word: "bin", sign: 1 },
  { name: "hidden", word: "class", sign: -1 },
  { name: "features", word: "feature", sign: 1 },
];

/**
 * What a step added and removed, as [how many, of what]: [[10, "bin"], [-1, "feature"]].
 * @param {Use} before
 * @param {Use} after
 * @returns {[number, string][]}
 */
export function changes(before, after) {
  /** @type {[number, string][]} */
  const found = [];
  for (const { name, word, sign } of CHANGES) {
    const more = [...after[name]].filter((member) => !before[name].has(member)).length;
    const less = [...before[name]].filter((member) => !after[name].has(member)).length;
    if (more > 0) found.push([more * sign, word]);
    if (less > 0) found.push([-less * sign, word]);
  }
  return found.sort((a, b) => b[0] - a[0]);
}
