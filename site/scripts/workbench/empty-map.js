// What stands in the place of a map that cannot be made.

import { element } from "../base/dom.js";
import { count } from "../base/words.js";
import { FEWEST_SHAPES } from "./desk.js";
import { firstOffer, offering } from "./first-offer.js";
import { kind, kinds } from "../database/kind.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Answers } from "./answers.js" */
/** @import { Desk } from "./desk.js" */

const BEST = 10;

/**
 * Why there is no map, and what to do next.
 * @param {string} which
 * @param {WorkState} state
 * @param {Answers} answers
 * @param {Desk} desk
 */
export function emptyMap(which, state, answers, desk) {
  if (answers.shapes({ hidden: state.get("hidden") }).length < FEWEST_SHAPES) {
    const words =
      answers.database.count < FEWEST_SHAPES
        ? `This database has ${count(answers.database.count, "shape")}; a map needs ${FEWEST_SHAPES}.`
        : `A map needs three shapes: take more ${kinds(answers.database)} into use.`;
    return [element("p", {}, words)];
  }
  if (which === "original") return [];
  const intended = "No bins are chosen yet. The refined map shows the same shapes, compared by chosen bins alone.";
  if (!answers.database.separable)
    return [
      element("p", {}, intended),
      offering(`Take the ${BEST} that vary most`, state.get("scores") !== null, () => desk.takeBest(BEST)),
    ];
  if (answers.groups(state.get("hidden")).length < 2)
    return [
      element(
        "p",
        {},
        `One ${kind(answers.database)} alone has nothing to be kept apart from: take another into use, and bins are scored and found again.`,
      ),
    ];
  return firstOffer(intended, state, answers, desk);
}
