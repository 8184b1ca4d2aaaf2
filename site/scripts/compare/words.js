// What a comparison says, in sentences a stranger understands. Names of groups come in elements of their own.

import { element } from "../base/dom.js";
import { grouped, percents } from "../base/words.js";
import { mean, toldAs } from "./distribution.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Contrast } from "./contrasts.js" */
/** @import { Group } from "./groups.js" */

/**
 * The name of a group within a sentence.
 * @param {{ name: string, mark: () => SVGElement | null }} group
 */
export function called(group) {
  return element("b", { class: "called" }, group.mark(), element("bdi", {}, group.name));
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
  const { bins, sample } = contrast;
  const values = {
    a: sample.a.map((row) => bins.share(column, row)),
    b: sample.b.map((row) => bins.share(column, row)),
  };
  const means = { a: mean(values.a), b: mean(values.b) };
  const [more, less] = contrast.difference[column] > 0 ? [a, b] : [b, a];
  const told = (bins.isShare(column) ? percents : numbers)(means[more.side], means[less.side]);
  const figures = [element("b", {}, told[0]), "; in ", called(less), ", ", element("b", {}, told[1]), "."];
  if (!bins.isShare(column))
    return ["In ", called(more), ", ", element("bdi", {}, bins.names[column]), " is higher: ", ...figures];
  return ["In ", called(more), `, more of ${data.whole} ${data.clauses[column]}: `, ...figures];
}

/**
 * Values that are no shares, short.
 * @param {...number} values
 */
export function numbers(...values) {
  return values.map(toldAs(false));
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
  const hundredths = Math.round(100 * share);
  return hundredths === 100
    ? "in all pairs"
    : hundredths > 99
      ? "in nearly all pairs"
      : `in ${hundredths} of 100 pairs`;
}

/**
 * A share of the differences in percent, short.
 * @param {number} value
 */
export function share(value) {
  const percents = 100 * value;
  return `${percents < 9.95 ? percents.toFixed(1) : percents.toFixed(0)} %`;
}

/**
 * "412 of 1 870 bins"
 * @param {number} number
 * @param {number} all
 */
export function binCount(number, all) {
  return `${grouped(number)} of ${grouped(all)} bins`;
}
