// Separation control (paper, Fig. 5, view 6): which classes are to be told from which, and so what a bin's score means.
//
// A separation is { from, against, each }: the classes to set apart (null: all in use), the classes to set them apart
// from (null: the rest), and whether each stands for itself or all together are one group.

import { isolated, listed, shortened } from "../base/words.js";
import { kinds } from "../database/kind.js";

/** @import { Database } from "../database/database.js" */

/**
 * What is to be separated: the classes `from` in use, all where it is null, `against` others or the rest; each, or together.
 * @typedef {{ from: Set<number> | null, against: Set<number> | null, each: boolean }} Separation
 */

const MOST_NAMED = 3;

/**
 * The classes of a separation among those in use.
 * @param {{ from: Set<number> | null, against: Set<number> | null, each: boolean }} parts
 * @param {number[]} groups
 */
export function sides({ from, against }, groups) {
  return {
    positive: groups.filter((group) => from === null || from.has(group)),
    negative: against === null ? null : groups.filter((group) => against.has(group)),
  };
}

/**
 * What the scorers are asked: every contest is one group of classes against another, `positive` and `negative`.
 *
 * A contest and its mirror image are one; none has an empty side.
 * @param {{ from: Set<number> | null, against: Set<number> | null, each: boolean }} separation
 * @param {number[]} groups
 */
export function contests(separation, groups) {
  const { positive, negative } = sides(separation, groups);
  /**
   * @param {number[]} others
   * @param {number[]} own
   */
  const without = (others, own) => others.filter((group) => !own.includes(group));
  let pairs;
  if (!separation.each) pairs = [[positive, without(negative ?? groups, positive)]];
  else if (negative === null) pairs = positive.map((group) => [[group], without(groups, [group])]);
  else pairs = positive.flatMap((group) => without(negative, [group]).map((other) => [[group], [other]]));
  const seen = new Set();
  return pairs
    .filter(([own, others]) => {
      const key = [own.join(), others.join()].sort().join("|");
      if (own.length === 0 || others.length === 0 || seen.has(key)) return false;
      seen.add(key);
      return true;
    })
    .map(([own, others]) => ({ positive: own, negative: others }));
}

/**
 * A separation in words: "bird and airplane, each from the rest".
 * @param {{ from: Set<number> | null, against: Set<number> | null, each: boolean }} separation
 * @param {number[]} groups
 * @param {Database} database
 */
export function separationWords(separation, groups, database) {
  const { positive, negative } = sides(separation, groups);
  /** @param {number[]} chosen */
  const names = (chosen) => {
    if (chosen.length === groups.length && chosen.length > 2) return `all ${chosen.length} ${kinds(database)}`;
    if (chosen.length > MOST_NAMED) return `${chosen.length} ${kinds(database)}`;
    return listed(chosen.map((group) => isolated(shortened(database.className(group), 24))));
  };
  if (contests(separation, groups).length === 1 && separation.each) {
    const [
      {
        positive: [one],
        negative: others,
      },
    ] = contests(separation, groups);
    return `${names([one])} from ${others.length === 1 ? names(others) : "the rest"}`;
  }
  const manner = positive.length < 2 ? "" : separation.each ? ", each" : ", together,";
  if (negative === null) return `${names(positive)}${manner} from the rest`;
  if (manner === ", each")
    return `${names(positive)}, each from ${negative.join() === positive.join() ? "each other" : names(negative)}`;
  // What is ticked on both sides counts on the first.
  const others = negative.filter((group) => !positive.includes(group));
  const those = positive.length + others.length === groups.length ? "the rest" : names(others);
  return `${names(positive)}${manner} from ${separation.each ? "each of " : ""}${those}`;
}
