// The steps of the work, for the strip of small maps. They are among those of the browser's own history, where a selection is
// a step too. A step keeps the maps that were made for it.

/** @import { ShapeMap } from "../database/database.js" */
/** @import { Separation } from "./separation.js" */

/**
 * What is in use at a step, and the maps of it as far as they are made.
 * @typedef {object} Use
 * @property {Set<number>} hidden classes that are not
 * @property {Set<number>} features
 * @property {Set<number>} bins
 *
 * How it is looked at.
 * @typedef {object} Manner
 * @property {string} scorer
 * @property {Separation} separation
 * @property {string} projection
 *
 * `taken` counts the reader's steps up to this one.
 * @typedef {Use & Manner} Work
 * @typedef {Work & { taken: number, originalMap: ShapeMap | null, refinedMap: ShapeMap | null }} Step
 */

const MOST_STEPS = 200;

export class History {
  /** @type {Step[]} */
  steps = [];
  at = -1;

  get current() {
    return this.steps[this.at];
  }

  /**
   * A step that was just taken; what had been undone is gone. What the page did by itself takes no step: it is in the
   * place of the current one. What leads back to the one before it is that.
   * @param {Step} step
   */
  take(step) {
    const kept = this.steps.findIndex(({ taken }) => taken >= step.taken);
    this.steps.length = kept < 0 ? this.steps.length : kept;
    const last = this.steps.at(-1);
    if (!last || !alike(last, step)) this.steps.push(step);
    if (this.steps.length > MOST_STEPS) this.steps.shift();
    this.at = this.steps.length - 1;
  }

  /**
   * The reader took another way, so many steps from where the page was opened first: what that led to before is gone.
   * @param {number} taken
   */
  branch(taken) {
    this.steps = this.steps.filter((step) => step.taken < taken);
  }

  /**
   * The reader went to another place: to that of a step, or to one further on where the work was still the same. A step
   * from before the page was opened anew is put into its place; an address written by hand is one that was just taken.
   * @param {Step} step
   */
  arrive(step) {
    const place = this.steps.findLastIndex(({ taken }) => taken <= step.taken);
    const [before, after] = [this.steps[place], this.steps[place + 1]];
    if (before && alike(before, step)) this.at = place;
    else if (before?.taken === step.taken) this.take(step);
    else {
      this.at = place + 1;
      if (after && alike(after, step)) after.taken = step.taken;
      else this.steps.splice(this.at, 0, step);
    }
  }
}

/**
 * Whether two steps are of the same work.
 * @param {Work} one
 * @param {Work} other
 */
export function alike(one, other) {
  return CHANGES.every(({ name }) => sameMembers(one[name], other[name])) && turns(one, other).length === 0;
}

/**
 * @param {Separation} one
 * @param {Separation} other
 */
function sameQuestion(one, other) {
  return one.each === other.each && sameMembers(one.from, other.from) && sameMembers(one.against, other.against);
}

/**
 * @param {Set<number> | null} one
 * @param {Set<number> | null} other
 */
function sameMembers(one, other) {
  if (one === null || other === null) return one === other;
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

/**
 * In what other ways a step looks at what is in use.
 * @param {Manner} before
 * @param {Manner} after
 * @returns {string[]}
 */
export function turns(before, after) {
  return [
    before.projection !== after.projection && "other map",
    before.scorer !== after.scorer && "other scorer",
    !sameQuestion(before.separation, after.separation) && "other question",
  ].filter(Boolean);
}
