// From a shape to those most alike by what the map compares: near it on the map, or elsewhere. It tells who is missing, and
// who is near and is not alike.

/** @import { State } from "../base/state.js" */
/** @import { MapView } from "./map.js" */

/**
 * The shapes most alike to one, parted by whether a map has them near; and those that are near and not alike.
 * @typedef {{ kept: number[], missing: number[], false: number[] }} Parted
 */

/**
 * Null as long as it is not known.
 * @param {MapView} view
 * @param {number} index
 * @returns {Parted | null}
 */
export function partedNeighbours({ scene, database }, index) {
  const alike = scene.alike?.of(index, database.methods[scene.target]) ?? null;
  if (alike === null) return null;
  const near = database.neighbours(index, scene.target);
  return {
    kept: alike.filter((other) => near.includes(other)),
    missing: alike.filter((other) => !near.includes(other)),
    false: near.filter((other) => !alike.includes(other)),
  };
}

/**
 * The switch of a page.
 * @param {State} state
 */
export function watchLines(state) {
  const input = document.getElementById("lines");
  const show = () => {
    input.checked = state.get("lines");
  };
  input.addEventListener("change", () => state.set({ lines: input.checked }));
  state.listen((changed) => changed.has("lines") && show());
  show();
}
