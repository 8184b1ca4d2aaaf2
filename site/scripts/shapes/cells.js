// One shape of the gallery, and the head of a group.

import { element, swatch } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { count } from "../base/words.js";
import { numberText, valueName } from "../database/fields.js";
import { ofAtMost } from "../database/hit-range.js";

/** @import { Database } from "../database/database.js" */
/** @import { ChoiceField, Field, Fields } from "../database/fields.js" */
/** @import { Group } from "./layout.js" */

/** Makes the cells; knows what stands below a picture while shapes are grouped and sorted as they are. */
export class Cells {
  /**
   * @param {Database} database
   * @param {Fields} fields
   * @param {{ group: string | null, sort: string, down: boolean }} parts
   */
  constructor(database, fields, { group, sort }) {
    this.database = database;
    this.active = /** @type {ChoiceField | null} */ (fields.active);
    this.sorted = fields.byKey.get(sort) ?? null;
    // What a shape has in common with all around it need not be said.
    this.showsClass = database.labelled && this.active !== null && group !== this.active.key;
    this.showsNumber = this.sorted !== null && !this.sorted.active;
    this.lines = 1 + (this.showsClass || this.showsNumber ? 1 : 0);
  }

  /**
   * @param {number} row
   * @param {boolean} selected
   */
  shape(row, selected) {
    const { database } = this;
    const name = database.names.at(row);
    const said = [name, database.labelled && this.#className(row), this.showsNumber && this.#number(row)];
    return element(
      "div",
      { class: "cell", role: "gridcell", "data-row": row, "aria-selected": String(selected) },
      element(
        "a",
        {
          href: pageAddress("shape.html", { id: database.ids.at(row) }),
          tabindex: "-1",
          draggable: "false",
          title: name,
          "aria-label": said.filter(Boolean).join(", "),
        },
        // Its source follows when the shape stays in sight.
        element("img", { alt: "", decoding: "async", draggable: "false" }),
        element("span", { class: "name", dir: "auto" }, name),
        this.lines > 1 && element("span", { class: "beside", dir: "auto" }, this.#beside(row)),
      ),
      tick(`Select ${name}`, selected),
    );
  }

  /** @param {number} row */
  #beside(row) {
    const { database } = this;
    return [
      this.showsClass && swatch(database.symbol(database.groups[row]), database.color(database.groups[row])),
      this.showsNumber ? this.#number(row) : this.#className(row),
    ];
  }

  /** @param {number} row */
  #className(row) {
    return this.active && valueName(this.active, this.active.of[row]);
  }

  /** @param {number} row */
  #number(row) {
    const sorted = /** @type {Field} */ (this.sorted);
    const { numbers, hit, highest } = sorted;
    return `${hit ? "NH" : sorted.title} ${numberText(numbers?.[row], sorted)}${hit ? ofAtMost(highest?.(row)) : ""}`;
  }

  /**
   * The head of a group; a click on it folds the group.
   * @param {Group} group
   * @param {boolean} folded
   */
  head({ key, title, note, group, rows }, folded) {
    const { database } = this;
    return [
      element(
        "div",
        { role: "gridcell", class: "fold-cell" },
        element(
          "button",
          { type: "button", class: "fold", tabindex: "-1", "data-group": key, "aria-expanded": String(!folded) },
          element("span", { class: "chevron", "aria-hidden": "true" }),
          typeof group === "number" && swatch(database.symbol(group), database.color(group)),
          element("bdi", { class: "group-name" }, title),
          element("span", { class: "size" }, count(rows.length, "shape")),
        ),
        note && element("span", { class: "note", title: note }, note),
      ),
      element("div", { role: "gridcell" }, tick(`Select all ${count(rows.length, "shape")} of ${title}`, false)),
    ];
  }
}

/**
 * @param {string} label
 * @param {boolean} checked
 */
function tick(label, checked) {
  const box = element("input", { type: "checkbox", class: "tick", tabindex: "-1", "aria-label": label });
  box.checked = checked;
  return box;
}
