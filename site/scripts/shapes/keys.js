// Mouse, touch and keys in the gallery: going about, opening, selecting.

import { rowAt } from "./layout.js";

/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Active, Grid } from "./grid.js" */

export class Keys {
  /** Where a range of selected shapes starts. */
  /** @type {number | null} */
  #start = null;

  /**
   * @param {Grid} grid
   * @param {GalleryState} state
   * @param {{ leave: (shape: number) => void }} ways is told of the shape whose page a reader opens
   */
  constructor(grid, state, { leave }) {
    this.grid = grid;
    this.state = state;
    this.leave = leave;
    grid.node.addEventListener("click", (event) => this.#click(event));
    grid.node.addEventListener("keydown", (event) => this.#key(event));
    grid.node.addEventListener("focusin", (event) => this.#follow(event.target));
  }

  /** @param {PointerEvent & Targeted} event */
  #click(event) {
    const cell = event.target.closest(".cell");
    const shape = cell === null ? null : Number(cell.dataset.row);
    if (event.target.matches(".tick")) {
      if (shape === null) this.#toggleGroup(event.target);
      else this.#toggle(shape, event.shiftKey);
    } else if (shape !== null && event.shiftKey && event.target.closest("a")) {
      // With Shift a link would open a window of its own; among pictures it means "up to here".
      event.preventDefault();
      this.#toggle(shape, true);
    } else if (shape !== null && event.target.closest("a")) this.leave(shape);
    else {
      const fold = event.target.closest(".fold");
      if (fold) this.#fold(fold.dataset.group ?? "");
    }
  }

  /**
   * @param {number} shape
   * @param {boolean} extend
   */
  #toggle(shape, extend) {
    const selection = new Set(this.state.get("selection"));
    const { placeOf, layout } = this.grid;
    if (extend && this.#start !== null && placeOf[this.#start] >= 0) {
      const [from, to] = [placeOf[this.#start], placeOf[shape]].sort((a, b) => a - b);
      for (const member of layout.sequence.slice(from, to + 1)) selection.add(member);
    } else {
      if (!selection.delete(shape)) selection.add(shape);
      this.#start = shape;
    }
    this.state.set({ selection });
  }

  /** @param {Found} tick */
  #toggleGroup(tick) {
    const { rows } = this.grid.groups[Number(tick.closest(".block")?.dataset.block)];
    const selection = new Set(this.state.get("selection"));
    for (const shape of rows) {
      if (tick.checked) selection.add(shape);
      else selection.delete(shape);
    }
    this.state.set({ selection });
  }

  /** @param {string} key */
  #fold(key) {
    const closed = new Set(this.state.get("closed"));
    if (!closed.delete(key)) closed.add(key);
    const focused = this.grid.node.contains(document.activeElement);
    this.state.set({ closed });
    if (focused) this.grid.go({ shape: null, head: key });
  }

  /**
   * A click, or a screen reader, may take the focus anywhere in the grid.
   * @param {Found} target
   */
  #follow(target) {
    const cell = target.closest(".cell");
    const head = target.closest(".fold");
    if (cell) this.grid.active = { shape: Number(cell.dataset.row), head: null };
    else if (head) this.grid.active = { shape: null, head: head.dataset.group ?? "" };
    else return;
    this.grid.draw();
  }

  /** @param {KeyboardEvent & Targeted} event */
  #key(event) {
    const { grid } = this;
    if (event.altKey) return;
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "a") {
      this.state.set({ selection: new Set(grid.groups.flatMap(({ rows }) => [...rows])) });
      event.preventDefault();
      return;
    }
    if (event.ctrlKey || event.metaKey) return;
    const { shape, head } = grid.active;
    if (event.key === " " && shape !== null && event.target.matches("a")) {
      this.#toggle(shape, event.shiftKey);
      event.preventDefault();
      return;
    }
    if (head !== null && ["ArrowLeft", "ArrowRight"].includes(event.key)) {
      if ((event.key === "ArrowLeft") !== this.state.get("closed").has(head)) this.#fold(head);
      event.preventDefault();
      return;
    }
    const next = this.#next(event.key);
    if (next === undefined) return;
    event.preventDefault();
    if (next === null) return;
    if (event.shiftKey && next.shape !== null) {
      this.#start ??= shape;
      grid.go(next);
      this.#toggle(next.shape, true);
    } else grid.go(next);
  }

  /**
   * Where a key leads; null for nowhere, undefined for a key that does not move.
   * @param {string} key
   * @returns {Active | null | undefined}
   */
  #next(key) {
    const { grid } = this;
    const { layout, placeOf } = grid;
    const { rows, sequence } = layout;
    const { shape } = grid.active;
    const row = grid.activeRow;
    if (row === null) return undefined;
    const place = shape === null ? -1 : placeOf[shape];
    const column = shape === null ? 0 : place - rows[row].start;
    if (key === "ArrowLeft") return this.#at(place - 1);
    if (key === "ArrowRight") return this.#at(place + 1);
    if (key === "Home") return this.#inRow(0, 0);
    if (key === "End") return this.#at(sequence.length - 1);
    if (key === "ArrowUp") return this.#inRow(row - 1, column);
    if (key === "ArrowDown") return this.#inRow(row + 1, column);
    if (key === "PageUp")
      return this.#inRow(
        Math.min(rowAt(rows, Math.max(rows[row].top - grid.page + rows[row].height, 0)), row - 1),
        column,
      );
    if (key === "PageDown")
      return this.#inRow(Math.max(rowAt(rows, rows[row].top + grid.page - rows[row].height), row + 1), column);
    return undefined;
  }

  /** @param {number} place */
  #at(place) {
    const { sequence } = this.grid.layout;
    return place < 0 || place >= sequence.length ? null : { shape: sequence[place], head: null };
  }

  /**
   * @param {number} index
   * @param {number} column
   */
  #inRow(index, column) {
    const { rows, sequence } = this.grid.layout;
    const row = rows[Math.min(Math.max(index, 0), rows.length - 1)];
    if (row.head) return { shape: null, head: this.grid.groups[row.block].key };
    return { shape: sequence[Math.min(row.start + column, row.end - 1)], head: null };
  }
}
