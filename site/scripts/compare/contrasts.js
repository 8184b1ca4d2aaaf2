// What sets two groups apart and what they share, worked out by the engine.

import { RowValues, shareAbove, shareAhead } from "../database/group-values.js";
import { LevelBins } from "../database/level-bins.js";
import { readCounts } from "../database/level-counts.js";
import { MOST_PARTS } from "../database/sample.js";
import { startEngine } from "../engine/client.js";
import { apartBy, pooled } from "../engine/contrast.js";
import { counts, wholeValues } from "./whole-values.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Engine, Job, Listener } from "../engine/client.js" */
/** @import { Contest, Contrast as Found } from "../engine/contrast.js" */
/** @import { GroupValues } from "../database/group-values.js" */
/** @import { CountedValues } from "../database/level-counts.js" */

/**
 * Something of both groups, and of all other shapes.
 * @template Kind
 * @typedef {{ a: Kind, b: Kind, rest: Kind }} OfGroups
 */

/** Of a larger group a sample speaks: enough to know a share to two parts in a hundred. */
const MOST_COMPARED = 500;

/** Where all are known, so many shapes of a group say what chance does, and which is the most central of them. */
const MOST_BESIDE = 200;

/** @type {(keyof OfGroups<any>)[]} */
const SIDES = ["a", "b", "rest"];

/** @type {OfGroups<null>} */
const UNKNOWN = { a: null, b: null, rest: null };

const SHUFFLES = 499;
const SEED = 0;

/** A standardised difference of this size is told apart by the eye; larger ones are no clearer. */
const NO_SPREAD = 50;

/** Of the surface, a part by which groups must differ for anybody to see it. */
const SEEN = 0.01;

/** Means so many standard deviations apart tell 98 of 100 pairs of shapes apart: larger differences say no more. */
export const ENOUGH = 3;

export class Contrasts {
  /** @type {Promise<Engine> | null} */
  #engine = null;

  /**
   * `bins` is a promise of the Bins, which are loaded when two groups are first compared.
   * @param {Database} database
   * @param {Chunk.Comparison} data
   * @param {() => Promise<Bins>} bins
   */
  constructor(database, data, bins) {
    this.database = database;
    this.data = data;
    this.bins = bins;
  }

  /**
   * Begin to compare: { done, cancel }.
   * @param {number[]} a
   * @param {number[]} b
   * @param {Listener} report
   */
  start(a, b, report) {
    /** @type {Job<Found[]> | null} */
    let job = null;
    let cancelled = false;
    const done = (async () => {
      this.#engine ??= startEngine();
      const bins = await this.bins();
      const taken = new Set([...a, ...b]);
      const outside = [...this.database.ids.keys()].filter((index) => !taken.has(index));
      const coming = bins instanceof LevelBins ? this.#whole(bins, { a, b, rest: outside }) : UNKNOWN;
      /**
       * @param {number[]} shapes
       * @param {Promise<GroupValues> | null} known
       */
      const some = (shapes, known) =>
        known === null
          ? bins.some(shapes, this.database.groups, MOST_COMPARED, MOST_PARTS)
          : bins.some(shapes, this.database.groups, MOST_BESIDE);
      const sample = { a: some(a, coming.a), b: some(b, coming.b), rest: some(outside, coming.rest) };
      const rows = [...sample.a, ...sample.b, ...sample.rest];
      const [engine, own, others, left] = await Promise.all([
        this.#engine,
        coming.a,
        coming.b,
        coming.rest,
        bins.know(rows),
      ]);
      const given = {
        rows: rows.length,
        values: bins.valuesOf(rows),
        blocks: Int32Array.from({ length: bins.count }, (_, column) => bins.featureOf(column)),
        weights: this.data.weights,
      };
      const values = {
        a: own ?? new RowValues(bins, sample.a),
        b: others ?? new RowValues(bins, sample.b),
        rest: left ?? new RowValues(bins, sample.rest),
      };
      const allAtHand = coming === UNKNOWN && sample.a.length === a.length && sample.b.length === b.length;
      const { contests, read } = allAtHand
        ? byRows(sample)
        : byMoments(values, { a: a.length, b: b.length, rest: outside.length }, sample, given);
      job = engine.run("contrast", { ...given, contests, seed: SEED }, report, [given.values]);
      if (cancelled) job.cancel();
      return new Contrast(bins, values, sample, read(await job.done));
    })();
    return {
      done,
      cancel: () => {
        cancelled = true;
        job?.cancel();
      },
    };
  }

  /**
   * What is known of all shapes of each group, where they are counted, lie in few parts, or are all that such groups leave;
   * null of others, at once, so that a sample of them is read at the same time.
   * @param {LevelBins} bins
   * @param {OfGroups<number[]>} groups
   * @returns {OfGroups<Promise<GroupValues> | null>}
   */
  #whole(bins, { a, b, rest }) {
    const groups = [a, b, rest].map((shapes) => wholeValues(bins, shapes, this.database));
    const coming = groups.filter((values) => values !== null);
    if (coming.length === groups.length - 1) groups[groups.indexOf(null)] = this.#left(bins, coming);
    const [own, others, outside] = groups;
    return { a: own, b: others, rest: outside };
  }

  /**
   * All shapes but those of some groups.
   * @param {LevelBins} bins
   * @param {Promise<RowValues | CountedValues>[]} groups
   */
  async #left(bins, groups) {
    const [all, ...known] = await Promise.all([readCounts(bins, this.database.classes.length), ...groups]);
    return known
      .filter((values) => values.count > 0)
      .map((values) => counts(values, bins))
      .reduce((left, values) => left.without(values), all);
  }
}

/**
 * What the engine is asked, and how its answers are read.
 * @typedef {object} Asked
 * @property {Contest[]} contests
 * @property {(answers: Found[]) => Differences} read
 *
 * How both groups differ from each other; together from all other shapes, and each from those, with effects as of
 * Contrast; null where there are no others. `sizes` are those that the effects are of.
 * @typedef {{ apart: Found, against: { both: Found, a: Float64Array, b: Float64Array } | null, sizes: OfGroups<number> }} Differences
 */

/**
 * Of the rows themselves.
 * @param {OfGroups<number[]>} sample
 * @returns {Asked}
 */
function byRows(sample) {
  const { a, b, rest } = placesOf(sample);
  const contests = [{ first: a, second: b, shuffles: SHUFFLES }];
  if (rest.length > 1)
    contests.push(
      { first: [...a, ...b], second: rest, shuffles: SHUFFLES },
      { first: a, second: rest, shuffles: 0 },
      { first: b, second: rest, shuffles: 0 },
    );
  return {
    contests,
    read: ([apart, both, own, others]) => ({
      apart,
      against: both ? { both, a: own.effect, b: others.effect } : null,
      sizes: { a: a.length, b: b.length, rest: rest.length },
    }),
  };
}

/**
 * Of means and spreads, which are those of all shapes or of a sample, in the relation of the sizes of the groups; by the
 * rows only what chance does, and who is in the middle.
 * @param {OfGroups<GroupValues>} values
 * @param {OfGroups<number>} sizes
 * @param {OfGroups<number[]>} sample
 * @param {{ blocks: Int32Array, weights: number[] }} given
 * @returns {Asked}
 */
function byMoments(values, sizes, sample, given) {
  const { a, b, rest } = placesOf(sample);
  const [own, others, outside] = SIDES.map((side) => ({ ...values[side].moments(), count: sizes[side] }));
  const [known, knownOthers, knownOutside] = SIDES.map((side) => values[side].count);
  const [dealt, against] = inProportion([a, b], [own.count, others.count]);
  /** @type {Contest[]} */
  const contests = [
    {
      first: dealt,
      second: against,
      shuffles: SHUFFLES,
      whole: {
        ...apartBy(own, others, given),
        sizes: asSure([own.count, others.count], [known, knownOthers]),
      },
    },
    { first: a, second: b, shuffles: 0 },
  ];
  if (outside.count > 1) {
    const [first, second, third] = inProportion([a, b, rest], [own.count, others.count, outside.count]);
    const both = pooled(own, others);
    const knownBoth = both.count ** 2 / (own.count ** 2 / known + others.count ** 2 / knownOthers);
    contests.push({
      first: [...first, ...second],
      second: third,
      shuffles: SHUFFLES,
      whole: {
        ...apartBy(both, outside, given),
        sizes: asSure([both.count, outside.count], [knownBoth, knownOutside]),
      },
    });
  }
  return {
    contests,
    read: ([apart, { away }, both]) => ({
      apart: { ...apart, away },
      against: both
        ? { both, a: apartBy(own, outside, given).effect, b: apartBy(others, outside, given).effect }
        : null,
      sizes,
    }),
  };
}

/**
 * The sizes of two groups in the same relation, of which all shapes would say as much as is known by some: the difference
 * of two means varies by chance as the sum of 1 / n.
 * @param {[number, number]} sizes
 * @param {[number, number]} known
 * @returns {[number, number]}
 */
export function asSure([first, second], [known, others]) {
  const count = first + second;
  const sure = count / (first * second * (1 / known + 1 / others));
  return [Math.max(Math.round(first * sure), 1), Math.max(Math.round(second * sure), 1)];
}

/**
 * Where the rows of each group stand among those of all three.
 * @param {OfGroups<number[]>} sample
 */
function placesOf({ a, b, rest }) {
  /**
   * @param {number} from
   * @param {number} count
   */
  const numbers = (from, count) => Array.from({ length: count }, (_, place) => from + place);
  return {
    a: numbers(0, a.length),
    b: numbers(a.length, b.length),
    rest: numbers(a.length + b.length, rest.length),
  };
}

/**
 * As many of some lists as stand in the relation of some sizes, from all over each list.
 * @param {number[][]} lists
 * @param {number[]} sizes
 */
function inProportion(lists, sizes) {
  const share = Math.min(...lists.map((list, place) => list.length / sizes[place]));
  return lists.map((list, place) => {
    const count = Math.min(Math.max(Math.round(share * sizes[place]), 1), list.length);
    return Array.from({ length: count }, (_, number) => list[Math.floor((number * list.length) / count)]);
  });
}

/** What came out of a comparison. */
export class Contrast {
  /**
   * @param {Bins} bins
   * @param {OfGroups<GroupValues>} values
   * @param {OfGroups<number[]>} sample the shapes of each group that are at hand
   * @param {Differences} found
   */
  constructor(bins, values, sample, { apart, against, sizes }) {
    this.bins = bins;
    this.values = values;
    this.sizes = sizes;
    this.apart = apart;
    this.difference = differences(apart.effect, sizes.a, sizes.b);
    this.ranked = [...this.difference.keys()].filter((column) => apart.effect[column] !== 0);
    this.ranked.sort((one, other) => Math.abs(apart.effect[other]) - Math.abs(apart.effect[one]) || one - other);
    this.beyond = this.ranked.filter((column) => this.isBeyond(column));
    const [shown, seen] = [this.beyond, this.ranked.filter((column) => this.gap(column) >= SEEN)].map(
      (columns) => new Set(columns),
    );
    this.told = [...this.ranked].sort(
      (one, other) =>
        Number(shown.has(other)) - Number(shown.has(one)) ||
        Number(seen.has(other)) - Number(seen.has(one)) ||
        worth(this.difference[other], bins.ease(other)) - worth(this.difference[one], bins.ease(one)) ||
        Math.abs(this.difference[other]) - Math.abs(this.difference[one]),
    );
    this.shared = against === null ? [] : this.#findShared(against);
    this.central = {
      a: nearest(sample.a, apart.away),
      b: nearest(sample.b, apart.away.subarray(sample.a.length)),
    };
  }

  /**
   * Whether a bin differs more than shuffled groups let any bin differ, in all but one of a hundred shuffles.
   * @param {number} column
   */
  isBeyond(column) {
    return Math.abs(this.apart.effect[column]) > this.apart.limit * (1 + 1e-9);
  }

  /** Whether the groups differ at all: as wholes, or in some bin. */
  get differ() {
    return this.apart.all.exceeding <= 0.01 || this.beyond.length > 0;
  }

  /**
   * Bins that both groups have more of than the other shapes, or both less, beyond chance, and in which they are closer
   * to each other than either is to those; the clearest first.
   * @param {NonNullable<Differences["against"]>} against
   */
  #findShared({ both, a, b }) {
    const { bins, difference, sizes } = this;
    const [own, others] = [differences(a, sizes.a, sizes.rest), differences(b, sizes.b, sizes.rest)];
    /** @param {number} column */
    const clear = (column) => Math.min(Math.abs(own[column]), Math.abs(others[column])) - Math.abs(difference[column]);
    return [...difference.keys()]
      .filter(
        (column) =>
          Math.abs(both.effect[column]) > both.limit * (1 + 1e-9) &&
          own[column] * others[column] > 0 &&
          !this.isBeyond(column) &&
          clear(column) > 0 &&
          // To have less of "hardly any" is to have more of something else, which other bins say plainly.
          (own[column] > 0 || bins.binOf(column) > 0 || bins.features[bins.featureOf(column)].dimensions === 1) &&
          this.#isSeen(column) &&
          this.#isOfMost(column, own[column] > 0),
      )
      .sort(
        (one, other) =>
          worth(clear(other), bins.ease(other)) - worth(clear(one), bins.ease(one)) ||
          clear(other) - clear(one) ||
          one - other,
      );
  }

  /**
   * By how much of the surface the two groups differ in a bin, on average; the same of a share of pairs of
   * places; of any other value, by all there is.
   * @param {number} column
   */
  gap(column) {
    const { a, b } = this.values;
    return this.#apart(column, a, b);
  }

  /**
   * Whether both groups have so much more of a bin than the other shapes, or less, that it shows.
   * @param {number} column
   */
  #isSeen(column) {
    const { a, b, rest } = this.values;
    return Math.min(this.#apart(column, a, rest), this.#apart(column, b, rest)) >= SEEN;
  }

  /**
   * Whether most shapes of both groups have more of a bin than the mean of the other shapes, or less: not few with much.
   * @param {number} column
   * @param {boolean} more
   */
  #isOfMost(column, more) {
    const { a, b, rest } = this.values;
    const others = rest.mean(column);
    return [a, b].every((group) => {
      const above = shareAbove(group.points(column), others);
      return (more ? above : 1 - above) > 0.5;
    });
  }

  /**
   * @param {number} column
   * @param {GroupValues} group
   * @param {GroupValues} other
   */
  #apart(column, group, other) {
    return this.bins.inPercent(column) ? Math.abs(group.mean(column) - other.mean(column)) : 1;
  }

  /**
   * Of all pairs of a shape of the first group and one of the second, the share in which the first has more of a bin.
   * @param {number} column
   */
  ahead(column) {
    const { a, b } = this.values;
    return shareAhead(a.points(column), b.points(column));
  }
}

/**
 * What a difference is worth being told: as often as it is easily pictured, and beyond ENOUGH nothing says more.
 * @param {number} difference in standard deviations
 * @param {number} ease
 */
export function worth(difference, ease) {
  return Math.min(Math.abs(difference), ENOUGH) * ease;
}

/**
 * A difference of means in standard deviations within the groups, from its share of the spread.
 * @param {number} effect
 * @param {number} first
 * @param {number} second
 */
function standardised(effect, first, second) {
  const share = Math.abs(effect);
  if (share >= 1 - 1e-9) return Math.sign(effect) * NO_SPREAD;
  const count = first + second;
  return (
    Math.sign(effect) *
    Math.min(Math.sqrt(((share / (1 - share)) * Math.max(count - 2, 1) * count) / (first * second)), NO_SPREAD)
  );
}

/**
 * Effects as differences of means, in standard deviations within the groups.
 * @param {Float64Array} effects
 * @param {number} first how many shapes
 * @param {number} second
 */
function differences(effects, first, second) {
  return Array.from(effects, (effect) => standardised(effect, first, second));
}

/**
 * Rows by rising distance from the mean of their group: the most central first.
 * @param {number[]} rows
 * @param {Float64Array<ArrayBufferLike>} away
 */
function nearest(rows, away) {
  return [...rows.keys()].sort((one, other) => away[one] - away[other] || one - other).map((place) => rows[place]);
}

/**
 * The first of some bins that do not say the same: one a dimension, and two a feature at most.
 * @param {number[]} columns
 * @param {Bins} bins
 * @param {number} most
 */
export function varied(columns, bins, most) {
  const [dimensions, features] = [new Set(), new Map()];
  const chosen = [];
  for (const column of columns) {
    const feature = bins.featureOf(column);
    const dimension = column - bins.binOf(column);
    const told = features.get(feature) ?? 0;
    if (dimensions.has(dimension) || told >= 2) continue;
    dimensions.add(dimension);
    features.set(feature, told + 1);
    chosen.push(column);
    if (chosen.length === most) break;
  }
  return chosen;
}
