// The classes, a row each: in use or not, to be set apart or not, and how well each keeps together on the two maps. For the
// Tab key all rows are one stop, and arrow keys go from row to row: a database may have a hundred classes.

import { element, focused } from "../base/dom.js";
import { change, difference } from "../base/figures.js";
import { figure, grouped, isolated } from "../base/words.js";
import { classMark } from "../colors/legend.js";
import { ofAtMost, rangeOf } from "../database/hit-range.js";
import { kind } from "../database/kind.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Separation } from "./separation.js" */

/**
 * @typedef {"from" | "against"} Part of what is to be separated
 * @typedef {{ tabIndex: number, disabled?: boolean, readonly isConnected: boolean, focus: () => void }} Stop a button or a box
 */

/** @type {Part[]} */
const PARTS = ["from", "against"];

export class ClassTable {
  /**
   * @param {Database} database
   * @param {WorkState} state
   * @param {object} ways
   * @param {(hidden: Set<number>) => void} ways.change takes other classes into use
   * @param {(part: Part, groups: number[]) => void} ways.separate ticks others
   */
  constructor(database, state, { change, separate }) {
    this.database = database;
    this.state = state;
    this.change = change;
    this.separate = separate;
    this.table = document.getElementById("class-table");
    this.body = this.table.tBodies[0];
    this.groups = [...database.classes.keys(), ...(database.sizes.has(-1) ? [-1] : [])];
    document.getElementById("classes-all").addEventListener("click", () => change(new Set()));
    document.getElementById("classes-none").addEventListener("click", () => change(new Set(this.groups)));
    for (const part of PARTS) {
      const all = document.getElementById(part === "from" ? "separate-all" : "against-all");
      all.addEventListener("click", () =>
        separate(part, this.#ticked(part).size < database.classes.length ? [...database.classes.keys()] : []),
      );
    }
    this.body.addEventListener("pointerleave", () => state.set({ pointedGroup: null }));
    this.table.addEventListener("focusin", ({ target }) => this.body.contains(target) && this.#stopAt(target));
    this.table.addEventListener("keydown", (event) => this.#key(event));
    state.listen((changed) => {
      if (["hidden", "separation"].some((name) => changed.has(name))) this.#mark();
      if (["originalMap", "refinedMap", "theme", "coloring"].some((name) => changed.has(name))) this.render();
    });
    this.render();
  }

  render() {
    const kept = focused()?.dataset.key;
    this.rows = new Map(this.groups.map((group) => [group, this.#row(group)]));
    this.body.replaceChildren(...[...this.rows.values()].map(({ node }) => node));
    this.#mark();
    if (kept !== undefined) this.body.querySelector(`[data-key="${kept}"]`)?.focus({ preventScroll: true });
  }

  /** @param {number} group */
  #row(group) {
    const { database, state } = this;
    const name = database.className(group);
    const original = state.get("originalMap");
    const hit = original?.hitOfClass[group] ?? null;
    const most =
      original === null || hit === null ? "" : ofAtMost(rangeOf(database, original).highestOfClass.get(group));
    const refined = state.get("refinedMap")?.hitOfClass[group] ?? null;
    const use = element(
      "button",
      {
        type: "button",
        class: "use",
        tabindex: "-1",
        "data-key": `use ${group}`,
        title: `${name}\nClick takes it into use or out of it.`,
        onclick: (event) => (event.altKey ? this.#only(group) : this.#toggle(group)),
      },
      classMark(database, state.get("coloring") ?? null, group),
      element("span", { class: "name", dir: "auto" }, name),
    );
    const only = element(
      "button",
      {
        type: "button",
        class: "only",
        tabindex: "-1",
        "data-key": `only ${group}`,
        "aria-label": `Only ${name}`,
        title: `Only this ${kind(database)}`,
        onclick: () => this.#only(group),
      },
      "only",
    );
    const ticks = new Map(group < 0 ? [] : PARTS.map((part) => [part, this.#tick(part, group, name)]));
    /** @param {number | null} value */
    const point = (value) => () => state.set({ pointedGroup: value });
    const node = element(
      "tr",
      { onpointerenter: point(group), onpointerleave: point(null) },
      element(
        "th",
        { scope: "row" },
        element(
          "div",
          { class: "of-class" },
          use,
          only,
          element("span", { class: "size" }, grouped(database.sizes.get(group) ?? 0)),
        ),
      ),
      element("td", { class: "tick" }, ticks.get("from")),
      element("td", { class: "tick against" }, ticks.get("against")),
      element(
        "td",
        {
          class: "number",
          title: most === "" ? null : `NH ${figure(hit)}${most}, as many as the ${kind(database)} has others`,
        },
        group < 0 ? "" : figure(hit),
      ),
      element("td", { class: "number change" }, hit !== null && refined !== null && changeOf(hit, refined)),
    );
    return { node, use, only, ticks };
  }

  /**
   * @param {Part} part
   * @param {number} group
   * @param {string} name
   */
  #tick(part, group, name) {
    const label = `Separate ${part === "from" ? "" : "from "}“${isolated(name)}”`;
    const input = element("input", {
      type: "checkbox",
      tabindex: "-1",
      "data-key": `${part} ${group}`,
      "aria-label": label,
      title: `${label}\nClick with Alt: only this`,
    });
    input.addEventListener("click", (event) => {
      const ticked = event.altKey ? new Set([group]) : this.#ticked(part);
      if (!event.altKey && !ticked.delete(group)) ticked.add(group);
      this.separate(part, [...ticked]);
    });
    return input;
  }

  /**
   * @param {Part} part
   * @returns {Set<number>}
   */
  #ticked(part) {
    /** @type {Separation} */
    const separation = this.state.get("separation");
    return new Set(separation[part] ?? (part === "from" ? this.database.classes.keys() : []));
  }

  /** @param {number} group */
  #toggle(group) {
    const hidden = new Set(this.state.get("hidden"));
    if (!hidden.delete(group)) hidden.add(group);
    this.change(hidden);
  }

  /** @param {number} group */
  #only(group) {
    this.change(new Set(this.groups.filter((other) => other !== group)));
  }

  #mark() {
    const { state } = this;
    const hidden = state.get("hidden");
    const chosen = state.get("separation").against !== null;
    this.table.toggleAttribute("data-against", chosen);
    for (const [group, { node, use, only, ticks }] of this.rows ?? []) {
      const used = !hidden.has(group);
      node.classList.toggle("unused", !used);
      use.setAttribute("aria-pressed", String(used));
      only.disabled = used && hidden.size === this.groups.length - 1;
      for (const [part, tick] of ticks) {
        tick.disabled = !used;
        tick.checked = used && this.#ticked(part).has(group);
      }
    }
    if (this.#stop?.isConnected !== true || this.#stop.disabled) this.#stopAt(this.body.querySelector(".use"));
  }

  /** @type {Stop | null} where the Tab key comes to the rows */
  #stop = null;

  /** @param {Stop | null} next */
  #stopAt(next) {
    if (next === null || next === this.#stop) return;
    if (this.#stop !== null) this.#stop.tabIndex = -1;
    next.tabIndex = 0;
    this.#stop = next;
  }

  /** @param {{ key: string, target: any, altKey: boolean, ctrlKey: boolean, metaKey: boolean, preventDefault: () => void }} event */
  #key(event) {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    /** @type {Stop[][]} */
    const rows = [...(this.rows?.values() ?? [])].map(({ use, only, ticks }) => [use, only, ...ticks.values()]);
    const row = rows.findIndex((own) => own.includes(event.target));
    if (row < 0) return;
    const column = rows[row].indexOf(event.target);
    /** @param {Stop[]} others of which the first that can be used is next */
    const go = (others) => {
      event.preventDefault();
      others.find((other) => other?.disabled === false)?.focus();
    };
    const below = rows.map((own) => own[column]);
    if (event.key === "ArrowDown") go(below.slice(row + 1));
    else if (event.key === "ArrowUp") go(below.slice(0, row).reverse());
    else if (event.key === "Home") go(below);
    else if (event.key === "End") go(below.reverse());
    else if (event.key === "ArrowRight") go(rows[row].slice(column + 1));
    else if (event.key === "ArrowLeft") go(rows[row].slice(0, column).reverse());
  }
}

/** A change of NH that fills its bar. */
const LARGE = 0.5;

/**
 * A change as a bar from the middle and a number.
 * @param {number} before
 * @param {number} after
 */
function changeOf(before, after) {
  const value = change(before, after);
  const bar = element("i", { class: value < 0 ? "worse" : "better" });
  bar.style.setProperty("--length", String(Math.min(Math.abs(value) / LARGE, 1)));
  return [element("span", { class: "scale", "aria-hidden": "true" }, bar), difference(before, after)];
}
