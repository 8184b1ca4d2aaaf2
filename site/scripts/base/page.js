// What all pages of shapes begin and end with: a state that follows the address and the theme, and a voice.

import { State } from "./state.js";
import { currentTheme, watchTheme } from "./theme.js";

/**
 * Open a page.
 *
 * `read()` gives the state that the address holds, or a promise of it; `values` is what else the state has at first.
 */
export async function openPage({ read, values = {} }) {
  const state = new State({ brushing: false, ...values, ...(await read()), theme: currentTheme() });
  const live = document.getElementById("live");
  return {
    state,
    /** Say something to readers who do not see it. */
    announce(text) {
      live.textContent = text;
    },
    /**
     * The page is drawn: from here on it follows the address, whose new values `arrive` takes, and the theme, for which
     * `redraw` does what listening to the state does not.
     */
    ready({ arrive = (found) => state.set(found), redraw = () => {} } = {}) {
      window.addEventListener("hashchange", async () => arrive(await read()));
      watchTheme(() => {
        redraw();
        state.set({ theme: currentTheme() });
      });
      document.documentElement.dataset.ready = "";
    },
  };
}

/** `work` put off until nobody has asked for it for `wait` milliseconds. */
export function delayed(work, wait = 250) {
  let timer = null;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(work, wait);
  };
}
