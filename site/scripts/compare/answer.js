// The answer to "what makes these two groups alike or different?", before all figures: a few sentences.

import { element } from "../base/dom.js";
import { count } from "../base/words.js";
import { percent } from "../bins-kit/bin-card.js";
import { varied } from "./contrasts.js";
import { mean } from "./distribution.js";
import { binCount, called, meaning, share, statement } from "./words.js";

/** @import { Contrast } from "./contrasts.js" */
/** @import { Group } from "./groups.js" */
/** @import { Neighbours } from "./neighbours.js" */

/**
 * On which side of an edge the groups differ, and by how much.
 * @typedef {object} SideOfEdge
 * @property {number} size in standard deviations
 * @property {{ a: number, b: number }} means
 * @property {string} where
 * @property {string} place
 * @property {boolean} outer
 */

const MOST_TOLD = 3;

/** Standard deviations by which means must differ to be told. */
const TELLING = 0.8;

/** Single bins tell the groups apart: nearly every shape of one has more of it than nearly every shape of the other. */
const CLEARLY = 0.95;
const WELL = 0.8;

/**
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 * @param {(string | HTMLElement)[] | null} kin
 */
export function answer(contrast, a, b, data, kin) {
  const { apart, beyond, bins } = contrast;
  const deals = `${share(apart.all.chance)} on average, and more than ${share(apart.all.limit)} in one of 100 deals`;
  const spread = [
    "Of all that these shapes differ in, ",
    element("b", {}, share(apart.all.share)),
    ` goes with the group; groups of the same sizes dealt at random reach ${deals}.`,
  ];
  if (!contrast.differ) {
    return [
      element("h2", {}, "Nothing sets ", called(a), " and ", called(b), " apart beyond chance."),
      element(
        "p",
        {},
        spread,
        ` None of ${count(bins.count, "bin")} differs more than some bin does when shapes are dealt out at random.`,
        tooFew(contrast),
      ),
      kin && element("p", {}, kin),
    ].filter(Boolean);
  }
  const told = plainest(contrast, a, b, data);
  const alike = inCommon(contrast, a, b, data);
  return [
    element("h2", {}, headline(contrast, a, b)),
    (told.length > 0 || alike !== null) &&
      element(
        "ul",
        { class: "told-list" },
        told.map((words) => element("li", {}, words)),
        alike && element("li", {}, alike),
      ),
    element(
      "p",
      {},
      spread,
      " ",
      beyond.length > 0
        ? [
            element("b", {}, binCount(beyond.length, bins.count)),
            ` ${beyond.length === 1 ? "differs" : "differ"} more than chance lets any bin differ.`,
          ]
        : "No single bin differs beyond chance: the difference lies in many small ones together.",
    ),
    kin && element("p", {}, kin),
  ].filter(Boolean);
}

/**
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 */
function headline(contrast, a, b) {
  const [best] = contrast.beyond;
  if (best === undefined) return [called(a), " and ", called(b), " differ, but only as wholes."];
  const ahead = contrast.ahead(best);
  const apart = Math.max(ahead, 1 - ahead);
  if (apart >= CLEARLY) return [called(a), " and ", called(b), " are clearly different."];
  return [
    called(a),
    " and ",
    called(b),
    apart >= WELL ? " differ." : " differ a little: on average, not shape by shape.",
  ];
}

/**
 * What is easiest to picture: of features with one value a point, how much of the surface lies on one side of an edge;
 * the edge at which the groups differ most. Without such a feature, the best bin.
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 */
function plainest(contrast, a, b, data) {
  const { apart, bins } = contrast;
  const found = data.sides
    .map((words, feature) =>
      words === null || apart.features[feature].share <= apart.features[feature].limit
        ? null
        : bestSide(contrast, bins.features[feature], words),
    )
    .filter((side) => side !== null)
    .filter((side) => side.size >= TELLING)
    .sort((one, other) => other.size - one.size)
    .slice(0, MOST_TOLD);
  if (found.length === 0)
    return varied(contrast.beyond, bins, 1).map((column) => [
      statement(column, contrast, a, b, data),
      said(meaning(column, bins)),
    ]);
  return found.map((side) => sentence(side, a, b, data));
}

/**
 * Where the shares of the surface below an edge differ most, in standard deviations within the groups.
 * @param {Contrast} contrast
 * @param {Chunk.Feature} feature
 * @param {Chunk.Sides} words
 * @returns {SideOfEdge | null}
 */
function bestSide({ bins, sample }, { start, bins: width, lowMeans, highMeans }, words) {
  const below = { a: new Float64Array(sample.a.length), b: new Float64Array(sample.b.length) };
  /** @type {SideOfEdge | null} */
  let best = null;
  for (let edge = 0; edge < width - 1; edge += 1) {
    for (const side of /** @type {const} */ (["a", "b"]))
      sample[side].forEach((row, place) => (below[side][place] += bins.share(start + edge, row)));
    const means = { a: mean(below.a), b: mean(below.b) };
    const spread = Math.sqrt(
      (squares(below.a, means.a) + squares(below.b, means.b)) / Math.max(sample.a.length + sample.b.length - 2, 1),
    );
    const size = Math.abs(means.a - means.b) / Math.max(spread, 0.01);
    if (best !== null && size <= best.size) continue;
    // The smaller side of the two says more.
    const above = means.a + means.b > 1;
    best = {
      size,
      means: above ? { a: 1 - means.a, b: 1 - means.b } : means,
      where: (above ? words.above : words.below)[edge],
      place: above ? highMeans : lowMeans,
      outer: above ? edge >= width / 2 : edge < width / 2 - 1,
    };
  }
  return best;
}

/**
 * @param {SideOfEdge} side
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 */
function sentence({ means, where, place, outer }, a, b, data) {
  const [more, less] = means.a > means.b ? [a, b] : [b, a];
  const meant = outer && place !== "" ? [" (", place, ")"] : [];
  return [
    "In ",
    called(more),
    ", ",
    element("b", {}, percent(means[more.side])),
    ` of ${data.whole} lies where ${where}`,
    ...meant,
    "; in ",
    called(less),
    ", ",
    element("b", {}, percent(means[less.side])),
    ".",
  ];
}

/**
 * @param {Float64Array} values
 * @param {number} middle
 */
function squares(values, middle) {
  return values.reduce((sum, value) => sum + (value - middle) ** 2, 0);
}

/**
 * What both have in common against the other shapes, by the bin that is easiest to picture; null if nothing.
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 */
function inCommon(contrast, a, b, data) {
  const { bins, sample, shared } = contrast;
  const shares = shared.filter((column) => bins.isShare(column));
  const column = shares.find((own) => bins.features[bins.featureOf(own)].dimensions === 1) ?? shares[0];
  if (column === undefined) return null;
  const [first, second, others] = [sample.a, sample.b, sample.rest].map((rows) =>
    mean(rows.map((row) => bins.share(column, row))),
  );
  const more = first + second > 2 * others;
  return [
    "Of both, ",
    element("b", {}, more ? "more" : "less"),
    ` of ${data.whole} than of other shapes lies where ${data.where[column]}: `,
    called(a),
    ` ${percent(first)}, `,
    called(b),
    ` ${percent(second)}, the others ${percent(others)}.`,
  ];
}

/** @param {string | null} text */
function said(text) {
  return text && element("span", { class: "quiet" }, ` ${text}`);
}

/** @param {Contrast} contrast */
function tooFew({ sample }) {
  const fewest = Math.min(sample.a.length, sample.b.length);
  return fewest < 5 ? ` With ${count(fewest, "shape")} in a group, only very large differences could show.` : "";
}

/**
 * How often the shapes of two groups are each other's nearest.
 * @param {Group} a
 * @param {Group} b
 * @param {Neighbours} neighbours
 */
export function kinship(a, b, neighbours) {
  const [there, back] = [neighbours.between(a.shapes, b.shapes), neighbours.between(b.shapes, a.shapes)];
  /** @param {number} value */
  const told = (value) => `${Math.round(100 * value)} %`;
  if (there === null || back === null) return null;
  if (there === 0 && back === 0)
    return ["No shape of the one is among the ", count(neighbours.k, "nearest neighbour"), " of a shape of the other."];
  return [
    "Of the ",
    count(neighbours.k, "nearest neighbour"),
    " of a shape of ",
    called(a),
    `, ${told(there)} on average are of `,
    called(b),
    `; the other way round it is ${told(back)}.`,
  ];
}
