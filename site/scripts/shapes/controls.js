// How the gallery is arranged: grouped, sorted, and how large its pictures are.

import { element } from "../base/dom.js";
import { count } from "../base/words.js";
import { isBelowOne, rangeOf } from "../database/hit-range.js";

/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Field, Fields } from "../database/fields.js" */

export class Controls {
  /**
   * @param {Database} database
   * @param {Fields} fields
   * @param {GalleryState} state
   */
  constructor(database, fields, state) {
    this.database = database;
    this.fields = fields;
    this.state = state;
    this.group = document.getElementById("group");
    this.sort = document.getElementById("sort");
    this.down = document.getElementById("down");
    this.size = document.getElementById("size");
    this.fold = document.getElementById("fold");
    this.note = document.getElementById("sort-note");
    /** @param {Field} field */
    const option = (field) => element("option", { value: field.key }, field.title);
    this.group.append(element("option", { value: "" }, "Nothing"), ...fields.groupable.map(option));
    this.sort.append(element("option", { value: "" }, "Name"), ...fields.sortable.map(option));
    this.group.parentElement.hidden = fields.groupable.length === 0;
    this.group.addEventListener("change", () => state.set({ group: this.group.value, closed: new Set() }));
    this.sort.addEventListener("change", () => state.set({ sort: this.sort.value, down: false }));
    this.down.addEventListener("click", () => state.set({ down: !state.get("down") }));
    this.size.addEventListener("input", () => state.set({ size: Number(this.size.value) }));
    state.listen((changed) => {
      if (["group", "sort", "down", "size"].some((name) => changed.has(name))) this.show();
    });
    this.show();
  }

  show() {
    const { state } = this;
    this.group.value = state.get("group");
    this.sort.value = state.get("sort");
    this.size.value = state.get("size");
    this.down.textContent = this.#direction();
    this.fold.hidden = state.get("group") === "";
    const sorted = this.fields.byKey.get(state.get("sort"));
    this.note.hidden = !sorted?.hit;
    if (sorted?.hit) this.note.textContent = this.#onHit();
  }

  #onHit() {
    const { neighbours } = this.database.methods[0];
    return `NH, the neighbourhood hit: the share of a shape’s ${count(neighbours, "nearest neighbour")} on the map that are of its own class. Near 0 it lies among others.${isBelowOne(rangeOf(this.database, this.database.methods[0]).highest) ? " A shape whose class has fewer others than that cannot reach 1: its card says how much it can." : ""}`;
  }

  /** The order in words; a click turns it round. */
  #direction() {
    const field = this.fields.byKey.get(this.state.get("sort"));
    const down = this.state.get("down");
    if (!field || field.numbers === null) return down ? "Z to A" : "A to Z";
    if (field.hit) return down ? "Typical first" : "Outliers first";
    return down ? "Largest first" : "Smallest first";
  }
}
