// What all pages of shapes begin and end with: a state that follows the address and the theme, and a voice.

import { State } from "./state.js";
import { currentTheme, watchTheme } from "./theme.js";

/** @import { Theme } from "./theme.js" */

/**
 * What the state of every page holds.
 * @typedef {object} Shown
 * @property {boolean} brushing whether a brush is being drawn
 * @property {Theme} theme
 */

/**
 * Open a page.
 *
 * `read()` gives the state that the address holds, or a promise of it; `values` is what else the state has at first.
 * @template {Record<string, any>} Read
 * @template {Record<string, any>} [Values={}]
 * @param {{ read: () => Read | Promise<Read>, values?: Values }} page
 */
export async function openPage({ read, values }) {
  /** @type {State<Read & Values & Shown>} */
  const state = new State(
    /** @type {any} */ ({ brushing: false, ...values, ...(await read()), theme: currentTheme() }),
  );
  const live = document.getElementById("live");
  return {
    state,
    /**
     * Say something to readers who do not see it.
     * @param {string} text
     */
    announce(text) {
      live.textContent = text;
    },
    /**
     * The page is drawn: from here on it follows the address, whose new values `arrive` takes, and the theme, for which
     * `redraw` does what listening to the state does not.
     * @param {{ arrive?: (found: Read) => void, redraw?: () => void }} [how]
     */
    ready({ arrive = (found) => state.set(/** @type {any} */ (found)), redraw = () => {} } = {}) {
      window.addEventListener("hashchange", async () => arrive(await read()));
      watchTheme(() => {
        redraw();
        state.set(/** @type {any} */ ({ theme: currentTheme() }));
      });
      document.documentElement.dataset.ready = "";
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
