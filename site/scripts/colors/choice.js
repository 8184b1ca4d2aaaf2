// What colours say on maps of marks: the classes, how well shapes keep to theirs, or what the reader chooses.

import { OWN_COLORS } from "../addresses/colors.js";
import { Colors, firstKey, isKnown } from "./colors.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { MapValues } from "../map/scene.js" */

/** @typedef {State<MapValues & Shared & { color: string }>} ColoredState */

/** In the switch, what stands for any field or bin. */
const ANY = "color";

/**
 * Makes of what an address holds the same with colours that there are.
 * @param {Database} database
 */
export function knownColor(database) {
  /**
   * @param {Record<string, any>} found
   * @param {Miss} miss
   */
  return async ({ color, ...values }, miss) => {
    const known = OWN_COLORS.includes(color) || (await isKnown(color, database, miss));
    return { ...values, color: known ? color : OWN_COLORS[0] };
  };
}

/**
 * @param {Database} database
 * @param {State} page
 */
export function chosenColors(database, page) {
  const state = /** @type {ColoredState} */ (page);
  const inputs = document.querySelectorAll("#colors input");
  let last = firstKey();
  const show = () => {
    const color = state.get("color");
    const own = OWN_COLORS.includes(color);
    if (!own) last = color;
    for (const input of inputs) input.checked = input.value === (own ? color : ANY);
  };
  for (const input of inputs)
    input.addEventListener("change", () => state.set({ color: input.value === ANY ? last : input.value }));
  state.listen((changed) => changed.has("color") && show());
  show();
  return new Colors(database, state, {
    key: () => (OWN_COLORS.includes(state.get("color")) ? null : state.get("color")),
    choose: (color) => state.set({ color }),
  });
}
