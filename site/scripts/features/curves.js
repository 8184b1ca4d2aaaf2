// Precision against recall: a line for each choice of what is compared.

import { element, svg, watchSize } from "../base/dom.js";

/** @import { Choice } from "./ratings.js" */

/**
 * A choice with its precision at each level; its kind has a colour of its own where it has none.
 * @typedef {Choice & { color: string | null, precision: number[] }} Line
 */

const HEIGHT = 340;
const MARGIN = { left: 44, right: 12, top: 10, bottom: 40 };
const TICKS = [0, 0.25, 0.5, 0.75, 1];

export class Curves {
  /** @type {Line[]} */
  lines = [];
  /** @type {string | null} */
  pointed = null;

  /**
   * @param {Found} node
   * @param {number[]} levels
   * @param {(key: string | null) => void} point is told which line the pointer is at
   */
  constructor(node, levels, point) {
    this.node = node;
    this.levels = levels;
    this.plot = svg("svg", { role: "img", "aria-label": "Precision against recall; the table has the same rows" });
    node.replaceChildren(this.plot);
    this.plot.addEventListener("pointermove", (event) => point(event.target.dataset.key ?? null));
    this.plot.addEventListener("pointerleave", () => point(null));
    watchSize([node], () => this.draw());
  }

  /**
   * Show lines.
   * @param {Line[]} lines
   */
  show(lines) {
    this.lines = lines;
    this.pointed = null;
    this.draw();
  }

  /**
   * Bring one line out, or none.
   * @param {string | null} key
   */
  point(key) {
    this.pointed = key;
    for (const line of this.plot.querySelectorAll("[data-key]"))
      line.classList.toggle("pointed", line.dataset.key === key);
    this.plot.classList.toggle("pointing", key !== null);
    // What is pointed at lies on top of what crosses it.
    const pointed = this.plot.querySelector(".rating-line.pointed");
    if (pointed) pointed.parentElement.append(pointed);
  }

  draw() {
    const width = this.node.clientWidth;
    if (this.lines.length === 0 || width === 0) return;
    const [inner, high] = [width - MARGIN.left - MARGIN.right, HEIGHT - MARGIN.top - MARGIN.bottom];
    /** @param {number} share */
    const x = (share) => MARGIN.left + share * inner;
    /** @param {number} share */
    const y = (share) => MARGIN.top + (1 - share) * high;
    /** @param {number[]} precision */
    const path = (precision) =>
      precision
        .map((value, place) => `${place ? "L" : "M"}${x(this.levels[place]).toFixed(1)} ${y(value).toFixed(1)}`)
        .join("");
    // Later is above: what matters most is drawn last.
    const behind = [...this.lines].reverse();
    this.plot.setAttribute("viewBox", `0 0 ${width} ${HEIGHT}`);
    this.plot.setAttribute("width", width);
    this.plot.setAttribute("height", HEIGHT);
    this.plot.replaceChildren(
      svg(
        "g",
        { class: "axes" },
        TICKS.map((tick) => svg("line", { x1: x(0), x2: x(1), y1: y(tick), y2: y(tick) })),
        TICKS.map((tick) => svg("text", { x: x(0) - 8, y: y(tick) + 4, "text-anchor": "end" }, String(tick))),
        TICKS.map((tick) =>
          svg("text", { x: x(tick), y: y(0) + 16, "text-anchor": tick === 1 ? "end" : "middle" }, String(tick)),
        ),
        svg("text", { x: x(0.5), y: HEIGHT - 4, "text-anchor": "middle" }, "recall: share of them found"),
        svg("text", { transform: `translate(11 ${y(0.5)}) rotate(-90)`, "text-anchor": "middle" }, "precision"),
      ),
      svg(
        "g",
        {},
        behind.map(({ key, kind, color, precision }) =>
          styled(svg("path", { class: "rating-line", "data-kind": kind, "data-key": key, d: path(precision) }), color),
        ),
      ),
      // Lines are thin; a pointer need not be exact.
      svg(
        "g",
        { class: "reach" },
        behind.map(({ key, precision }) => svg("path", { "data-key": key, d: path(precision) })),
      ),
    );
    this.point(this.pointed);
  }
}

/**
 * The line of a choice, short, to stand before its name.
 * @param {Choice["kind"]} kind
 * @param {string | null} color
 */
export function lineMark(kind, color) {
  return element(
    "span",
    { class: "rating-mark", "aria-hidden": "true" },
    svg(
      "svg",
      { viewBox: "0 0 24 8", width: 24, height: 8 },
      styled(svg("path", { class: "rating-line", "data-kind": kind, d: "M0 4H24" }), color),
    ),
  );
}

/**
 * @param {SVGPathElement} path
 * @param {string | null} color
 */
function styled(path, color) {
  if (color) path.style.stroke = color;
  return path;
}
