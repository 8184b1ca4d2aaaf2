// How much of a bin each of some groups has: a row a group, all on one axis.

import { element, svg } from "../base/dom.js";
import { measured, percent } from "../base/words.js";
import { axisEnd } from "../bins-kit/bin-bars.js";

/** @import { Point } from "../database/group-values.js" */

/**
 * A group's values, rising, each of them a shape or not, and their mean; `at` is one that stands out.
 * @typedef {object} Row
 * @property {SVGElement | null} mark
 * @property {string} name
 * @property {string} color
 * @property {Point[]} points
 * @property {boolean} each
 * @property {number} mean
 * @property {number} [at]
 */

/** Above so many shapes in a group, dots would only be a smear: then bars say how many lie where. */
export const MOST_DOTS = 60;
const BARS = 28;
const ROW = 22;

/**
 * Whether a group's shapes are dots.
 * @param {{ count: number, each: boolean }} values
 */
export function hasDots({ count, each }) {
  return each && count <= MOST_DOTS;
}

/**
 * @param {Row[]} rows
 * @param {boolean} share whether values are shares
 */
export function distribution(rows, share) {
  const all = rows.flatMap(({ points, at }) => [
    ...points.map(({ value }) => value),
    ...(at === undefined ? [] : [at]),
  ]);
  const [lowest, highest] = [Math.min(...all), Math.max(...all)];
  const [least, most] = share ? [0, Math.min(axisEnd(highest), 1)] : [lowest, highest > lowest ? highest : lowest + 1];
  /** @param {number} value */
  const place = (value) => 2 + (96 * (value - least)) / (most - least);
  const told = share ? (/** @type {number} */ value) => percent(value) : measured;
  return element(
    "div",
    { class: "spread-of" },
    rows.map((row) => [
      element("span", { class: "group-name", title: row.name }, row.mark, element("bdi", {}, row.name)),
      strip(row, place),
      element("span", { class: "mean" }, told(row.mean)),
    ]),
    element("span", { class: "group-name" }),
    element(
      "span",
      { class: "axis-of", "aria-hidden": "true" },
      [least, (least + most) / 2, most].map((value) => element("i", {}, told(value))),
    ),
    element("span", { class: "mean quiet" }, "mean"),
  );
}

/**
 * @param {Row} row
 * @param {(value: number) => number} place
 */
function strip({ points, each, mean, color, at }, place) {
  const parts = hasDots({ count: points.length, each })
    ? dots(
        points.map(({ value }) => value),
        color,
        place,
      )
    : bars(points, color, place);
  const line = svg("rect", { x: `${place(mean)}%`, y: 2, width: 2, height: ROW - 4, class: "at-mean" });
  const outstanding =
    at !== undefined && svg("circle", { cx: `${place(at)}%`, cy: ROW / 2, r: 5, class: "outstanding" });
  return svg("svg", { class: "dots-of", height: ROW, width: "100%", "aria-hidden": "true" }, parts, line, outstanding);
}

/**
 * @param {number[]} rising
 * @param {string} color
 * @param {(value: number) => number} place
 */
function dots(rising, color, place) {
  /** @param {number} share */
  const quantile = (share) => rising[Math.round(share * (rising.length - 1))];
  const [low, high] = [place(quantile(0.25)), place(quantile(0.75))];
  const band = svg("rect", {
    x: `${low}%`,
    y: 5,
    width: `${Math.max(high - low, 0.4)}%`,
    height: ROW - 10,
    class: "band",
  });
  const marks = rising.map((value) => svg("circle", { cx: `${place(value)}%`, cy: ROW / 2, r: 2.2 }));
  const group = svg("g", {}, band, marks);
  group.style.fill = color;
  return group;
}

/**
 * @param {Point[]} points
 * @param {string} color
 * @param {(value: number) => number} place
 */
function bars(points, color, place) {
  const counts = new Array(BARS).fill(0);
  for (const { value, weight } of points)
    counts[Math.min(Math.floor(((place(value) - 2) / 96) * BARS), BARS - 1)] += weight;
  const most = Math.max(...counts);
  const width = 96 / BARS;
  const marks = counts.map((count, bar) => {
    const height = count === 0 ? 0 : Math.max((count / most) * (ROW - 4), 1);
    return svg("rect", { x: `${2 + bar * width}%`, y: ROW - 2 - height, width: `${width * 0.92}%`, height });
  });
  const group = svg("g", {}, marks);
  group.style.fill = color;
  return group;
}
