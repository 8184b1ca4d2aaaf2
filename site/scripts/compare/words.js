// What a comparison says, in sentences a stranger understands. Names of groups come in elements of their own.

import { element } from "../base/dom.js";
import { capitalised, grouped } from "../base/words.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Contrast } from "./contrasts.js" */
/** @import { Group } from "./groups.js" */

/**
 * The name of a group within a sentence, with the point or comma after it, which begins no line.
 * @param {{ name: string, mark: () => SVGElement | null }} group
 * @param {string} [point]
 */
export function called(group, point = "") {
  return element("b", { class: "called" }, group.mark(), element("bdi", {}, group.name), point);
}

/**
 * What a bin says of two groups: the one with more of it, and how much on average.
 * @param {number} column
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 */
export function statement(column, contrast, a, b, data) {
  const { bins, values } = contrast;
  const means = { a: values.a.mean(column), b: values.b.mean(column) };
  const [more, less] = contrast.difference[column] > 0 ? [a, b] : [b, a];
  const told = bins.tell(column, [means[more.side], means[less.side]]);
  return bins.isShare(column)
    ? moreOf({ clause: /** @type {string} */ (data.clauses[column]), trend: "", fewer: false }, more, less, told, data)
    : [...valueName(column, bins), " is higher in ", called(more), " than in ", called(less, ":"), ...against(told)];
}

/**
 * What has a value of its own, as a sentence begins with it.
 * @param {number} column
 * @param {Bins} bins
 */
function valueName(column, bins) {
  const name = bins.called[column];
  // What is put in after a comma ends with one.
  return [element("bdi", {}, capitalised(name) || bins.names[column]), INSERTED.test(name) ? "," : ""];
}

/** A comma that stands in no brackets. */
const INSERTED = /,[^()]*$/;

/**
 * That the surface of one group does something more than that of another: what a stranger sees of it, and how much.
 * @param {Chunk.Side} side
 * @param {Group} more
 * @param {Group} less
 * @param {string[]} told how much of each
 * @param {Chunk.Comparison} data
 */
export function moreOf({ clause, trend }, more, less, [most, least], { whole }) {
  if (trend === "")
    return [`More of ${whole} of `, called(more), " than of ", called(less), ` ${clause}:`, ...against([most, least])];
  return [
    `${trend[0].toUpperCase()}${trend.slice(1)} in `,
    called(more),
    " than in ",
    called(less, ":"),
    " ",
    figureOf(most),
    ` of ${whole} ${clause}, against `,
    figureOf(least),
    ".",
  ];
}

/**
 * A figure within a sentence: a number and its unit, in one line.
 * @param {string} told
 */
function figureOf(told) {
  return element("b", { class: "told" }, told);
}

/** @param {string[]} told */
function against([most, least]) {
  return [" ", figureOf(most), ", against ", figureOf(least), "."];
}

/**
 * What both groups have more of than the other shapes, or those more than both.
 * @param {number} column
 * @param {number[]} means of the first group, of the second, and of the others
 * @param {{ a: Group, b: Group, bins: Bins, data: Chunk.Comparison }} compared
 */
export function inBoth(column, means, { a, b, bins, data }) {
  const [first, second, others] = bins.tell(column, means);
  const more = (means[0] + means[1]) / 2 > means[2];
  const own =
    first === second
      ? ["both ", figureOf(first)]
      : [called(a), " ", figureOf(first), ", ", called(b), " ", figureOf(second)];
  if (!bins.isShare(column))
    return [
      ...valueName(column, bins),
      ` is ${more ? "higher" : "lower"} in both than in other shapes: `,
      ...own,
      ", the others ",
      figureOf(others),
      ".",
    ];
  // Those who have more of it come first, so that nothing is told as less.
  return more
    ? [
        `More of ${data.whole} of both than of other shapes ${data.clauses[column]}: `,
        ...own,
        ", the others ",
        figureOf(others),
        ".",
      ]
    : [
        `More of ${data.whole} of other shapes than of both ${data.clauses[column]}: the others `,
        figureOf(others),
        ", ",
        ...own,
        ".",
      ];
}

/**
 * What low or high values of a feature mean, for a bin near one of its ends; else nothing.
 * @param {number} column
 * @param {Bins} bins
 */
export function meaning(column, bins) {
  const feature = bins.features[bins.featureOf(column)];
  if (!bins.isShare(column)) return null;
  const place = bins.binOf(column) / (feature.bins - 1);
  if (place <= 0.25 && feature.lowMeans) return `Low values mean ${feature.lowMeans}.`;
  if (place >= 0.75 && feature.highMeans) return `High values mean ${feature.highMeans}.`;
  return null;
}

/**
 * "in 97 of 100 pairs"
 * @param {number} share
 */
export function pairs(share) {
  if (share >= 1) return "in all pairs";
  const hundredths = Math.round(100 * share);
  return hundredths === 100 ? "in nearly all pairs" : `in ${hundredths} of 100 pairs`;
}

/**
 * "412 of 1 870 bins"
 * @param {number} number
 * @param {number} all
 */
export function binCount(number, all) {
  return `${grouped(number)} of ${grouped(all)} bins`;
}
