// The answer to "what makes these two groups alike or different?", before all figures: a few sentences.

import { element } from "../base/dom.js";
import { count, numberWord, percent, percents } from "../base/words.js";
import { worth } from "./contrasts.js";
import { binCount, called, inBoth, moreOf, statement } from "./words.js";

/** @import { Contrast } from "./contrasts.js" */
/** @import { Group } from "./groups.js" */
/** @import { Neighbours } from "./neighbours.js" */

/**
 * On which side of an edge the groups differ, and by how much.
 * @typedef {object} SideOfEdge
 * @property {number} size in standard deviations
 * @property {{ a: number, b: number }} means
 * @property {Chunk.Side} side
 * @property {number} ease
 */

const MOST_TOLD = 3;

/** Standard deviations by which means must differ to be told. */
const TELLING = 0.8;

/** Of the surface, a part by which the groups must differ for anybody to see it. */
const SEEN = 0.03;

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
  const deals = `${percent(apart.all.chance)} on average, and more than ${percent(apart.all.limit)} in one of 100 deals`;
  const spread = [
    "Of all that these shapes differ in, ",
    element("b", {}, percent(apart.all.share)),
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
    kin && element("p", {}, kin),
    element(
      "details",
      { class: "exactly" },
      element("summary", {}, "How sure is this?"),
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
    ),
  ].filter(Boolean);
}

/**
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 */
function headline(contrast, a, b) {
  // No sentence begins with a name, which may be in small letters.
  const both = [called(a), " and ", called(b, ".")];
  const [best] = contrast.beyond;
  if (best === undefined) return ["Different, but only as wholes: ", ...both];
  const ahead = contrast.ahead(best);
  const apart = Math.max(ahead, 1 - ahead);
  if (apart >= CLEARLY) return ["Clearly different: ", ...both];
  return apart >= WELL
    ? ["Different: ", ...both]
    : ["A little different, on average but not shape by shape: ", ...both];
}

/**
 * What is easiest to picture: of each feature that can be, how much of the surface lies on one side of an edge; the edge
 * at which the groups differ most. Before it the best bin, where that one says much more.
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 */
function plainest(contrast, a, b, data) {
  const { apart, beyond, bins, told } = contrast;
  /** @type {Map<number, SideOfEdge>} */
  const best = new Map();
  for (const words of data.sides) {
    const feature = bins.featureOf(words.start);
    if (apart.features[feature].share <= apart.features[feature].limit) continue;
    const side = bestSide(contrast, words);
    const known = best.get(feature);
    if (side !== null && (known === undefined || rank(known, side) > 0)) best.set(feature, side);
  }
  const sides = [...best.values()].sort(rank).slice(0, MOST_TOLD);
  const [first] = beyond.length > 0 ? told : [];
  const much =
    first !== undefined &&
    bins.ease(first) === 1 &&
    contrast.gap(first) >= SEEN &&
    worth(contrast.difference[first], 1) > (sides.length > 0 ? telling(sides[0]) : 0);
  return [
    ...(much ? [statement(first, contrast, a, b, data)] : []),
    ...sides.slice(0, MOST_TOLD - Number(much)).map((side) => sentence(side, a, b, data)),
  ];
}

/**
 * Which of two sides is told first: what leads with what one sees; then the one whose groups are farther apart, and of
 * those that are far enough the one with more to see.
 * @param {SideOfEdge} one
 * @param {SideOfEdge} other
 */
function rank(one, other) {
  return (
    Number(one.side.trend === "") - Number(other.side.trend === "") ||
    telling(other) - telling(one) ||
    gap(other) - gap(one)
  );
}

/** @param {SideOfEdge} side */
function telling({ size, ease }) {
  return worth(size, ease);
}

/** @param {SideOfEdge} side */
function gap({ means }) {
  return Math.abs(means.a - means.b);
}

/**
 * Where the shares of the surface on both sides of an edge differ most; null where nobody would see it.
 * @param {Contrast} contrast
 * @param {Chunk.Sides} words
 * @returns {SideOfEdge | null}
 */
function bestSide({ bins, sizes, values: { a, b } }, { start, below, above }) {
  /** @type {SideOfEdge | null} */
  let best = null;
  for (const edge of below.keys()) {
    const [own, others] = [a.upTo(start + edge), b.upTo(start + edge)];
    const means = { a: own.mean, b: others.mean };
    const squares = sizes.a * own.variance + sizes.b * others.variance;
    const spread = Math.sqrt(squares / Math.max(sizes.a + sizes.b - 2, 1));
    // The side says more of which there is more, else the smaller one.
    const upper = below[edge].fewer || (!above[edge].fewer && means.a + means.b > 1);
    const side = {
      size: Math.abs(means.a - means.b) / Math.max(spread, 0.01),
      means: upper ? { a: 1 - means.a, b: 1 - means.b } : means,
      side: (upper ? above : below)[edge],
      ease: bins.ease(start),
    };
    if (side.size < TELLING || gap(side) < SEEN) continue;
    if (best === null || rank(best, side) > 0) best = side;
  }
  return best;
}

/**
 * @param {SideOfEdge} side
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 */
function sentence({ means, side }, a, b, data) {
  const [more, less] = means.a > means.b ? [a, b] : [b, a];
  return moreOf(side, more, less, percents(means[more.side], means[less.side]), data);
}

/**
 * What both have in common against the other shapes, by the bin that is easiest to picture; null if nothing.
 * @param {Contrast} contrast
 * @param {Group} a
 * @param {Group} b
 * @param {Chunk.Comparison} data
 */
function inCommon(contrast, a, b, data) {
  const { bins, values, shared } = contrast;
  /** @param {number} column */
  const means = (column) => [values.a, values.b, values.rest].map((group) => group.mean(column));
  const column = shared.find((own) => {
    const [first, second, others] = bins.isShare(own) && bins.ease(own) > 1 ? means(own) : [0, 0, 0];
    return Math.min(Math.abs(first - others), Math.abs(second - others)) >= SEEN;
  });
  if (column === undefined) return null;
  return inBoth(column, means(column), { a, b, bins, data });
}

/** @param {Contrast} contrast */
function tooFew({ values }) {
  const fewest = Math.min(values.a.count, values.b.count);
  const deals = waysToDeal(values.a.count, values.b.count);
  if (deals <= 100)
    return ` No difference could show by so few shapes: there are only ${numberWord(deals)} ways to deal them out, and one of them is into these groups.`;
  return fewest < 5 ? ` With ${count(fewest, "shape")} in a group, only very large differences could show.` : "";
}

/**
 * Into how many pairs of groups of two sizes shapes can be dealt.
 * @param {number} first
 * @param {number} second
 */
export function waysToDeal(first, second) {
  let ways = 1;
  for (let place = 1; place <= Math.min(first, second); place += 1)
    ways = (ways * (Math.max(first, second) + place)) / place;
  return first === second ? ways / 2 : ways;
}

/**
 * How often the shapes of two groups are each other's nearest.
 * @param {Group} a
 * @param {Group} b
 * @param {Neighbours} neighbours
 */
export function kinship(a, b, neighbours) {
  const [there, back] = [neighbours.between(a.shapes, b.shapes), neighbours.between(b.shapes, a.shapes)];
  // Where all others are neighbours, any two groups are.
  if (there === null || back === null || neighbours.ofAll) return null;
  if (there === 0 && back === 0)
    return ["No shape of the one is among the ", count(neighbours.k, "shape"), " most like a shape of the other."];
  return [
    "Of the ",
    count(neighbours.k, "shape"),
    " most like a shape of ",
    called(a),
    `, on average ${part(there)} are of `,
    called(b, ";"),
    ` the other way round, ${part(back)}.`,
  ];
}

/** @param {number} share */
function part(share) {
  return share === 0 ? "none" : percent(share);
}
