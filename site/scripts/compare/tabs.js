// The three questions of the page: one is open, arrow keys go from one to the next.

/** @import { CompareState, CompareView } from "../addresses/compare.js" */

export class Tabs {
  /** @param {CompareState} state */
  constructor(state) {
    this.state = state;
    this.tabs = [...document.querySelectorAll(".compare-page [role=tab]")];
    for (const [place, tab] of this.tabs.entries()) {
      tab.addEventListener("click", () => state.set({ view: viewOf(tab) }));
      tab.addEventListener("keydown", (event) => {
        /** @type {Record<string, number>} */
        const steps = { ArrowRight: place + 1, ArrowLeft: place - 1, Home: 0, End: this.tabs.length - 1 };
        if (!(event.key in steps)) return;
        event.preventDefault();
        const next = this.tabs[(steps[event.key] + this.tabs.length) % this.tabs.length];
        next.focus();
        state.set({ view: viewOf(next) });
      });
    }
    state.listen((changed) => {
      if (changed.has("view")) this.render();
    });
    this.render();
  }

  render() {
    for (const tab of this.tabs) {
      const open = tab.dataset.view === this.state.get("view");
      tab.setAttribute("aria-selected", String(open));
      tab.tabIndex = open ? 0 : -1;
      document.getElementById(tab.dataset.view ?? "").hidden = !open;
    }
  }
}

/**
 * The question that a tab opens.
 * @param {Found} tab
 */
function viewOf(tab) {
  return /** @type {CompareView} */ (tab.dataset.view);
}
