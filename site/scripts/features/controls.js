// What the reader sets on the map of the Features page.

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
