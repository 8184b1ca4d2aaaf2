// The pictures, and what says which of them are shown and how: they follow the state.

import { delayed } from "../base/page.js";
import { count } from "../base/words.js";
import { watchActions } from "./actions.js";
import { Arrangement } from "./arrangement.js";
import { Cells } from "./cells.js";
import { Chips } from "./chips.js";
import { Controls } from "./controls.js";
import { Facets } from "./facets.js";
import { Grid } from "./grid.js";
import { Keys } from "./keys.js";
import { Panel } from "./panel.js";
import { search, watchSearch } from "./search.js";
import { Sieve } from "./sieve.js";

/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Fields } from "../database/fields.js" */

const SAY_AFTER = 500;

export class Gallery {
  /** @type {Cells | null} */
  #cells = null;
  #cellsOf = "";

  /**
   * @param {Database} database
   * @param {Fields} fields
   * @param {GalleryState} state
   * @param {(text: string) => void} announce
   */
  constructor(database, fields, state, announce) {
    this.database = database;
    this.fields = fields;
    this.state = state;
    this.sieve = new Sieve(database, fields);
    this.arrangement = new Arrangement(database, fields);
    this.grid = new Grid(database, state);
    this.chips = new Chips(fields, this.sieve, state);
    this.facets = new Facets(database, fields, this.sieve, state);
    this.panel = new Panel(this.sieve, state);
    this.showActions = watchActions(database, this.sieve, this.grid, state);
    this.say = delayed(() => announce(`${count(this.sieve.size, "shape")} shown`), SAY_AFTER);
    new Controls(database, fields, state);
    // Whoever comes back finds the shape where it was.
    new Keys(this.grid, state, { leave: (at) => state.set({ at }) });
    watchSearch(state);
    state.listen((changed) => this.#follow(changed));
  }

  async start() {
    const { state } = this;
    if (state.get("query") !== "") await search(this.database, state);
    this.#sift();
    this.#arrange(false);
    if (state.get("at") !== null) this.grid.start(state.get("at"));
  }

  /** @param {Set<string>} changed */
  #follow(changed) {
    const { state } = this;
    /** @param {...string} names */
    const has = (...names) => names.some((name) => changed.has(name));
    if (has("query")) search(this.database, state);
    // Who takes back the last of the selected shapes sees all again.
    if (has("selection") && state.get("only") && state.get("selection").size === 0) state.set({ only: false });
    const taken = has("selection") && state.get("only");
    if (taken || has("matches", "only", "filters")) {
      this.#sift();
      this.say();
    }
    if (has("matches", "only", "filters", "group", "sort", "down")) this.#arrange(true);
    else if (taken || has("theme")) this.#arrange(false);
    else if (has("size", "closed")) this.grid.rearrange();
    if (has("selection")) this.grid.mark();
  }

  #sift() {
    const { state } = this;
    this.sieve.sift(state.get("matches"), state.get("only") ? state.get("selection") : null, state.get("filters"));
    this.chips.show();
    this.facets.show();
    this.panel.show();
    this.showActions();
  }

  /** @param {boolean} fromTop */
  #arrange(fromTop) {
    const { database, fields, state, sieve } = this;
    const how = { group: state.get("group"), sort: state.get("sort"), down: state.get("down") };
    const cellsOf = JSON.stringify([how, state.get("theme")]);
    if (this.#cells === null || this.#cellsOf !== cellsOf) {
      this.#cells = new Cells(database, fields, how);
      this.#cellsOf = cellsOf;
    }
    const groups = this.arrangement.arrange((row) => sieve.passes(row), how);
    this.grid.show(groups, this.#cells, fromTop);
    this.grid.mark();
  }
}
