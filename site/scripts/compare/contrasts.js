// What sets two groups apart and what they share, worked out by the engine.

import { sampled } from "../database/sample.js";
import { startEngine } from "../engine/client.js";
import { mean } from "./distribution.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Engine, Job, Listener } from "../engine/client.js" */
/** @import { Contrast as Found } from "../engine/contrast.js" */

/**
 * The rows that speak for both groups, and for all other shapes.
 * @typedef {{ a: number[], b: number[], rest: number[] }} Sample
 */

/** Of a larger group a sample speaks: enough to know a share to two parts in a hundred. */
export const MOST_COMPARED = 500;

const SHUFFLES = 499;
const SEED = 0;

/** A standardised difference of this size is told apart by the eye; larger ones are no clearer. */
const NO_SPREAD = 50;

/** Of the surface, a part by which groups must differ for anybody to see it. */
const SEEN = 0.01;

/** Means so many standard deviations apart tell 98 of 100 pairs of shapes apart: larger differences say no more. */
export const ENOUGH = 3;

export class Contrasts {
  /** @type {Engine | null} */
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
   * The rows of a group that speak for it, rising.
   * @param {number[]} shapes
   */
  #sample(shapes) {
    return [...sampled(Int32Array.from(shapes), this.database.groups, MOST_COMPARED)];
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
      const bins = await this.bins();
      const taken = new Set([...a, ...b]);
      const outside = [...this.database.ids.keys()].filter((index) => !taken.has(index));
      const sample = { a: this.#sample(a), b: this.#sample(b), rest: this.#sample(outside) };
      const rows = [...sample.a, ...sample.b, ...sample.rest];
      const [engine] = await Promise.all([this.#engine ?? startEngine(null), bins.know(rows)]);
      this.#engine = engine;
      /**
       * @param {number} from
       * @param {number} count
       */
      const numbers = (from, count) => Int32Array.from({ length: count }, (_, place) => from + place);
      const own = numbers(0, sample.a.length);
      const others = numbers(own.length, sample.b.length);
      const rest = numbers(own.length + others.length, sample.rest.length);
      const contests = [{ first: own, second: others, shuffles: SHUFFLES }];
      if (rest.length > 1) {
        contests.push({ first: Int32Array.from([...own, ...others]), second: rest, shuffles: SHUFFLES });
        contests.push({ first: own, second: rest, shuffles: 0 }, { first: others, second: rest, shuffles: 0 });
      }
      const values = valuesOf(bins, rows);
      const blocks = Int32Array.from({ length: bins.count }, (_, column) => bins.featureOf(column));
      job = engine.run(
        "contrast",
        { rows: rows.length, values, blocks, weights: this.data.weights, contests, seed: SEED },
        report,
      );
      if (cancelled) job.cancel();
      const [apart, both, ownRest, othersRest] = await job.done;
      return new Contrast(bins, sample, contests, { apart, both, ownRest, othersRest });
    })();
    return {
      done,
      cancel: () => {
        cancelled = true;
        job?.cancel();
      },
    };
  }
}

/**
 * The compared values of some rows, column after column.
 * @param {Bins} bins
 * @param {number[]} rows
 */
function valuesOf(bins, rows) {
  const values = new Float32Array(bins.count * rows.length);
  for (let column = 0; column < bins.count; column += 1) {
    for (let place = 0; place < rows.length; place += 1)
      values[column * rows.length + place] = bins.value(column, rows[place]);
  }
  return values;
}

/** What came out of a comparison. */
export class Contrast {
  /**
   * @param {Bins} bins
   * @param {Sample} sample
   * @param {{ first: Int32Array, second: Int32Array, shuffles: number }[]} contests
   * @param {{ apart: Found, both: Found, ownRest: Found, othersRest: Found }} found
   */
  constructor(bins, sample, contests, { apart, both, ownRest, othersRest }) {
    this.bins = bins;
    this.sample = sample;
    this.apart = apart;
    this.both = both;
    const [{ first, second }] = contests;
    this.difference = Array.from(apart.effect, (effect) => standardised(effect, first.length, second.length));
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
    this.shared = both === undefined ? [] : this.#findShared(contests, ownRest, othersRest);
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
   * @param {{ first: Int32Array, second: Int32Array, shuffles: number }[]} contests
   * @param {Found} ownRest
   * @param {Found} othersRest
   */
  #findShared(contests, ownRest, othersRest) {
    const { bins, both, difference } = this;
    const [own, others] = [2, 3].map((number) => {
      const { first, second } = contests[number];
      const { effect } = number === 2 ? ownRest : othersRest;
      return Array.from(effect, (value) => standardised(value, first.length, second.length));
    });
    /** @param {number} column */
    const clear = (column) => Math.min(Math.abs(own[column]), Math.abs(others[column])) - Math.abs(difference[column]);
    this.against = { a: own, b: others };
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
    const { a, b } = this.sample;
    return this.#apart(column, a, b);
  }

  /**
   * Whether both groups have so much more of a bin than the other shapes, or less, that it shows.
   * @param {number} column
   */
  #isSeen(column) {
    const { a, b, rest } = this.sample;
    return Math.min(this.#apart(column, a, rest), this.#apart(column, b, rest)) >= SEEN;
  }

  /**
   * Whether most shapes of both groups have more of a bin than the mean of the other shapes, or less: not few with much.
   * @param {number} column
   * @param {boolean} more
   */
  #isOfMost(column, more) {
    const { bins, sample } = this;
    const others = mean(sample.rest.map((row) => bins.share(column, row)));
    return [sample.a, sample.b].every(
      (rows) => 2 * rows.filter((row) => bins.share(column, row) > others === more).length > rows.length,
    );
  }

  /**
   * @param {number} column
   * @param {number[]} rows
   * @param {number[]} others
   */
  #apart(column, rows, others) {
    const { bins } = this;
    if (!bins.inPercent(column)) return 1;
    const [own, other] = [rows, others].map((shapes) => mean(shapes.map((row) => bins.share(column, row))));
    return Math.abs(own - other);
  }

  /**
   * Of all pairs of a shape of the first group and one of the second, the share in which the first has more of a bin.
   * @param {number} column
   */
  ahead(column) {
    const { bins, sample } = this;
    const others = sample.b.map((row) => bins.value(column, row)).sort((a, b) => a - b);
    let total = 0;
    for (const row of sample.a) {
      const value = bins.value(column, row);
      const [below, upTo] = [lower(others, value), lower(others, value, true)];
      total += below + (upTo - below) / 2;
    }
    return total / (sample.a.length * sample.b.length);
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
 * Rows by rising distance from the mean of their group: the most central first.
 * @param {number[]} rows
 * @param {Float64Array<ArrayBufferLike>} away
 */
function nearest(rows, away) {
  return [...rows.keys()].sort((one, other) => away[one] - away[other] || one - other).map((place) => rows[place]);
}

/**
 * How many of rising values are below a value, or up to it.
 * @param {number[]} rising
 * @param {number} value
 * @param {boolean} [including]
 */
function lower(rising, value, including = false) {
  let [from, to] = [0, rising.length];
  while (from < to) {
    const middle = (from + to) >> 1;
    if (rising[middle] < value || (including && rising[middle] === value)) from = middle + 1;
    else to = middle;
  }
  return from;
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
