// What the reader sets on the Features page: keys of its map, and what is folded.

/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { Gestures } from "../map/gestures.js" */

/**
 * @param {Found} surface
 * @param {FeaturesState} state
 * @param {Gestures} gestures
 */
export function watchMapKeys(surface, state, gestures) {
  surface.addEventListener("keydown", (event) => {
    if (event.key === "+" || event.key === "=") gestures.zoom(1.5);
    else if (event.key === "-") gestures.zoom(1 / 1.5);
    else if (event.key === "0") state.set({ camera: null });
    else if (event.key === "Escape") state.set({ opened: null, selection: new Set() });
    else return;
    event.preventDefault();
  });
}

/** Where there is little room, what is below the map stands in a line each, to be opened. */
export function foldParts() {
  if (!window.matchMedia("(width < 1000px)").matches) return;
  for (const part of document.querySelectorAll("details.folds")) part.open = false;
}
