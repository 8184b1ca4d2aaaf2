// The small controls: projection, what dragging does, scorer and separation; and the keys of the page.

import { element } from "../base/dom.js";
import { count } from "../base/words.js";
import { watchDragging } from "../map/dragging.js";
import { contests, separationWords } from "./separation.js";
import { kind, kinds } from "../database/kind.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Gestures } from "../map/gestures.js" */
/** @import { Desk } from "./desk.js" */
/** @import { Separation } from "./separation.js" */

/**
 * @param {Database} database
 * @param {Chunk.Workbench} data
 * @param {WorkState} state
 * @param {Desk} desk
 */
export function watchControls(database, data, state, desk) {
  const projections = document.getElementById("projections");
  const check = () => {
    for (const input of projections.querySelectorAll("input")) input.checked = input.value === state.get("projection");
  };
  projections.addEventListener("change", (event) => desk.use({ projection: event.target.value }));
  state.listen((changed) => changed.has("projection") && check());
  check();
  watchDragging(state);
  watchRamp(database, state);
  watchPicked(state);
  watchSample(state, desk);
  if (database.separable) {
    watchScorer(data, state, desk);
    watchSeparation(database, state, desk);
  }
}

/**
 * What the colours of NH mean, while the maps have them.
 * @param {Database} database
 * @param {WorkState} state
 */
function watchRamp(database, state) {
  const node = document.getElementById("hit-key");
  const show = () => {
    node.hidden = state.get("color") !== "hit";
    node.querySelector(".ramp").style.background = `linear-gradient(to right, ${database.marks.hit.join(", ")})`;
  };
  state.listen((changed) => (changed.has("color") || changed.has("theme")) && show());
  show();
}

/**
 * @param {Chunk.Workbench} data
 * @param {WorkState} state
 * @param {Desk} desk
 */
function watchScorer(data, state, desk) {
  const select = document.getElementById("scorer");
  const words = document.getElementById("scorer-words");
  select.replaceChildren(
    ...data.scorers.map(({ key, title, explanation }) => element("option", { value: key, title: explanation }, title)),
  );
  const show = () => {
    select.value = state.get("scorer");
    words.textContent = data.scorers.find(({ key }) => key === select.value)?.explanation ?? "";
  };
  select.addEventListener("change", () => desk.use({ scorer: select.value }));
  state.listen((changed) => changed.has("scorer") && show());
  show();
}

/**
 * @param {Database} database
 * @param {WorkState} state
 * @param {Desk} desk
 */
function watchSeparation(database, state, desk) {
  const words = document.getElementById("separation-words");
  const [against, each] = ["against", "each"].map((id) => document.getElementById(id));
  const show = () => {
    const separation = state.get("separation");
    const groups = [...database.classes.keys()].filter((group) => !state.get("hidden").has(group));
    const asked = contests(separation, groups);
    words.textContent =
      asked.length > 0 ? separationWords(separation, groups, database) : missing(separation, groups, database);
    words.parentElement.classList.toggle("missing", asked.length === 0);
    for (const input of against.querySelectorAll("input"))
      input.checked = (input.value === "rest") === (separation.against === null);
    for (const input of each.querySelectorAll("input")) input.checked = (input.value === "each") === separation.each;
  };
  against.addEventListener("change", (event) => {
    const separation = state.get("separation");
    desk.use({
      separation: { ...separation, against: event.target.value === "rest" ? null : new Set(database.classes.keys()) },
    });
  });
  each.addEventListener("change", (event) =>
    desk.use({ separation: { ...state.get("separation"), each: event.target.value === "each" } }),
  );
  state.listen((changed) => (changed.has("separation") || changed.has("hidden")) && show());
  show();
}

/**
 * Why there is nothing to score.
 * @param {Separation} separation
 * @param {number[]} groups
 * @param {Database} database
 */
function missing({ from, against, each }, groups, database) {
  if (groups.length < 2) return `needs two ${kinds(database)} in use`;
  if (from !== null && !groups.some((group) => from.has(group)))
    return `which? Tick ${kinds(database)} under “separate”`;
  if (against !== null && !groups.some((group) => against.has(group)))
    return `from which? Tick ${kinds(database)} under “from”`;
  return each ? `from which? Tick another ${kind(database)}` : "from which? All are on one side";
}

/**
 * How many shapes the brush has so far, before the tray shows them.
 * @param {WorkState} state
 */
function watchPicked(state) {
  const node = document.getElementById("picked");
  const show = () => {
    node.textContent = state.get("brushing") ? `${count(state.get("selection").size, "shape")} selected` : "";
  };
  state.listen((changed) => ["selection", "brushing"].some((name) => changed.has(name)) && show());
  show();
}

/**
 * Of how many shapes the maps and scores are, where not of all in use.
 * @param {WorkState} state
 * @param {Desk} desk
 */
function watchSample(state, desk) {
  const node = document.getElementById("of-a-sample");
  const show = () => {
    const words = desk.sampleWords;
    node.hidden = words === "";
    node.textContent = `NH of both maps, and scores made here, are of ${words}. On maps made here each other shape stands beside the one of these that is most like it.`;
  };
  state.listen((changed) => changed.has("hidden") && show());
  show();
}

/**
 * @param {WorkState} state
 * @param {Desk} desk
 * @param {Map<Found, Gestures>} gestures
 */
export function watchKeys(state, desk, gestures) {
  document.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]") || event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === "Escape" && !event.defaultPrevented) {
      // One press takes back the last thing: first the work in progress.
      if (!desk.stopAll()) state.set(state.get("opened") !== null ? { opened: null } : { selection: new Set() });
      return;
    }
    const gesture = gestures.get(event.target);
    if (!gesture) return;
    if (event.key === "+" || event.key === "=") gesture.zoom(1.5);
    else if (event.key === "-") gesture.zoom(1 / 1.5);
    else if (event.key === "0") state.set({ [gesture.scene.cameraName]: null });
    else return;
    event.preventDefault();
  });
}
