// The weights of iterative Relief; shapeviz_report/scorers/relief.py says in full what they are.

const KERNEL = 0.1;
const ROWS = 400;
const SETTLED = 3e-3;
const MOST_ROUNDS = 30;

/** Rows against rows that are taken together in the sums over all pairs. */
const TALL = 2;
const WIDE = 4;

/** Scores of `columns`, all of which vary over the contest's rows. */
export function* scoreByRelief(table, contest, columns) {
  const sample = spreadRows(table, contest, columns);
  const width = columns.length;
  let weights = new Float64Array(width).fill(1 / Math.sqrt(width));
  let before = new Float64Array(width);
  let step = 1;
  let settled = 0;
  for (let round = 0; round < MOST_ROUNDS; round += 1) {
    // How far the weights still move tells most of the progress; each of a round's two sums over pairs adds a little.
    const report = (part) => ({ progress: settled + (1 - settled) * 0.3 * part });
    const distances = yield* pairDistances(sample, weights, (part) => report(part / 2));
    const shares = pairShares(distances, sample);
    const margins = yield* pairDifferences(sample, width, shares, (part) => report((1 + part) / 2));
    const widening = margins.map((margin) => Math.max(margin, 0));
    const length = norm(widening);
    if (length === 0) return widening;
    const move = widening.map((value, k) => value / length - weights[k]);
    const moved = norm(move);
    if (moved < SETTLED) break;
    // Two columns that each need the other can take turns for ever: shorter steps meet in the middle.
    if (move.reduce((sum, value, k) => sum + value * before[k], 0) < 0) step /= 2;
    before = move;
    const next = weights.map((weight, k) => weight + step * move[k]);
    const size = norm(next);
    weights = next.map((weight) => weight / size);
    settled = Math.min(Math.max(Math.log(moved) / Math.log(SETTLED), 0), 0.95);
  }
  return weights;
}

function norm(vector) {
  return Math.sqrt(vector.reduce((sum, value) => sum + value * value, 0));
}

/**
 * The rows that are compared, those of the first group first: at most `ROWS`, spread evenly by the sums of their values.
 * `values` are theirs, each column divided by its range over all rows of the contest, one row after the other.
 */
function spreadRows({ rows, values }, { positive, negative }, columns) {
  const width = columns.length;
  const all = [...positive, ...negative];
  const lows = new Float64Array(width);
  const ranges = new Float64Array(width);
  const sums = new Float64Array(all.length);
  columns.forEach((column, k) => {
    let low = Infinity;
    let high = -Infinity;
    for (const row of all) {
      const value = values[column * rows + row];
      if (value < low) low = value;
      if (value > high) high = value;
    }
    lows[k] = low;
    ranges[k] = high - low;
    for (let i = 0; i < all.length; i += 1) sums[i] += (values[column * rows + all[i]] - low) / ranges[k];
  });
  const places = Int32Array.from(all.keys());
  const groups = [places.subarray(0, positive.length), places.subarray(positive.length)];
  const most = Math.max(ROWS / 2, ROWS - Math.min(positive.length, negative.length));
  const chosen = groups.map((group) => {
    const count = Math.min(group.length, most);
    const ordered = [...group].sort((a, b) => sums[a] - sums[b]);
    return Array.from({ length: count }, (_, i) => ordered[Math.floor(((i + 0.5) * group.length) / count)]);
  });
  const count = chosen[0].length + chosen[1].length;
  const scaled = new Float32Array(count * width);
  chosen.flat().forEach((place, i) => {
    for (let k = 0; k < width; k += 1) {
      scaled[i * width + k] = (values[columns[k] * rows + all[place]] - lows[k]) / ranges[k];
    }
  });
  return { count, positives: chosen[0].length, values: scaled };
}

/** Sums over the columns of weighted absolute differences between all rows; symmetric. */
function* pairDistances({ count, values }, weights, report) {
  const used = Int32Array.from(weights.keys()).filter((k) => weights[k] > 0);
  const width = used.length;
  const full = weights.length;
  const weighted = new Float32Array(count * width);
  for (let i = 0; i < count; i += 1) {
    for (let k = 0; k < width; k += 1) {
      weighted[i * width + k] = values[i * full + used[k]] * Math.fround(weights[used[k]]);
    }
  }
  const distances = new Float64Array(count * count);
  const sums = new Float64Array(TALL * WIDE);
  for (let i = 0; i < count; i += TALL) {
    for (let j = 0; j < i + TALL; j += WIDE) {
      const block = new Block(count, i, j);
      addDistances(sums, weighted, width, block);
      for (let place = 0; place < sums.length; place += 1) {
        const [one, other] = block.pair(place);
        distances[one * count + other] = sums[place];
        distances[other * count + one] = sums[place];
      }
    }
    yield report(Math.min((i + TALL) / count, 1) ** 2);
  }
  return distances;
}

/** A few rows against a few: each value that is read serves several pairs. Beyond the last row stands the last. */
class Block {
  constructor(count, i, j) {
    this.tall = Array.from({ length: TALL }, (_, offset) => Math.min(i + offset, count - 1));
    this.wide = Array.from({ length: WIDE }, (_, offset) => Math.min(j + offset, count - 1));
    this.beyond = (offset, place) => i + offset >= count || j + place >= i + offset;
  }

  /** The rows of one of the block's pairs. */
  pair(place) {
    return [this.tall[Math.floor(place / WIDE)], this.wide[place % WIDE]];
  }

  /** The shares of all pairs, without those that are of other blocks too. */
  shares(all, count) {
    return Float64Array.from({ length: TALL * WIDE }, (_, place) => {
      const [one, other] = this.pair(place);
      return this.beyond(Math.floor(place / WIDE), place % WIDE) ? 0 : all[one * count + other];
    });
  }
}

function addDistances(sums, values, width, { tall, wide }) {
  const [i, j] = tall.map((row) => row * width);
  const [a, b, c, d] = wide.map((row) => row * width);
  let ia = 0;
  let ib = 0;
  let ic = 0;
  let id = 0;
  let ja = 0;
  let jb = 0;
  let jc = 0;
  let jd = 0;
  for (let k = 0; k < width; k += 1) {
    const first = values[i + k];
    const second = values[j + k];
    let other = values[a + k];
    ia += Math.abs(first - other);
    ja += Math.abs(second - other);
    other = values[b + k];
    ib += Math.abs(first - other);
    jb += Math.abs(second - other);
    other = values[c + k];
    ic += Math.abs(first - other);
    jc += Math.abs(second - other);
    other = values[d + k];
    id += Math.abs(first - other);
    jd += Math.abs(second - other);
  }
  sums.set([ia, ib, ic, id, ja, jb, jc, jd]);
}

/** What each pair counts, negative for rows of one group; what stands at [i, j] with j < i is that of both directions. */
function pairShares(distances, { count, positives }) {
  const shares = new Float64Array(count * count);
  const mean = distances.reduce((sum, distance) => sum + distance, 0) / (count * (count - 1));
  if (mean === 0) return shares;
  const kernel = KERNEL * mean;
  for (let i = 0; i < count; i += 1) {
    const own = i < positives ? [0, positives] : [positives, count];
    const other = i < positives ? [positives, count] : [0, positives];
    const hits = nearness(distances, i, count, own, kernel);
    const misses = nearness(distances, i, count, other, kernel);
    // The probability that the nearest row of all is of the same group, as if both groups were of the same size.
    const advantage = Math.log(hits.total / (own[1] - own[0] - 1) / (misses.total / (other[1] - other[0]))) + (misses.nearest - hits.nearest) / kernel;
    const noOutlier = hits.total === 0 ? 1 : 1 / (1 + Math.exp(-advantage));
    const counts = (0.5 / (own[1] - own[0])) * noOutlier;
    for (let j = own[0]; j < own[1]; j += 1) if (j !== i) shares[i * count + j] = (-counts * hits.likely[j - own[0]]) / hits.total;
    for (let j = other[0]; j < other[1]; j += 1) shares[i * count + j] = (counts * misses.likely[j - other[0]]) / misses.total;
  }
  for (let i = 0; i < count; i += 1) {
    for (let j = 0; j < i; j += 1) shares[i * count + j] += shares[j * count + i];
  }
  return shares;
}

/** How likely each row of a group is the nearest to row i, up to the factor `total`. */
function nearness(distances, i, count, [begin, end], kernel) {
  let nearest = Infinity;
  for (let j = begin; j < end; j += 1) if (j !== i) nearest = Math.min(nearest, distances[i * count + j]);
  const likely = new Float64Array(end - begin);
  let total = 0;
  for (let j = begin; j < end; j += 1) {
    if (j === i) continue;
    likely[j - begin] = Math.exp((nearest - distances[i * count + j]) / kernel);
    total += likely[j - begin];
  }
  return { nearest, likely, total };
}

/** Sums over all pairs of rows of their absolute differences in each column, each pair with its share. */
function* pairDifferences({ count, values }, width, shares, report) {
  const total = new Float64Array(width);
  for (let i = 0; i < count; i += TALL) {
    for (let j = 0; j < i + TALL; j += WIDE) {
      const block = new Block(count, i, j);
      addDifferences(total, values, block, block.shares(shares, count));
    }
    yield report(Math.min((i + TALL) / count, 1) ** 2);
  }
  return total;
}

function addDifferences(total, values, { tall, wide }, [ia, ib, ic, id, ja, jb, jc, jd]) {
  const width = total.length;
  const [i, j] = tall.map((row) => row * width);
  const [a, b, c, d] = wide.map((row) => row * width);
  for (let k = 0; k < width; k += 1) {
    const first = values[i + k];
    const second = values[j + k];
    let other = values[a + k];
    let sum = ia * Math.abs(first - other) + ja * Math.abs(second - other);
    other = values[b + k];
    sum += ib * Math.abs(first - other) + jb * Math.abs(second - other);
    other = values[c + k];
    sum += ic * Math.abs(first - other) + jc * Math.abs(second - other);
    other = values[d + k];
    sum += id * Math.abs(first - other) + jd * Math.abs(second - other);
    total[k] += sum;
  }
}
