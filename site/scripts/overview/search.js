// Find shapes as one types: a list with pictures suggests some, and the map marks all.

import { count, grouped } from "../base/words.js";
import { findWords, searchTexts } from "../database/search.js";
import { findShapes } from "../database/shape-finder.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */

/** What somebody types is marked on the map when they pause: drawing it would keep the next letter waiting. */
const PAUSE = 150;

export class Search {
  #pause = 0;

  /**
   * @param {Database} database
   * @param {OverviewState} state
   * @param {{ announce: (text: string) => void, open: (index: number) => void }} ways `open` shows a shape that was chosen
   */
  constructor(database, state, { announce, open }) {
    this.database = database;
    this.state = state;
    this.announce = announce;
    this.field = document.getElementById("search");
    this.select = document.getElementById("search-select");
    this.field.addEventListener("input", () => {
      clearTimeout(this.#pause);
      this.#pause = setTimeout(() => state.set({ query: this.field.value.trim() }), PAUSE);
    });
    this.select.addEventListener("click", () => this.#selectAll());
    findShapes(
      database,
      (index) => {
        clearTimeout(this.#pause);
        open(index);
        state.set({ query: "" });
      },
      { field: "search", list: "search-found" },
    );
    state.listen((changed) => {
      if (changed.has("query")) this.run();
    });
  }

  async run() {
    const query = this.state.get("query");
    if (this.field.value.trim() !== query) this.field.value = query;
    if (query === "") {
      this.select.hidden = true;
      this.state.set({ matches: null });
      return;
    }
    const texts = await searchTexts(this.database);
    if (this.state.get("query") !== query) return;
    const found = findWords(texts, query);
    this.select.hidden = false;
    this.select.disabled = found.length === 0;
    this.select.textContent = found.length === 0 ? "none found" : `Select ${grouped(found.length)}`;
    this.announce(`${count(found.length, "shape")} found`);
    this.state.set({ matches: new Set(found) });
  }

  #selectAll() {
    const matches = this.state.get("matches");
    if (!matches?.size) return;
    this.state.set({ selection: new Set(matches), query: "" });
  }
}
