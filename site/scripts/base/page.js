// What all pages begin and end with: a state that follows the address and the theme, and a voice.

import { Address } from "./address.js";
import { offerFigures } from "./figure-export.js";
import { bringIntoRow } from "./dom.js";
import { watchPaper } from "./paper.js";
import { Missing } from "./missing.js";
import { arriveHere, goToPlace, pushHash, readHash, replaceHash, walk, whereabouts } from "./place.js";
import { watchLink } from "./link.js";
import { State } from "./state.js";
import { currentTheme, watchTheme } from "./theme.js";

/** @import { Miss } from "./missing.js" */

/**
 * Open a page.
 *
 * The state has the values of the `address`, whose changes are written there, and `values` at first. `settle` makes
 * values of the state of what the address holds, where more has to be known for it; `check` tells of names in these that
 * are not there, for which the page does not wait.
 * @param {{
 *   address?: Address,
 *   settle?: (found: Record<string, any>, miss: Miss) => Record<string, any> | Promise<Record<string, any>>,
 *   check?: (found: Record<string, any>, miss: Miss) => void,
 *   values?: Record<string, any>,
 * }} [page]
 */
export async function openPage({
  address = new Address([]),
  settle = (found) => found,
  check = () => {},
  values = {},
} = {}) {
  const missing = new Missing();
  // Who goes elsewhere while the page opens is followed once it is drawn.
  let gone = false;
  let follow = () => {
    gone = true;
  };
  window.addEventListener("popstate", () => follow());
  const read = async () => {
    const miss = missing.begin();
    const found = await settle(address.read(readHash(), miss), miss);
    check(found, miss);
    return found;
  };
  const found = await read();
  arriveHere();
  /** @type {State} */
  const state = new State({ brushing: false, ...values, ...found, theme: currentTheme(), whereabouts: whereabouts() });
  let arriving = false;
  const acted = watchActs();
  let passing = address.passing(readHash());
  /**
   * The address of the view as it is now, or as it was, and what passes through it to other pages.
   * @param {Map<string, any>} [before] the values that it had then
   */
  const written = (before = new Map()) => {
    const query = address.write({ get: (name) => (before.has(name) ? before.get(name) : state.get(name)) });
    for (const [name, value] of passing) query.append(name, value);
    return query;
  };
  /**
   * @param {boolean} step
   * @param {Map<string, any>} [before]
   */
  const write = (step, before) => {
    const query = written(before);
    if (query.toString() !== readHash().toString()) (step ? pushHash : replaceHash)(query);
    state.set({ whereabouts: whereabouts() });
  };
  // What changes often and is not written yet: whether that is a step; null where there is nothing.
  /** @type {boolean | null} */
  let owed = null;
  /** @param {Map<string, any>} [before] */
  const pay = (before) => {
    const step = owed;
    owed = null;
    if (step !== null) write(step, before);
  };
  const later = delayed(pay);
  /** @param {boolean} step */
  const owe = (step) => {
    owed = owed || step;
    later();
  };
  // What a brush changes is one change, which is made when it is let go.
  /** @type {Map<string, any>} */
  let drawn = new Map();
  state.listen((_now, then) => {
    for (const [name, value] of then) if (!drawn.has(name)) drawn.set(name, value);
    if (state.get("brushing")) return;
    const [changed, before] = [new Set(drawn.keys()), drawn];
    drawn = new Map();
    // What the reader changes is no longer what the link named.
    if (!arriving && address.has(changed) && acted.yet()) missing.begin();
    const changes = (/** @type {boolean} */ place, /** @type {boolean} */ often) =>
      address.has(changed, (row) => (row.place ?? false) === place && (row.often ?? false) === often);
    const steps = changes(true, false) && !arriving;
    if (steps || changes(false, false) || arriving) {
      // The way back leads to the view as it was left, not as it was when it was written last.
      if (arriving) owed = null;
      else pay(before);
      write(steps && acted.taken());
    } else if (changes(true, true)) owe(acted.taken());
    else if (changes(false, true)) owe(false);
  });
  return {
    state,
    written,
    /**
     * Say something to readers who do not see it.
     * @param {string} text
     */
    announce(text) {
      document.getElementById("live").textContent = text;
    },
    /**
     * The page is drawn: from here on it follows the address, whose new values `arrive` takes, and the theme, for which
     * `redraw` does what listening to the state does not.
     * @param {{ arrive?: (found: Record<string, any>) => void, redraw?: () => void }} [how]
     */
    ready({ arrive = (found) => state.set(found), redraw = () => {} } = {}) {
      follow = async () => {
        arriveHere();
        state.set({ whereabouts: whereabouts() });
        const query = readHash();
        passing = address.passing(query);
        const found = await read();
        // What it names may have taken a while to come, in which the reader went on.
        if (readHash().toString() !== query.toString()) return;
        arriving = true;
        arrive(found);
        arriving = false;
        // The way here is no reason for a step onwards.
        acted.taken();
      };
      if (gone) follow();
      watchUndo();
      window.addEventListener("pagehide", () => {
        if (owed !== null) write(false);
      });
      showPageInMenu();
      watchLink(() => address.holds(state));
      watchTheme(() => {
        redraw();
        state.set({ theme: currentTheme() });
      });
      offerFigures();
      watchPaper();
      goToPlace();
      document.documentElement.dataset.ready = "";
    },
  };
}

/** The keys of undo and redo go the browser's own ways, but in a field, which has ways of its own. */
function watchUndo() {
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey || event.key.toLowerCase() !== "z") return;
    const typing = event.target.matches("input:not([type=checkbox]):not([type=radio]), textarea");
    if (typing || document.querySelector("dialog[open]")) return;
    event.preventDefault();
    walk(event.shiftKey ? 1 : -1);
  });
}

/** On a phone the menu is one row that scrolls: to the page that is open. */
function showPageInMenu() {
  const open = document.querySelector(".masthead nav [aria-current]");
  if (open) bringIntoRow(open.parentElement, open);
}

/**
 * Whether the reader did something since this was taken for the reason of a step: what a page does by itself, as it opens
 * or after an answer, is no step to come back to.
 */
function watchActs() {
  let acted = false;
  for (const kind of ["pointerdown", "keydown", "input", "change"])
    window.addEventListener(kind, () => (acted = true), { capture: true });
  return {
    yet: () => acted,
    taken() {
      const answer = acted;
      acted = false;
      return answer;
    },
  };
}

/**
 * `work` put off until nobody has asked for it for `wait` milliseconds.
 * @param {() => void} work
 * @param {number} [wait] milliseconds
 */
export function delayed(work, wait = 250) {
  /** @type {number | undefined} */
  let timer;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(work, wait);
  };
}
