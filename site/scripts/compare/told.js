// What the figures of a comparison are called, and what they show.

import { toldAs } from "../base/snapshot.js";
import { count, isolated } from "../base/words.js";

/** @import { View } from "./groups-view.js" */
/** @import { OnShapes } from "./on-shapes.js" */

const MARKS = "Each mark is a shape, the line is the mean.";

/**
 * @param {() => View | null} current
 * @param {OnShapes} seen
 */
export function tellFigures(current, seen) {
  /**
   * @param {string} title id of the heading of its part of the page
   * @param {(view: View) => { title: string, words: string }} tell
   */
  const part = (title, tell) =>
    toldAs(document.getElementById(title).closest("[data-figure]"), () => {
      const view = current();
      return view === null ? { words: "" } : tell(view);
    });
  /** @param {View} view */
  const pair = ({ a, b }) => `${isolated(a.name)} and ${isolated(b.name)}`;
  part("apart-title", (view) => ({
    title: `Where ${pair(view)} differ most`,
    words: `${bins("apart-bins")} in which ${sized(view)} differ most, ${
      view.contrast.beyond.length === 0
        ? "though no more than bins do when the shapes are dealt out at random"
        : "by the difference of the means in relation to the spread within the groups; what is easily pictured first"
    }. ${MARKS}`,
  }));
  part("seen-title", (view) => ({
    title: `${pair(view)}, seen on two shapes`,
    words: seen.caption(),
  }));
  part("shared-title", (view) => ({
    title: `What ${pair(view)} have in common`,
    words: `${bins("shared-bins")} in which ${sized(view)} are unlike ${count(view.rest.count, "other shape")}, and like each other. ${MARKS}`,
  }));
  part("features-title", (view) => ({
    title: `${pair(view)}, feature by feature`,
    words: `How much of all that ${sized(view)} differ in, by each feature, goes with the group. Up to the mark, chance reaches it too: it is passed in one of 100 random deals.`,
  }));
}

/** @param {View} view */
function sized({ a, b }) {
  return [a, b].map(({ name, shapes }) => `${isolated(name)} (${count(shapes.length, "shape")})`).join(" and ");
}

/** @param {string} list */
function bins(list) {
  return count(document.getElementById(list).childElementCount, "bin");
}
