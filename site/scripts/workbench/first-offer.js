// What an empty refined map offers where classes are to be kept apart: a few bins that make a better one. Where there are
// none, why, and what can be told apart by few.

import { element } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { count, figure, grouped } from "../base/words.js";
import { FOUND_BY, SEARCHED_SHAPES } from "./answers.js";
import { kinds } from "../database/kind.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Answers } from "./answers.js" */
/** @import { Desk } from "./desk.js" */

/**
 * @param {string} intended what the map is for
 * @param {WorkState} state
 * @param {Answers} answers
 * @param {Desk} desk
 */
export function firstOffer(intended, state, answers, desk) {
  const { database, bins } = answers;
  const whole = desk.history.current.features.size === bins.features.length;
  const none = `No small set of bins does better than ${whole ? "all features" : "the features in use"} here`;
  const refused = state.get("refused");
  const found = answers.foundBins(desk.history.current);
  if (refused !== null)
    return [
      element(
        "p",
        {},
        `${none}: the best that was found, of ${count(refused.bins, "bin")}, reaches NH ${figure(refused.reached)}, the map beside this ${figure(refused.before)}. `,
        found !== null && isSample(found, database) && `The search had ${measuredOn(found, database)}. `,
      ),
      ...instead(answers, desk),
    ];
  const { length: shapes } = answers.shapes(desk.history.current);
  if (found === null)
    return [
      element(
        "p",
        {},
        intended,
        shapes > SEARCHED_SHAPES &&
          ` A search looks at ${grouped(SEARCHED_SHAPES)} of ${count(shapes, "shape")}; NH is then that of all of these.`,
      ),
      offering(`Find a few that keep these ${kinds(database)} apart`, desk.canFind, () => desk.findBins()),
    ];
  const byOther = state.get("projection") === FOUND_BY ? "" : " on a t-SNE map, for which they were searched";
  // The map at hand may be better than the one of all features that the search knew.
  const comparable = byOther === "" && !isSample(found, database);
  const before = Math.max(found.allFeatures, (comparable && desk.reached) || 0);
  const on = isSample(found, database) ? `, measured on ${measuredOn(found, database)}` : "";
  if (!found.pays || found.nh <= before)
    return [
      element(
        "p",
        {},
        found.nh > before ? "A small set of bins is no sure gain here" : none,
        `: the ${count(found.bins.length, "bin")} that the build found reach NH ${figure(found.nh)}, all features ${figure(before)}${byOther}${on}`,
        found.nh > before && "; but on shapes that the search never saw they are not surely ahead",
        ". ",
        howFound(),
      ),
      ...instead(answers, desk),
    ];
  return [
    element(
      "p",
      {},
      `${intended} The build searched all bins for a few that keep the ${kinds(database)} apart: `,
      element("b", {}, `NH ${figure(before)} → ${figure(found.nh)}`),
      `${byOther}${on}; on shapes that the search never saw, ${figure(found.heldOut)}. `,
      howFound(),
    ),
    offering(`Take these ${count(found.bins.length, "bin")}`, desk.canFind, () => desk.findBins()),
  ];
}

/**
 * A button that does what the map waits for.
 * @param {string} words
 * @param {boolean} possible
 * @param {() => void} onclick
 */
export function offering(words, possible, onclick) {
  return element(
    "button",
    { type: "button", class: "plain strong", id: "first-offer", disabled: !possible, onclick },
    words,
  );
}

/**
 * Two classes of which bins can say what tells them apart, where all are in use.
 * @param {Answers} answers
 * @param {Desk} desk
 */
function instead({ database, data }, desk) {
  const { example } = data;
  if (example === null || desk.history.current.hidden.size > 0 || database.classes.length < 3)
    return [element("p", {}, `Choose bins below, or take other ${kinds(database)} into use.`)];
  const [one, other] = example.classes;
  const hidden = new Set([...database.sizes.keys()].filter((group) => group !== one && group !== other));
  /** @param {number} group */
  const name = (group) => element("b", {}, element("bdi", {}, database.className(group)));
  return [
    element(
      "p",
      {},
      `Fewer ${kinds(database)} are told apart by fewer bins. The two that mix most: `,
      name(one),
      " and ",
      name(other),
      ".",
    ),
    offering("Show only these two", true, () => desk.use({ hidden })),
  ];
}

/**
 * @param {Chunk.FoundSet} found
 * @param {Database} database
 */
function isSample({ shapes }, { count: all }) {
  return shapes < all;
}

/**
 * @param {Chunk.FoundSet} found
 * @param {Database} database
 */
function measuredOn({ shapes }, { count: all }) {
  return `${grouped(shapes)} of ${count(all, "shape")}`;
}

function howFound() {
  return element("a", { href: pageAddress("bins.html") }, "How they were found");
}
