// The whole of the bars in a strip, and on it the window that is shown large: drag it, or one of its ends.

import { element, penOf } from "../base/dom.js";
import { paintBars } from "../bins-kit/bin-bars.js";

/** @import { Bars } from "../bins-kit/bin-bars.js" */

/**
 * How bars are painted: colours by feature, that of chosen ones, and pixels of the screen a pixel of the page.
 * @typedef {{ colors: string[], accent: string, density: number }} Paints
 *
 * Bars by column, each at a position from 0.
 * @typedef {Pick<Bars, "columns" | "level" | "feature"> & { position: Float32Array }} PlacedBars
 */

/** Pixels below which the ends of the window leave nothing between them. */
const NARROW = 40;

export class BinStrip {
  /** @type {{ kind: "from" | "to" | "move", offset: number } | null} */
  #drag = null;

  /**
   * @param {(from: number, to: number, last: boolean) => void} look is asked to show what lies between two shares of the
   *   whole; `last` says that the end must stay
   */
  constructor(look) {
    this.look = look;
    this.from = 0;
    this.to = 1;
    this.canvas = element("canvas");
    this.window = element(
      "div",
      { class: "window" },
      element("i", { class: "grip from" }),
      element("i", { class: "grip to" }),
    );
    this.node = element("div", { class: "strip-of-bins", "aria-hidden": "true" }, this.canvas, this.window);
    this.node.addEventListener("pointerdown", (event) => this.#down(event));
    this.node.addEventListener("pointermove", (event) => this.#move(event));
    for (const name of ["pointerup", "pointercancel"]) this.node.addEventListener(name, () => (this.#drag = null));
  }

  /**
   * Paint all bars, and lines under the runs of chosen ones.
   * @param {PlacedBars} bars
   * @param {number} count
   * @param {[number, number][]} runs
   * @param {Paints} paints
   */
  paint(bars, count, runs, { colors, accent, density }) {
    const [width, height] = [Math.round(this.node.clientWidth * density), Math.round(this.node.clientHeight * density)];
    Object.assign(this.canvas, { width, height });
    if (count === 0 || width === 0) return;
    const context = penOf(this.canvas);
    const line = Math.round(2 * density);
    const step = width / count;
    const from = bars.position.map((position) => position * step);
    paintBars(
      context,
      { ...bars, from, to: from.map((start) => start + step) },
      { width, base: height - line, room: height - 2 * line, colors },
    );
    context.fillStyle = accent;
    for (const [first, last] of runs)
      context.fillRect(first * step, height - line, Math.max((last + 1 - first) * step, line), line);
  }

  /**
   * Mark what is shown, as shares of the whole.
   * @param {number} from
   * @param {number} to
   */
  show(from, to) {
    this.from = from;
    this.to = to;
    this.node.classList.toggle("whole", to - from > 0.9999);
    this.window.style.left = `${100 * from}%`;
    this.window.style.width = `${100 * (to - from)}%`;
    this.window.classList.toggle("narrow", (to - from) * this.node.clientWidth < NARROW);
  }

  /** @param {PointerEvent} event */
  #share(event) {
    const box = this.node.getBoundingClientRect();
    return (event.clientX - box.left) / box.width;
  }

  /** @param {PointerEvent & Targeted} event */
  #down(event) {
    if (event.button !== 0) return;
    event.preventDefault();
    this.node.setPointerCapture(event.pointerId);
    const share = this.#share(event);
    const width = this.to - this.from;
    const grip = event.target.closest(".grip");
    if (grip) this.#drag = { kind: grip.classList.contains("from") ? "from" : "to", offset: 0 };
    else {
      const inside = this.window.isSameNode(event.target);
      this.#drag = { kind: "move", offset: inside ? share - this.from : width / 2 };
      if (!inside) this.#move(event);
    }
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const drag = this.#drag;
    if (!drag) return;
    const share = Math.min(Math.max(this.#share(event), 0), 1);
    const width = this.to - this.from;
    if (drag.kind === "from") this.look(Math.min(share, this.to), this.to, true);
    else if (drag.kind === "to") this.look(this.from, Math.max(share, this.from), false);
    else {
      const from = Math.min(Math.max(this.#share(event) - drag.offset, 0), 1 - width);
      this.look(from, from + width, false);
    }
  }
}
