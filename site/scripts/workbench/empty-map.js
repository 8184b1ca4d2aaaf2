// What stands in the place of a map that cannot be made.

import { element } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { count, figure, grouped } from "../base/words.js";
import { MOST_SHAPES } from "../database/sample.js";
import { FOUND_BY } from "./answers.js";
import { FEWEST_SHAPES } from "./desk.js";

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
  const rows = answers.rows({ hidden: state.get("hidden"), sample: state.get("sample") }).length;
  if (rows < FEWEST_SHAPES) {
    const words =
      answers.database.count < FEWEST_SHAPES
        ? `This database has ${count(answers.database.count, "shape")}; a map needs ${FEWEST_SHAPES}.`
        : "A map needs three shapes: take more classes into use.";
    return [element("p", {}, words)];
  }
  if (rows > MOST_SHAPES && (which === "original" || state.get("bins").size > 0)) {
    return [
      element(
        "p",
        {},
        `A map of ${count(rows, "shape")} takes a browser long. A sample of ${grouped(MOST_SHAPES)}, each class in proportion, takes seconds; both maps are then of the sample, so that their NH can be compared.`,
      ),
      element(
        "button",
        { type: "button", class: "plain strong", id: "use-sample", onclick: () => desk.use({ sample: true }) },
        "Use a sample",
      ),
    ];
  }
  if (which === "original") return [];
  /**
   * @param {string} words
   * @param {boolean} possible
   * @param {() => void} onclick
   */
  const offer = (words, possible, onclick) =>
    element(
      "button",
      { type: "button", class: "plain strong", id: "first-offer", disabled: !possible, onclick },
      words,
    );
  const intended = "No bins are chosen yet. The refined map shows the same shapes, compared by chosen bins alone.";
  if (!answers.database.separable)
    return [
      element("p", {}, intended),
      offer(`Take the ${BEST} that vary most`, state.get("scores") !== null, () => desk.takeBest(BEST)),
    ];
  if (answers.groups(state.get("hidden")).length < 2)
    return [
      element(
        "p",
        {},
        "One class alone has nothing to be kept apart from: take another into use, and bins are scored and found again.",
      ),
    ];
  const refused = state.get("refused");
  if (refused !== null)
    return [
      element(
        "p",
        {},
        `No few bins were found whose map keeps these classes apart better than that of all features does: NH ${figure(refused)}. Choose bins below, or take other classes into use.`,
      ),
    ];
  const found = answers.foundBins({ ...desk.history.current, sample: state.get("sample") });
  if (found === null)
    return [
      element("p", {}, intended),
      offer("Find a few that keep these classes apart", desk.canFind, () => desk.findBins()),
    ];
  return [
    element(
      "p",
      {},
      `${intended} The build searched all bins for a few that keep the classes apart: `,
      element("b", {}, `NH ${figure(found.allFeatures)} → ${figure(found.nh)}`),
      state.get("projection") === FOUND_BY ? "" : " on a t-SNE map, for which they were searched",
      `; on shapes that the search never saw, ${figure(found.heldOut)}. `,
      element("a", { href: pageAddress("bins.html") }, "How they were found"),
    ),
    offer(`Take these ${count(found.bins.length, "bin")}`, desk.canFind, () => desk.findBins()),
  ];
}
