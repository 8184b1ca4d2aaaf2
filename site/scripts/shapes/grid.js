// The gallery itself: of thousands of shapes only the rows in sight, and a few around them, are in the page.

import { element, watchSize } from "../base/dom.js";
import { layOut, rowAt } from "./layout.js";

/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Cells } from "./cells.js" */
/** @import { Group, Layout } from "./layout.js" */

/**
 * Where the keys are: a shape, or the head of a group by its key.
 * @typedef {{ shape: number | null, head: string | null }} Active
 * @typedef {{ shape: number, offset: number }} Anchor a shape, and how far below the upper edge it lies
 */

/** Pixels above and below the window that are drawn already. */
const AHEAD = 500;

/** Who scrolls by more than this in a frame sees no picture: they are loaded when the scrolling slows down. */
const RUSH = 700;
const CALM = 80;

export class Grid {
  /** @type {Group[]} */
  #groups = [];
  /** @type {Cells | null} */
  #cells = null;
  /** @type {Map<number, HTMLElement>} */
  #made = new Map();
  /** @type {Map<number, HTMLElement>} */
  #rows = new Map();
  /** @type {Map<number, HTMLElement>} */
  #sections = new Map();
  /** @type {number | null} */
  #pending = null;
  /** @type {Set<number>} */
  #unpictured = new Set();
  #top = 0;
  /** @type {{ shape: number, top: number } | null} */
  #held = null;
  /** @type {number | undefined} */
  #calming;
  /** @type {Layout} as long as there are cells */
  layout;
  width = 0;

  /**
   * @param {Database} database
   * @param {GalleryState} state
   */
  constructor(database, state) {
    this.database = database;
    this.state = state;
    this.node = document.getElementById("grid");
    this.scroller = document.getElementById("scroller");
    this.placeOf = new Int32Array(database.count).fill(-1);
    /** @type {Active} */
    this.active = { shape: null, head: null };
    // Caught on the way down: on a desk the frame scrolls, on a phone the page.
    document.addEventListener("scroll", () => this.#drawSoon(), { capture: true, passive: true });
    watchSize([this.node], () => this.#resize());
  }

  /**
   * Show groups of shapes as cells; what is at the top stays there if it can, unless `fromTop`.
   * @param {Group[]} groups
   * @param {Cells} cells
   * @param {boolean} fromTop
   */
  show(groups, cells, fromTop) {
    const anchor = fromTop ? null : this.#anchor();
    const focused = this.node.contains(document.activeElement);
    const place = this.active.shape === null ? -1 : this.placeOf[this.active.shape];
    if (cells !== this.#cells) this.#made.clear();
    this.#groups = groups;
    this.#cells = cells;
    this.#layOut(cells);
    if (fromTop) this.#scrollBy(-Math.max(this.#window().top, 0));
    else this.#hold(anchor);
    const { sequence } = this.layout;
    // Where the shape with the focus has gone, the one in its place has it.
    if (focused && place >= 0 && this.placeOf[this.active.shape ?? -1] < 0)
      this.active = { shape: sequence[Math.min(place, sequence.length - 1)] ?? null, head: null };
    this.draw();
    if (focused) this.#stop()?.focus({ preventScroll: true });
    this.#showPictures(false);
  }

  /** The same groups with other pictures' sizes, or other groups folded. */
  rearrange() {
    if (this.#cells === null) return;
    const anchor = this.#anchor();
    this.#layOut(this.#cells);
    this.#hold(anchor);
    this.draw();
    this.#showPictures(false);
  }

  #resize() {
    // On paper, and back from it, other rows are drawn.
    if (this.node.clientWidth === this.width && this.#whole === onSheet()) return;
    this.rearrange();
  }

  /** @param {Cells} cells */
  #layOut({ lines }) {
    this.width = this.node.clientWidth;
    const text = parseFloat(getComputedStyle(document.documentElement).fontSize);
    this.layout = layOut(this.#groups, this.state.get("closed"), {
      width: this.width,
      size: this.state.get("size"),
      lines,
      text,
    });
    this.placeOf.fill(-1);
    for (const [place, shape] of this.layout.sequence.entries()) this.placeOf[shape] = place;
    this.#rows.clear();
    this.#sections.clear();
    const { height, columns, cell, gap, captioned, rows } = this.layout;
    this.node.replaceChildren();
    this.node.style.height = `${height}px`;
    this.node.style.setProperty("--columns", String(columns));
    this.node.style.setProperty("--cell", `${cell}px`);
    this.node.style.setProperty("--gap", `${gap}px`);
    this.node.classList.toggle("captioned", captioned);
    this.node.setAttribute("aria-rowcount", rows.length);
    this.node.setAttribute("aria-colcount", columns);
  }

  #whole = false;

  /** What of the gallery is in the window, from top to bottom; all of it, on paper. */
  #window() {
    this.#whole = onSheet();
    if (this.#whole) return { top: 0, bottom: Infinity };
    const own = this.node.getBoundingClientRect();
    const frame = this.#framed()
      ? this.scroller.getBoundingClientRect()
      : { top: this.#covered(), bottom: window.innerHeight };
    return { top: frame.top - own.top, bottom: frame.bottom - own.top };
  }

  #framed() {
    return getComputedStyle(this.scroller).overflowY === "auto";
  }

  /** How much of a phone's window the controls above the gallery cover. */
  #covered() {
    return parseFloat(getComputedStyle(this.node).getPropertyValue("--covered-above")) || 0;
  }

  /** @param {number} distance */
  #scrollBy(distance) {
    (this.#framed() ? this.scroller : window).scrollBy({ top: distance, behavior: "instant" });
  }

  /**
   * The first shape that is whole in sight.
   * @returns {Anchor | null}
   */
  #anchor() {
    if (!this.layout || this.layout.rows.length === 0) return null;
    const { top } = this.#window();
    if (top <= 0) return null;
    const { rows, sequence, rowOf, head } = this.layout;
    // Who pulls at the size, and does not scroll, keeps one shape through all sizes.
    if (this.#held !== null && Math.abs(this.#held.top - top) < 2 && this.placeOf[this.#held.shape] >= 0) {
      return { shape: this.#held.shape, offset: rows[rowOf[this.placeOf[this.#held.shape]]].top - top };
    }
    const edge = top + (this.#groups[0].title === null ? 0 : head);
    const row = rows.slice(rowAt(rows, edge)).find((found) => !found.head && found.top >= edge);
    return row ? { shape: sequence[row.start], offset: row.top - top } : null;
  }

  /** @param {Anchor | null} anchor */
  #hold(anchor) {
    if (anchor === null) return;
    const place = this.placeOf[anchor.shape];
    if (place < 0) return;
    this.#scrollBy(this.layout.rows[this.layout.rowOf[place]].top - anchor.offset - this.#window().top);
    this.#held = { shape: anchor.shape, top: this.#window().top };
  }

  #drawSoon() {
    this.#pending ??= requestAnimationFrame(() => {
      this.#pending = null;
      this.draw();
    });
  }

  draw() {
    const { rows } = this.layout;
    const { top, bottom } = this.#window();
    const focused = this.node.contains(document.activeElement);
    if (!focused) this.#moveTabStop(top, bottom);
    const wanted = new Set();
    for (let index = rowAt(rows, top - AHEAD); index < rows.length && rows[index].top < bottom + AHEAD; index += 1)
      wanted.add(index);
    // The row with the focus stays, or the focus would be lost with it.
    const kept = this.#rowOfActive();
    if (kept !== null) wanted.add(kept);
    const blocks = new Set([...wanted].map((index) => rows[index].block));
    for (const [index, row] of this.#rows) {
      if (wanted.has(index)) continue;
      row.remove();
      this.#rows.delete(index);
    }
    for (const [block, section] of this.#sections) {
      if (blocks.has(block)) continue;
      section.remove();
      this.#sections.delete(block);
    }
    /** @type {Map<number, HTMLElement>} */
    const made = new Map();
    for (const block of [...blocks].sort((a, b) => a - b)) if (!this.#sections.has(block)) this.#addSection(block);
    for (const index of wanted) if (!rows[index].head && !this.#rows.has(index)) this.#addRow(index);
    for (const index of this.#rows.keys())
      for (const shape of this.#shapesOf(index)) {
        const cell = this.#made.get(shape);
        if (cell) made.set(shape, cell);
      }
    this.#made = made;
    this.#markActive();
    this.#showPictures(Math.abs(top - this.#top) > RUSH);
    this.#top = top;
  }

  /** @param {boolean} rushing */
  #showPictures(rushing) {
    clearTimeout(this.#calming);
    if (rushing) {
      this.#calming = setTimeout(() => this.#showPictures(false), CALM);
      return;
    }
    for (const shape of this.#unpictured) {
      const picture = /** @type {HTMLImageElement | null} */ (this.#made.get(shape)?.querySelector("img") ?? null);
      if (picture) this.database.pictures.show(picture, shape);
    }
    this.#unpictured.clear();
  }

  /**
   * A group: its head stays in sight as long as one of its rows does.
   * @param {number} block
   */
  #addSection(block) {
    const group = this.#groups[block];
    const { top, height, folded } = this.layout.blocks[block];
    const section = element("div", { class: "block", role: "rowgroup", "data-block": block });
    section.style.top = `${top}px`;
    section.style.height = `${height}px`;
    if (group.title !== null) {
      const head = element(
        "div",
        { class: "block-head", role: "row", "aria-rowindex": rowAt(this.layout.rows, top) + 1 },
        this.#cells?.head(group, folded) ?? [],
      );
      section.append(head);
    }
    const after = [...this.#sections].find(([other]) => other > block)?.[1] ?? null;
    this.node.insertBefore(section, after);
    this.#sections.set(block, section);
    this.#sections = new Map([...this.#sections].sort(([a], [b]) => a - b));
    this.#markGroup(block);
  }

  /** @param {number} index */
  #addRow(index) {
    const { block, top } = this.layout.rows[index];
    const selection = this.state.get("selection");
    const cells = this.#shapesOf(index).map((shape) => {
      const known = this.#made.get(shape);
      if (known !== undefined) return known;
      const cell = /** @type {Cells} */ (this.#cells).shape(shape, selection.has(shape));
      this.#made.set(shape, cell);
      this.#unpictured.add(shape);
      return cell;
    });
    const row = element("div", { class: "row", role: "row", "aria-rowindex": index + 1 }, cells);
    row.style.top = `${top - this.layout.blocks[block].top}px`;
    const after =
      [...this.#rows]
        .filter(([other]) => other > index && this.layout.rows[other].block === block)
        .sort(([a], [b]) => a - b)[0]?.[1] ?? null;
    this.#sections.get(block)?.insertBefore(row, after);
    this.#rows.set(index, row);
  }

  /** @param {number} index */
  #shapesOf(index) {
    const { start, end } = this.layout.rows[index];
    return this.layout.sequence.slice(start, end);
  }

  /** Show which shapes are selected. */
  mark() {
    const selection = this.state.get("selection");
    for (const [shape, cell] of this.#made) {
      const selected = selection.has(shape);
      cell.setAttribute("aria-selected", String(selected));
      cell.querySelector(".tick").checked = selected;
    }
    for (const block of this.#sections.keys()) this.#markGroup(block);
    this.node.classList.toggle("selecting", selection.size > 0);
  }

  /** @param {number} block */
  #markGroup(block) {
    const tick = this.#sections.get(block)?.querySelector(".block-head .tick");
    if (!tick) return;
    const selection = this.state.get("selection");
    const { rows } = this.#groups[block];
    const selected = selection.size === 0 ? 0 : rows.filter((shape) => selection.has(shape)).length;
    tick.checked = selected === rows.length;
    tick.indeterminate = selected > 0 && selected < rows.length;
  }

  /** The groups as they are shown. */
  get groups() {
    return this.#groups;
  }

  // Where the keys are

  #rowOfActive() {
    const { shape, head } = this.active;
    if (head !== null) {
      const block = this.#groups.findIndex(({ key }) => key === head);
      const row = this.layout.rows.findIndex((found) => found.head && found.block === block);
      return row < 0 ? null : row;
    }
    return shape === null || this.placeOf[shape] < 0 ? null : this.layout.rowOf[this.placeOf[shape]];
  }

  // While the focus is elsewhere, the Tab key leads to what is in sight.
  /**
   * @param {number} top
   * @param {number} bottom
   */
  #moveTabStop(top, bottom) {
    const { rows, sequence } = this.layout;
    const row = this.#rowOfActive();
    if (row !== null && rows[row].top + rows[row].height > top && rows[row].top < bottom) return;
    const first = rows.slice(rowAt(rows, top), rowAt(rows, bottom) + 1);
    const whole = first.find((found) => !found.head && found.top >= top) ?? first.find((found) => !found.head);
    if (whole) this.active = { shape: sequence[whole.start], head: null };
    else if (first.length > 0) this.active = { shape: null, head: this.#groups[first[0].block].key };
    else this.active = { shape: null, head: null };
  }

  #markActive() {
    for (const stop of this.node.querySelectorAll("[tabindex='0']")) stop.tabIndex = -1;
    const stop = this.#stop();
    if (stop) stop.tabIndex = 0;
  }

  /** The element that keys start from. */
  #stop() {
    const { shape, head } = this.active;
    if (head === null) return this.#made.get(shape ?? -1)?.querySelector("a") ?? null;
    const block = this.#groups.findIndex(({ key }) => key === head);
    return this.#sections.get(block)?.querySelector(".fold") ?? null;
  }

  /**
   * Take the focus to a shape or a head, and both into sight.
   * @param {Active} active
   */
  go(active) {
    this.active = active;
    this.reveal();
    this.draw();
    this.#stop()?.focus({ preventScroll: true });
  }

  /** Scroll until what is active is in sight; into the middle of the window if it was far away. */
  reveal() {
    const index = this.#rowOfActive();
    if (index === null) return;
    const { top: rowTop, height, head } = this.layout.rows[index];
    const { top, bottom } = this.#window();
    const above = head || this.#groups[0].title === null ? 0 : this.layout.head;
    const [start, end] = [rowTop - above, rowTop + height];
    if (end < top - AHEAD || start > bottom + AHEAD) this.#scrollBy((start + end - top - bottom) / 2);
    else if (start < top) this.#scrollBy(start - top);
    else if (end > bottom) this.#scrollBy(end - bottom);
  }

  /**
   * Begin at a shape: it is in the middle of the window, and the Tab key leads to it.
   * @param {number | null} shape
   */
  start(shape) {
    this.active = { shape, head: null };
    this.reveal();
    this.draw();
    this.#showPictures(false);
  }

  /** The height of the window. */
  get page() {
    const { top, bottom } = this.#window();
    return bottom - top;
  }

  get activeRow() {
    return this.#rowOfActive();
  }
}

/** Whether the page is being printed. */
function onSheet() {
  return document.documentElement.dataset.paper === "page";
}
