// What can be done with all shapes that are shown.

import { compareAddress } from "../addresses/compare.js";
import { pageAddress } from "../base/place.js";
import { grouped } from "../base/words.js";
import { writeSelection } from "../database/selection.js";

/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Grid } from "./grid.js" */
/** @import { Sieve } from "./sieve.js" */

/**
 * Watch the buttons above the gallery; returns what brings them up to date after sifting.
 * @param {Database} database
 * @param {Sieve} sieve
 * @param {Grid} grid
 * @param {GalleryState} state
 */
export function watchActions(database, sieve, grid, state) {
  const [select, map, compare, fold] = ["select-shown", "on-map", "compare-shown", "fold"].map((id) =>
    document.getElementById(id),
  );
  const shown = () => [...database.ids.keys()].filter((row) => sieve.passes(row));
  select.addEventListener("click", () => state.set({ selection: new Set(shown()) }));
  fold.addEventListener("click", () => {
    const closed = state.get("closed").size > 0 ? [] : grid.groups.map(({ key }) => key);
    state.set({ closed: new Set(closed) });
  });
  const only = document.getElementById("only-selected");
  only.addEventListener("click", () => state.set({ only: true }));
  const showOnly = () => {
    only.hidden = state.get("only") || state.get("selection").size === 0;
  };
  // Many shapes make long addresses; they are made when they are wanted.
  /**
   * @param {Found} link
   * @param {() => string} address
   */
  const aim = (link, address) => {
    for (const kind of ["pointerdown", "focus", "click"]) {
      link.addEventListener(kind, () => {
        link.href = address();
      });
    }
  };
  aim(map, () => {
    const query = new URLSearchParams();
    if (sieve.size < database.count) writeSelection(query, database, new Set(shown()));
    return pageAddress("index.html", query);
  });
  aim(compare, () => compareAddress(database, { kind: "shapes", shapes: new Set(shown()) }, { kind: "rest" }));
  const showFold = () => {
    fold.textContent = state.get("closed").size > 0 ? "Unfold all" : "Fold all";
  };
  state.listen((changed) => {
    if (changed.has("closed")) showFold();
    if (changed.has("selection") || changed.has("only")) showOnly();
  });
  showFold();
  showOnly();
  return () => {
    const some = sieve.size > 0 && sieve.size < database.count;
    select.hidden = sieve.size === 0;
    select.textContent = sieve.size === database.count ? "Select all" : `Select these ${grouped(sieve.size)}`;
    map.hidden = sieve.size === 0;
    compare.hidden = !some;
  };
}
