// What the reader sets on the map of the Features page.

/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { Gestures } from "../map/gestures.js" */
/** @import { MapView } from "../map/map.js" */

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

/**
 * Colours of the map: by class or by neighbourhood hit.
 * @param {FeaturesState} state
 * @param {MapView} map
 */
export function watchColors(state, map) {
  const inputs = document.querySelectorAll("#colors input");
  const check = () => {
    for (const input of inputs) input.checked = input.value === state.get("color");
  };
  for (const input of inputs) input.addEventListener("change", () => state.set({ color: input.value }));
  state.listen((changed) => {
    if (!changed.has("color")) return;
    check();
    map.name = state.get("color");
    map.start();
  });
  check();
}
