// The card of a bin: what it is, how well it separates, and which classes have much of it.

import { element, penOf, swatch } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { styleColor } from "../base/theme.js";
import { count, figure, grouped } from "../base/words.js";
import { axisEnd } from "./bin-bars.js";
import { binName } from "./bin-name.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */

/**
 * What is said of a bin besides itself.
 * @typedef {object} Known
 * @property {Float64Array | number[]} scores relative, a column; NaN where not in use
 * @property {string} scorer its title
 * @property {number[]} separated classes in use by their numbers: those to be separated,
 * @property {number[]} others and the others
 *
 * A class, or all shapes, with the sorted values of a bin.
 * @typedef {object} Row
 * @property {boolean} apart whether it is to be separated
 * @property {string} name
 * @property {SVGElement | null} mark
 * @property {string} color
 * @property {number[]} values
 * @property {number} median
 * @property {number} mean
 */

const WIDTH = 190;
const ROW = 16;
const MOST_ROWS = 20;
/** At the pointer, where it covers what it is compared with. */
const MOST_ROWS_AT_POINTER = 8;
/** Above so many shapes in a class, dots would only be a smear. */
const MOST_DOTS = 60;
const GAP = 8;
const BESIDE = 24;
/** Room for dots beyond the ends of the axis. */
const MARGIN = 8;

export class BinCard {
  /**
   * `bins` is a Bins, `database` the shapes, whose classes give names and colours.
   * @param {Bins} bins
   * @param {Database} database
   */
  constructor(bins, database) {
    this.bins = bins;
    this.database = database;
    this.node = element("div", { class: "card bin-card", hidden: true });
    document.getElementById("content").append(this.node);
    // It stands where its bar stood.
    window.addEventListener("scroll", () => this.hide(), { passive: true });
    /** @type {Known["scores"]} */
    this.scores = [];
    this.scorer = "";
    /** @type {number[]} */
    this.separated = [];
    /** @type {number[]} */
    this.others = [];
    /** @type {Map<number, number[]>} */
    this.members = new Map();
    for (const shape of bins.sample ?? database.groups.keys())
      entry(this.members, database.groups[shape], () => []).push(shape);
  }

  /**
   * Take what is to be said of a bin besides itself.
   * @param {Known} known
   */
  know({ scores, scorer, separated, others }) {
    this.scores = scores;
    this.scorer = scorer;
    this.separated = separated;
    this.others = others;
  }

  /**
   * Show the card of a column at its bar: a box in the window, and `free`, the height down to which the card may hang.
   * @param {number} column
   * @param {{ left: number, top: number, width: number, height: number, free: number }} box
   */
  show(column, box) {
    this.node.replaceChildren(...this.#words(column), this.classes(column, MOST_ROWS_AT_POINTER));
    this.node.hidden = false;
    this.#place(box);
  }

  hide() {
    this.node.hidden = true;
  }

  /** @param {number} column */
  #words(column) {
    const { bins } = this;
    const feature = bins.features[bins.featureOf(column)];
    const means =
      bins.binOf(column) < feature.bins / 2 ? ["Low values: ", feature.lowMeans] : ["High values: ", feature.highMeans];
    const score = Number.isNaN(this.scores[column])
      ? null
      : [figure(this.scores[column]), ` by ${this.scorer}, rank ${grouped(this.#rank(column))}`];
    return [
      element("p", { class: "name" }, binName(bins, column)),
      element("p", {}, bins.sentence(column)),
      bins.isShare(column) && means[1] && element("p", { class: "quiet" }, means, "."),
      score && element("p", { class: "quiet" }, "Score ", element("b", {}, score[0]), score[1]),
    ].filter(Boolean);
  }

  /** @param {number} column */
  #rank(column) {
    /**
     * @param {number} score
     * @param {number} other
     */
    const better = (score, other) => score > this.scores[column] || (score === this.scores[column] && other < column);
    return Array.from(this.scores).filter(better).length + 1;
  }

  /**
   * A row a class: its shapes as dots on one axis, the middle half of them as a band, the median as a line.
   * @param {number} column
   * @param {number} [length] of the list
   */
  classes(column, length = MOST_ROWS) {
    const rows = this.rows(column);
    const shown = rows.slice(0, length);
    const share = this.bins.inPercent(column);
    const lowest = Math.min(...shown.map(({ values }) => values[0]));
    const highest = Math.max(...shown.map(({ values }) => values.at(-1)));
    const [least, most] = share ? [0, Math.min(axisEnd(highest), 1)] : [lowest, highest];
    /** @param {number} value */
    const x = (value) => (most > least ? (WIDTH * (value - least)) / (most - least) : 0);
    const edge = shown.findIndex(({ apart }) => !apart);
    /**
     * @param {number} place
     * @param {...(Node | string | null)} content
     */
    const item = (place, ...content) => element("li", { class: place === edge && edge > 0 ? "first" : null }, content);
    const told = this.bins.telling(column);
    return element(
      "div",
      { class: "of-bin" },
      element(
        "ul",
        { class: "names" },
        shown.map((row, place) => item(place, row.mark, element("bdi", {}, row.name))),
      ),
      strips(shown, edge, x),
      element(
        "ul",
        { class: "medians" },
        shown.map((row, place) => item(place, told(row.median))),
      ),
      element(
        "p",
        { class: "axis" },
        [least, (least + most) / 2, most].map((value) => element("span", {}, told(value))),
      ),
      rows.length > shown.length && element("p", { class: "more" }, `and ${grouped(rows.length - shown.length)} more`),
      this.bins.sample &&
        element("p", { class: "sampled" }, `Of ${grouped(this.bins.rows)} of ${count(this.database.count, "shape")}`),
    );
  }

  /**
   * The classes in use with their sorted values, those to be separated first, those with most of the bin on top.
   * @param {number} column
   * @returns {Row[]}
   */
  rows(column) {
    const { database, members } = this;
    /**
     * @param {number[]} rows
     * @param {boolean} apart
     * @param {string} name
     * @param {SVGElement | null} mark
     * @param {string} color
     */
    const row = (rows, apart, name, mark, color) => {
      const values = rows.map((index) => this.bins.share(column, index)).sort((a, b) => a - b);
      return {
        apart,
        name,
        mark,
        color,
        values,
        median: quantile(values, 0.5),
        mean: values.reduce((a, b) => a + b, 0) / values.length,
      };
    };
    /**
     * @param {Row} a
     * @param {Row} b
     */
    const byHeight = (a, b) => b.median - a.median || b.mean - a.mean;
    /**
     * @param {number[]} groups
     * @param {boolean} apart
     */
    const of = (groups, apart) =>
      groups
        .filter((group) => members.has(group))
        .map((group) =>
          row(
            members.get(group) ?? [],
            apart,
            database.className(group),
            swatch(database.symbol(group), database.color(group)),
            database.color(group),
          ),
        )
        .sort(byHeight);
    const rows = [...of(this.separated, true), ...of(this.others, false)];
    return rows.length > 0 ? rows : [row([...members.values()].flat(), false, "all shapes", null, database.color(-1))];
  }

  /** @param {{ left: number, top: number, width: number, height: number, free: number }} box */
  #place({ left, top, width, height, free }) {
    const { offsetWidth, offsetHeight } = this.node;
    const middle = left + width / 2;
    let x = middle - offsetWidth / 2;
    // Above the tools if there is room, at least above the bars, else below them.
    let y = Math.max(free - GAP - offsetHeight, GAP);
    if (y + offsetHeight > top - GAP) y = top + height + GAP;
    if (y + offsetHeight > window.innerHeight - GAP) {
      y = Math.max(window.innerHeight - offsetHeight - GAP, GAP);
      x = middle + BESIDE + offsetWidth < window.innerWidth ? middle + BESIDE : middle - BESIDE - offsetWidth;
    }
    x = Math.min(Math.max(x, GAP), window.innerWidth - offsetWidth - GAP);
    this.node.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`;
  }
}

/**
 * The rows on a canvas, which is filled faster than hundreds of elements are made; their medians stand beside it in words.
 * @param {Row[]} rows
 * @param {number} edge
 * @param {(value: number) => number} x
 */
function strips(rows, edge, x) {
  const density = window.devicePixelRatio;
  const height = ROW * rows.length;
  const canvas = element("canvas", {
    width: Math.round((WIDTH + 2 * MARGIN) * density),
    height: Math.round(height * density),
    "aria-hidden": "true",
  });
  const context = penOf(canvas);
  context.scale(density, density);
  context.translate(MARGIN, 0);
  context.fillStyle = styleColor("line");
  for (const part of [0, 0.5, 1]) context.fillRect(part * WIDTH, 0, 1, height);
  if (edge > 0) context.fillRect(-MARGIN, ROW * edge, WIDTH + 2 * MARGIN, 1);
  for (const [place, { values, median, color }] of rows.entries()) {
    const middle = (place + 0.5) * ROW;
    const [low, high] = [quantile(values, 0.25), quantile(values, 0.75)].map(x);
    context.fillStyle = color;
    context.globalAlpha = 0.32;
    context.fillRect(low, middle - 5, Math.max(high - low, 1), 10);
    context.globalAlpha = 0.75;
    if (values.length > MOST_DOTS) context.fillRect(x(values[0]), middle - 0.5, x(values.at(-1)) - x(values[0]), 1);
    for (const value of values.length > MOST_DOTS ? [values[0], values.at(-1)] : values) {
      context.beginPath();
      context.arc(x(value), middle, 1.8, 0, 2 * Math.PI);
      context.fill();
    }
    context.globalAlpha = 1;
    context.fillStyle = styleColor("ink");
    context.fillRect(x(median) - 1, middle - 6, 2, 12);
  }
  return canvas;
}

/**
 * A quantile of sorted values.
 * @param {{ length: number, at(place: number): number | undefined }} values
 * @param {number} share
 */
export function quantile(values, share) {
  const place = share * (values.length - 1);
  const below = Math.floor(place);
  const above = Math.min(below + 1, values.length - 1);
  const [low, high] = [values.at(below) ?? Number.NaN, values.at(above) ?? Number.NaN];
  return low + (place - below) * (high - low);
}
