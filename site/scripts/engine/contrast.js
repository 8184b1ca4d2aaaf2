// The task "contrast": how far groups of shapes are apart, bin by bin, and how far groups dealt at random would be.

import { Random } from "./random.js";

/**
 * Two groups of rows without a common one, and how often they are dealt out anew. Where they are a sample of what is
 * known as a whole, in proportion, only chance is known by them.
 * @typedef {object} Contest
 * @property {Int32Array | number[]} first
 * @property {Int32Array | number[]} second
 * @property {number} shuffles
 * @property {Whole} [whole]
 *
 * What is known of the compared values of a group, column by column.
 * @typedef {{ count: number, means: Float64Array, variances: Float64Array }} Moments
 *
 * How far two groups are apart, as Contrast has it: the share of each feature, and last of all.
 * @typedef {{ sizes: [number, number], effect: Float64Array, shares: Float64Array }} Whole
 *
 * The values of a table, and what a squared difference in each feature counts.
 * @typedef {{ rows: number, values: Float32Array, blocks: Int32Array, weights: number[] }} Given
 *
 * The columns of both groups, first group first, and their spread; `totals` by feature, last of all.
 * @typedef {object} Standard
 * @property {Float32Array} points
 * @property {Float64Array} spread
 * @property {Float64Array} totals
 * @property {Int32Array} blocks the feature of every column
 * @property {number} columns
 * @property {number} count
 * @property {number} features
 *
 * A share of the spread, beside what groups dealt at random have.
 * @typedef {object} Share
 * @property {number} share
 * @property {number} chance mean of the deals
 * @property {number} limit exceeded in one of a hundred
 * @property {number} exceeding share of deals, the observed one included, that reach it
 *
 * @typedef {object} Contrast
 * @property {Float64Array} effect a column's share of the spread between the groups, eta squared: (difference of the means)²
 *   in relation to all squared deviations from the common mean; positive where the first group has more
 * @property {number} limit what the largest effect of any column exceeds in one of a hundred deals
 * @property {Share[]} features the same share for the columns of each feature
 * @property {Share} all and for all columns together
 * @property {Float64Array} away squared distance of every row from the mean of its group, first group first; of none where
 *   only chance is known by the rows
 */

/** The share of shuffles that may reach a difference which still counts as beyond chance. */
const CHANCE = 0.01;

/** Of two groups that are both larger a part is dealt out, the smaller one of so many rows: chance is as well known by it. */
const MOST_DEALT = 100;

/** Additions between two reports: a few milliseconds of work. */
const WORK = 4e6;

/** Columns that are dealt out together: a place among the rows is read once for so many additions, which do not wait for each other. */
const ABREAST = 8;

/**
 * Contrasts between groups of rows, one answer a contest.
 *
 * @param {FeatureValues} _table
 * @param {Given & { contests: Contest[], seed: number }} task
 * @returns {Steps<Contrast[]>}
 */
export function* contrast(_table, { rows, values, blocks, weights, contests, seed }) {
  const answers = [];
  for (const [number, contest] of contests.entries()) {
    const steps = compare({ rows, values, blocks, weights }, contest, seed);
    let step = steps.next();
    while (step.done !== true) {
      yield { progress: (number + step.value) / contests.length };
      step = steps.next();
    }
    answers.push(step.value);
  }
  return answers;
}

/**
 * @param {Given} given
 * @param {Contest} contest
 * @param {number} seed
 * @returns {Generator<number, Contrast, void>}
 */
function* compare(given, { first, second, shuffles, whole }, seed) {
  const standard = standardised(given, first, second);
  const { columns } = standard;
  yield 0;
  const own = smaller(first, second);
  const { effect, shares: observed, sizes } = whole ?? measured(standard, first, second);
  const away = whole ? new Float64Array() : distances(standard, first.length);
  const part = whole ? 1 : Math.max(own.length / MOST_DEALT, 1);
  const some = part > 1 ? standardised(given, everyOf(first, part), everyOf(second, part)) : standard;
  // Of a sample more may be dealt out than it has of the smaller group, which may be a handful.
  const size = whole ? Math.min(...sizes, MOST_DEALT, some.count >> 1) : Math.round(own.length / part);
  const count = sizes[0] + sizes[1];
  const deals = dealOut(some.count, size, shuffles, seed);
  const highest = new Float64Array(shuffles);
  const between = Array.from(observed, () => new Float64Array(shuffles));
  for (let column = 0, work = 0; column < columns && shuffles > 0; column += ABREAST) {
    addEffects(some, column, deals, size, highest, between);
    work += ABREAST * deals.length;
    if (work > WORK) {
      work = 0;
      yield column / columns;
    }
  }
  const judged = Array.from(observed, (share, place) => {
    const total = some.totals[place];
    return judge(
      share,
      Array.from(between[place], (own) => (total > 0 ? ofMore(own / total, some.count, count) : 0)),
    );
  });
  return {
    effect,
    limit: atLimit(highest.map((most) => ofMore(most, some.count, count))),
    features: judged.slice(0, -1),
    all: judged[judged.length - 1],
    away,
  };
}

/**
 * How far two groups are apart, by their moments: what `measured` says of all their rows.
 * @param {Moments} first
 * @param {Moments} second
 * @param {Pick<Given, "blocks" | "weights">} given
 * @returns {Whole}
 */
export function apartBy(first, second, { blocks, weights }) {
  const features = weights.length;
  const effect = new Float64Array(blocks.length);
  const [between, totals] = [new Float64Array(features + 1), new Float64Array(features + 1)];
  const count = first.count + second.count;
  for (let column = 0; column < effect.length; column += 1) {
    const difference = first.means[column] - second.means[column];
    const own = (first.count * second.count * difference ** 2) / count;
    const squares = own + first.count * first.variances[column] + second.count * second.variances[column];
    const mean = (first.count * first.means[column] + second.count * second.means[column]) / count;
    if (squares <= leastSquares(count, mean)) continue;
    effect[column] = (Math.sign(difference) * own) / squares;
    for (const place of [blocks[column], features]) {
      between[place] += own * weights[blocks[column]];
      totals[place] += squares * weights[blocks[column]];
    }
  }
  return {
    sizes: [first.count, second.count],
    effect,
    shares: between.map((own, place) => (totals[place] > 0 ? own / totals[place] : 0)),
  };
}

/**
 * Of two groups together.
 * @param {Moments} first
 * @param {Moments} second
 * @returns {Moments}
 */
export function pooled(first, second) {
  const count = first.count + second.count;
  const [own, others] = [first.count / count, second.count / count];
  return {
    count,
    means: first.means.map((mean, column) => own * mean + others * second.means[column]),
    variances: first.variances.map(
      (variance, column) =>
        own * variance +
        others * second.variances[column] +
        own * others * (first.means[column] - second.means[column]) ** 2,
    ),
  };
}

/**
 * As `apartBy`, by the rows.
 * @param {Standard} standard
 * @param {ArrayLike<number>} first
 * @param {ArrayLike<number>} second
 * @returns {Whole}
 */
function measured(standard, first, second) {
  const own = smaller(first, second);
  const sign = first.length === own.length ? 1 : -1;
  const effect = new Float64Array(standard.columns);
  const found = shares(standard, own, effect);
  const sums = columnSums(standard, own);
  return {
    sizes: [first.length, second.length],
    effect: effect.map((value, column) => Math.sign(sums[column]) * sign * value),
    shares: found,
  };
}

/**
 * Squares about a mean that single precision does not tell from none.
 * @param {number} count
 * @param {number} mean
 */
function leastSquares(count, mean) {
  return count * (1e-6 * Math.abs(mean)) ** 2;
}

/**
 * The places of the smaller group among those of both, whose sums say all: the two add up to zero.
 * @param {ArrayLike<number>} first
 * @param {ArrayLike<number>} second
 */
function smaller(first, second) {
  const [from, size] = first.length <= second.length ? [0, first.length] : [first.length, second.length];
  return Int32Array.from({ length: size }, (_, place) => from + place);
}

/**
 * One in so many of some rows, from all over.
 * @param {ArrayLike<number>} rows
 * @param {number} part
 */
function everyOf(rows, part) {
  return Int32Array.from({ length: Math.round(rows.length / part) }, (_, place) => rows[Math.floor(place * part)]);
}

/**
 * What a share of the spread between groups dealt at random would be of more rows: in relation to what it leaves within
 * the groups, a row's worth of it is the same (an F ratio).
 * @param {number} share
 * @param {number} count
 * @param {number} more
 */
function ofMore(share, count, more) {
  if (count === more) return share;
  const ratio = ((share / (1 - share)) * (count - 2)) / (more - 2);
  return ratio / (1 + ratio);
}

/**
 * The columns of both groups, first group first, with mean 0 and squares that add up to 1; constant ones are zero.
 * @param {Given} given
 * @param {ArrayLike<number> & Iterable<number>} first
 * @param {ArrayLike<number> & Iterable<number>} second
 * @returns {Standard}
 */
function standardised({ rows, values, blocks, weights }, first, second) {
  const columns = values.length / rows;
  const chosen = [...first, ...second];
  const count = chosen.length;
  const features = weights.length;
  const points = new Float32Array(columns * count);
  const spread = new Float64Array(columns);
  for (let column = 0; column < columns; column += 1) {
    const start = column * rows;
    let mean = 0;
    for (let place = 0; place < count; place += 1) mean += values[start + chosen[place]] / count;
    let squares = 0;
    for (let place = 0; place < count; place += 1) squares += (values[start + chosen[place]] - mean) ** 2;
    if (squares <= leastSquares(count, mean)) continue;
    spread[column] = squares * weights[blocks[column]];
    const factor = 1 / Math.sqrt(squares);
    for (let place = 0; place < count; place += 1)
      points[column * count + place] = (values[start + chosen[place]] - mean) * factor;
  }
  const totals = new Float64Array(features + 1);
  for (let column = 0; column < columns; column += 1) {
    totals[blocks[column]] += spread[column];
    totals[features] += spread[column];
  }
  return { points, spread, totals, blocks, columns, count, features };
}

/**
 * @param {Standard} standard
 * @param {Int32Array} own
 */
function columnSums({ points, columns, count }, own) {
  const sums = new Float64Array(columns);
  for (let column = 0; column < columns; column += 1) {
    const start = column * count;
    // Two sums at a time, as each addition waits for the one before.
    let [even, odd] = [0, 0];
    for (let place = 1; place < own.length; place += 2) {
      even += points[start + own[place - 1]];
      odd += points[start + own[place]];
    }
    sums[column] = even + odd + (own.length % 2 === 1 ? points[start + own[own.length - 1]] : 0);
  }
  return sums;
}

/**
 * Fill `effect`; the shares of all features, and last of all columns.
 * @param {Standard} standard
 * @param {Int32Array} own
 * @param {Float64Array} effect
 */
function shares(standard, own, effect) {
  const { spread, totals, blocks, columns, count, features } = standard;
  const sums = columnSums(standard, own);
  const factor = count / (own.length * (count - own.length));
  const found = new Float64Array(features + 1);
  for (let column = 0; column < columns; column += 1) {
    effect[column] = sums[column] ** 2 * factor;
    found[blocks[column]] += spread[column] * effect[column];
    found[features] += spread[column] * effect[column];
  }
  return found.map((between, place) => (totals[place] > 0 ? between / totals[place] : 0));
}

/**
 * Squared distances from the mean of the own group.
 * @param {Standard} standard
 * @param {number} firstSize
 */
function distances({ points, spread, columns, count }, firstSize) {
  const away = new Float64Array(count);
  for (let column = 0; column < columns; column += 1) {
    const start = column * count;
    for (const [from, to] of [
      [0, firstSize],
      [firstSize, count],
    ]) {
      let mean = 0;
      for (let place = from; place < to; place += 1) mean += points[start + place] / (to - from);
      for (let place = from; place < to; place += 1)
        away[place] += spread[column] * (points[start + place] - mean) ** 2;
    }
  }
  return away;
}

/**
 * Random choices of `size` of some rows, one after the other.
 * @param {number} count
 * @param {number} size
 * @param {number} shuffles
 * @param {number} seed
 */
function dealOut(count, size, shuffles, seed) {
  const random = new Random(seed);
  const order = Uint32Array.from({ length: count }, (_, place) => place);
  const deals = new Uint32Array(shuffles * size);
  for (let shuffle = 0; shuffle < shuffles; shuffle += 1) {
    for (let place = 0; place < size; place += 1) {
      const other = place + random.below(count - place);
      [order[place], order[other]] = [order[other], order[place]];
    }
    deals.set(order.subarray(0, size), shuffle * size);
  }
  return deals;
}

/**
 * What `shares` says of some columns, deal by deal: the largest effect goes into `highest`, and what lies between the
 * groups is added to `between`, by feature and last of all.
 * @param {Standard} standard
 * @param {number} from the first of `ABREAST` columns
 * @param {Uint32Array} deals
 * @param {number} size of each
 * @param {Float64Array} highest
 * @param {Float64Array[]} between
 */
function addEffects({ points, spread, blocks, columns, count, features }, from, deals, size, highest, between) {
  const abreast = new Float64Array(ABREAST * count);
  const until = Math.min(from + ABREAST, columns);
  for (let column = from; column < until; column += 1) {
    for (let place = 0; place < count; place += 1)
      abreast[place * ABREAST + column - from] = points[column * count + place];
  }
  const factor = count / (size * (count - size));
  const sums = new Float64Array(ABREAST);
  for (let shuffle = 0; shuffle < highest.length; shuffle += 1) {
    // One array taken apart into all eight would cost Firefox as much as the additions.
    let a = 0;
    let b = 0;
    let c = 0;
    let d = 0;
    let e = 0;
    let f = 0;
    let g = 0;
    let h = 0;
    const end = (shuffle + 1) * size;
    for (let place = shuffle * size; place < end; place += 1) {
      const row = deals[place] * ABREAST;
      a += abreast[row];
      b += abreast[row + 1];
      c += abreast[row + 2];
      d += abreast[row + 3];
      e += abreast[row + 4];
      f += abreast[row + 5];
      g += abreast[row + 6];
      h += abreast[row + 7];
    }
    sums[0] = a;
    sums[1] = b;
    sums[2] = c;
    sums[3] = d;
    sums[4] = e;
    sums[5] = f;
    sums[6] = g;
    sums[7] = h;
    for (let column = from; column < until; column += 1) {
      const effect = sums[column - from] ** 2 * factor;
      if (effect > highest[shuffle]) highest[shuffle] = effect;
      const own = spread[column] * effect;
      between[blocks[column]][shuffle] += own;
      between[features][shuffle] += own;
    }
  }
}

/**
 * @param {number} share
 * @param {number[]} dealt
 * @returns {Share}
 */
function judge(share, dealt) {
  const reached = dealt.filter((value) => value >= share * (1 - 1e-9)).length;
  return {
    share,
    chance: dealt.length > 0 ? dealt.reduce((sum, value) => sum + value, 0) / dealt.length : 0,
    limit: atLimit(dealt),
    exceeding: (reached + 1) / (dealt.length + 1),
  };
}

/**
 * The value that what is beyond chance has to exceed.
 * @param {ArrayLike<number>} dealt
 */
function atLimit(dealt) {
  const rising = Float64Array.from(dealt).sort();
  return rising[Math.ceil((1 - CHANCE) * (rising.length + 1)) - 1] ?? 1;
}
