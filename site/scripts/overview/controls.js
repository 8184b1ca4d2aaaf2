// The controls of the maps, and their keys.

import { viewsOf } from "../addresses/overview.js";
import { bringIntoRow, coarse } from "../base/dom.js";
import { watchDragging } from "../map/dragging.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */
/** @import { OverviewMaps } from "./maps.js" */

/**
 * @param {Database} database
 * @param {OverviewState} state
 * @param {OverviewMaps} maps
 */
export function watchControls(database, state, maps) {
  const methods = document.getElementById("methods");
  const views = document.getElementById("views");
  const pictures = document.getElementById("pictures");
  const exact = document.getElementById("exact");
  /**
   * @param {Found} group
   * @param {string} value
   */
  const check = (group, value) => {
    for (const input of group.querySelectorAll("input")) {
      input.checked = input.value === value;
      if (input.checked) bringIntoRow(group, input.parentElement);
    }
  };
  const show = () => {
    check(methods, database.methods[database.methods[state.get("method")].base].key);
    check(views, state.get("view"));
    exact.checked = state.get("exact");
    pictures.checked = state.get("pictures");
    document.body.toggleAttribute("data-zoomed", state.get("camera") !== null);
  };
  methods.addEventListener("change", (event) => {
    state.set({ method: database.methods.findIndex(({ key }) => key === event.target.value) });
  });
  views.addEventListener("change", (event) => state.set({ view: event.target.value }));
  pictures.addEventListener("change", () => state.set({ pictures: pictures.checked }));
  exact.addEventListener("change", () => state.set({ exact: exact.checked }));
  watchDragging(state);
  for (const button of document.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => zoom(button.dataset.zoom ?? "", state, maps));
  }
  for (const button of document.querySelectorAll(".promote")) {
    button.addEventListener("click", () => state.set({ view: button.dataset.view }));
  }
  state.listen((changed) => {
    if (["method", "camera", "view", "exact", "pictures"].some((name) => changed.has(name))) show();
  });
  show();
}

/**
 * @param {string} how
 * @param {OverviewState} state
 * @param {OverviewMaps} maps
 */
function zoom(how, state, maps) {
  if (how === "fit") state.set({ camera: null });
  else maps.gestures.get(maps.large)?.zoom(how === "in" ? 1.5 : 1 / 1.5);
}

/**
 * @param {OverviewState} state
 * @param {OverviewMaps} maps
 */
export function watchKeys(state, maps) {
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
    const view = viewsOf(maps.database)[Number(event.key) - 1];
    if (view) state.set({ view });
    else if (event.key in zooms) zoom(zooms[event.key], state, maps);
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
    ? "Tap a shape to see what is known of it. With Box or Lasso, draw round shapes to collect them here."
    : "Drag a box on a map to collect shapes here; Shift adds, Alt takes away. Click a shape to see what is known of it.";
}
