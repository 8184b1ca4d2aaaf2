// The controls of the maps, and their keys.

import { coarse } from "../base/dom.js";
import { VIEWS } from "./arrangement.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Gestures } from "../map/gestures.js" */

/** @typedef {Map<string, Gestures>} AllGestures by the names of their maps */

/**
 * @param {Database} database
 * @param {OverviewState} state
 * @param {AllGestures} gestures
 */
export function watchControls(database, state, gestures) {
  const methods = document.getElementById("methods");
  const drag = document.getElementById("drag");
  /**
   * @param {Found} group
   * @param {string} value
   */
  const check = (group, value) => {
    for (const input of group.querySelectorAll("input")) input.checked = input.value === value;
  };
  const show = () => {
    check(methods, database.methods[database.methods[state.get("method")].base].key);
    check(drag, state.get("drag"));
    document.body.dataset.drag = state.get("drag");
    document.body.toggleAttribute("data-zoomed", state.get("camera") !== null);
  };
  methods.addEventListener("change", (event) => {
    state.set({ method: database.methods.findIndex(({ key }) => key === event.target.value) });
  });
  drag.addEventListener("change", (event) => state.set({ drag: event.target.value }));
  for (const button of document.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => zoom(button.dataset.zoom ?? "", state, gestures));
  }
  for (const button of document.querySelectorAll(".promote")) {
    button.addEventListener("click", () => state.set({ view: button.dataset.view }));
  }
  state.listen((changed) => {
    if (changed.has("method") || changed.has("drag") || changed.has("camera")) show();
  });
  show();
}

/**
 * @param {string} how
 * @param {OverviewState} state
 * @param {AllGestures} gestures
 */
function zoom(how, state, gestures) {
  if (how === "fit") state.set({ camera: null });
  else gestures.get(state.get("view"))?.zoom(how === "in" ? 1.5 : 1 / 1.5);
}

/**
 * @param {OverviewState} state
 * @param {AllGestures} gestures
 */
export function watchKeys(state, gestures) {
  /** @type {Record<string, string>} */
  const zooms = { "+": "in", "=": "in", "-": "out", 0: "fit" };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.querySelector("dialog[open]")) return;
    if (event.key === "Escape") {
      takeBack(state);
      return;
    }
    if (event.target instanceof HTMLInputElement && event.target.type === "search") return;
    if (["1", "2", "3"].includes(event.key)) state.set({ view: VIEWS[Number(event.key) - 1] });
    else if (event.key in zooms) zoom(zooms[event.key], state, gestures);
    else if (event.key === "/") document.getElementById("search").focus();
    else return;
    event.preventDefault();
  });
}

/**
 * One press takes back the last thing that is open: the panel, then the search, then the selection.
 * @param {OverviewState} state
 */
function takeBack(state) {
  if (state.get("opened") !== null) state.set({ opened: null });
  else if (state.get("query") !== "") state.set({ query: "" });
  else state.set({ selection: new Set() });
}

export function trayHint() {
  return coarse()
    ? "Tap a shape to see what is known of it. With Select, drag a box to collect shapes here."
    : "Drag a box on a map to collect shapes here. Click a shape to see what is known of it.";
}
