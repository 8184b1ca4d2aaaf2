// A tree of classes to walk down into, and to filter by.

import { element } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { grouped } from "../base/words.js";
import { NONE, valueName } from "../database/fields.js";

/** @import { TreeField } from "../database/fields.js" */
/** @import { Sieve } from "./sieve.js" */

/** Nodes at the top up to which a lone one stands open. */
const FEW_TOPS = 1;

export class Tree {
  /** @type {Set<number>} */
  #open = new Set();
  /** @type {Map<number, HTMLElement>} */
  #items = new Map();
  /** @type {Set<number> | null} */
  filter = null;
  counts = new Int32Array(0);

  /**
   * @param {TreeField} field
   * @param {{ sieve: Sieve, change: (key: string, filter: Set<number> | null) => void }} parts
   */
  constructor(field, { sieve, change }) {
    this.field = field;
    this.sieve = sieve;
    this.change = change;
    const { nodes, of } = field.tree;
    /** @type {number[]} */
    this.tops = [];
    /** @type {Map<number, number[]>} */
    this.children = new Map();
    for (const [node, { parent }] of nodes.entries())
      (parent < 0 ? this.tops : entry(this.children, parent, () => [])).push(node);
    if (this.tops.length <= FEW_TOPS) for (const top of this.tops) this.#open.add(top);
    // Shapes without a class are found too, below all others.
    if (of.includes(NONE)) this.tops.push(NONE);
    this.active = this.tops[0];
    this.node = element("ul", {
      class: "tree",
      role: "tree",
      "aria-label": field.title,
      "aria-multiselectable": "true",
      onclick: (event) => this.#click(event),
      onkeydown: (event) => this.#key(event),
    });
  }

  /** @param {number} node */
  #parent(node) {
    return node === NONE ? NONE : this.field.tree.nodes[node].parent;
  }

  /** @param {number} node */
  #above(node) {
    /** @type {number[]} */
    const found = [];
    for (let above = this.#parent(node); above >= 0; above = this.#parent(above)) found.push(above);
    return found;
  }

  /** @param {Set<number> | null} filter */
  show(filter) {
    const before = this.filter;
    this.filter = filter;
    // What one filters by is in sight, however one came to it.
    if (filter !== before)
      for (const node of filter ?? []) for (const above of this.#above(node)) this.#open.add(above);
    this.counts = this.sieve.countsOfTree(this.field);
    this.#draw();
  }

  #draw() {
    const focused = this.node.contains(document.activeElement);
    this.#items.clear();
    this.node.replaceChildren(...this.tops.map((node) => this.#item(node, 1)));
    if (!this.#items.has(this.active)) this.active = this.tops[0];
    const stop = this.#items.get(this.active);
    if (stop) stop.tabIndex = 0;
    if (focused) stop?.focus();
  }

  /**
   * @param {number} node
   * @param {number} level
   * @returns {HTMLElement}
   */
  #item(node, level) {
    const children = this.children.get(node) ?? [];
    const open = this.#open.has(node);
    const number = this.counts.at(node) ?? 0;
    const item = element(
      "li",
      {
        role: "treeitem",
        tabindex: "-1",
        "data-node": node,
        "aria-level": level,
        "aria-expanded": children.length > 0 ? String(open) : null,
        "aria-checked": this.#checked(node),
      },
      element(
        "div",
        { class: number === 0 && !this.filter?.has(node) ? "node none" : "node" },
        element("span", { class: "chevron", "aria-hidden": "true" }),
        element("span", { class: "box", "aria-hidden": "true" }),
        element(
          "bdi",
          { class: node === NONE ? "value quiet" : "value" },
          node === NONE ? this.#without() : this.field.tree.nodes[node].name,
        ),
        element("span", { class: "size" }, grouped(number)),
      ),
      open &&
        children.length > 0 &&
        element(
          "ul",
          { role: "group" },
          children.map((child) => this.#item(child, level + 1)),
        ),
    );
    this.#items.set(node, item);
    return item;
  }

  #without() {
    return this.field.names === null ? "no folder" : valueName(this.field, NONE);
  }

  /** @param {number} node */
  #checked(node) {
    const { filter } = this;
    if (!filter) return "false";
    if (filter.has(node) || this.#above(node).some((above) => filter.has(above))) return "true";
    return [...filter].some((other) => this.#above(other).includes(node)) ? "mixed" : "false";
  }

  /**
   * Filter by a node: in place of all below it; of a class that was taken as a whole, by this part alone.
   * @param {number} node
   */
  #toggle(node) {
    const filter = new Set(this.filter);
    if (!filter.delete(node)) {
      const above = this.#above(node);
      for (const other of [...filter])
        if (above.includes(other) || this.#above(other).includes(node)) filter.delete(other);
      filter.add(node);
    }
    this.active = node;
    this.change(this.field.key, filter.size > 0 ? filter : null);
  }

  /**
   * @param {number} node
   * @param {boolean} open
   */
  #fold(node, open) {
    if (open) this.#open.add(node);
    else this.#open.delete(node);
    this.active = node;
    this.#draw();
  }

  /** @param {PointerEvent & Targeted} event */
  #click(event) {
    const item = event.target.closest("[role=treeitem]");
    if (!item) return;
    const node = Number(item.dataset.node);
    if (event.target.closest(".chevron") && this.children.has(node)) this.#fold(node, !this.#open.has(node));
    else this.#toggle(node);
  }

  /** @param {KeyboardEvent & Targeted} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const node = this.active;
    // In the order in which they stand.
    const order = [...this.node.querySelectorAll("[role=treeitem]")].map((item) => Number(item.dataset.node));
    const here = order.indexOf(node);
    const parts = this.children.get(node) ?? [];
    const open = this.#open.has(node);
    if (event.key === "ArrowDown") this.#go(order[here + 1]);
    else if (event.key === "ArrowUp") this.#go(order[here - 1]);
    else if (event.key === "Home") this.#go(order[0]);
    else if (event.key === "End") this.#go(order.at(-1));
    else if (event.key === "ArrowRight" && parts.length > 0) open ? this.#go(parts[0]) : this.#fold(node, true);
    else if (event.key === "ArrowLeft")
      open && parts.length > 0 ? this.#fold(node, false) : this.#go(this.#above(node)[0]);
    else if (event.key === "Enter" || event.key === " ") this.#toggle(node);
    else return;
    event.preventDefault();
  }

  /** @param {number} node */
  #go(node) {
    const [before, next] = [this.#items.get(this.active), this.#items.get(node)];
    if (!next) return;
    if (before) before.tabIndex = -1;
    this.active = node;
    next.tabIndex = 0;
    next.focus();
  }
}
