// Paints bars of bins: thousands in a frame, none lost where several share a pixel.

/**
 * Bars to paint: the columns, and by column where a bar begins and ends in pixels of the screen, its height in [0, 1] and its
 * feature.
 * @typedef {object} Bars
 * @property {Int32Array} columns
 * @property {ArrayLike<number>} from
 * @property {ArrayLike<number>} to
 * @property {ArrayLike<number>} level
 * @property {ArrayLike<number>} feature
 */

/** Bars narrower than this many pixels of the screen share their pixels. */
const SHARED = 2;

/**
 * How much of every pixel column belongs to each feature, and the highest bar that touches it.
 *
 * @param {Bars} bars
 * @param {number} width
 * @param {number} features
 */
function crowd({ columns, from, to, level, feature }, width, features) {
  const shares = new Float32Array(width * features);
  const totals = new Float32Array(width);
  const peaks = new Float32Array(width);
  for (const column of columns) {
    for (let pixel = Math.max(Math.floor(from[column]), 0); pixel < Math.min(to[column], width); pixel += 1) {
      const share = Math.min(to[column], pixel + 1) - Math.max(from[column], pixel);
      shares[pixel * features + feature[column]] += share;
      totals[pixel] += share;
      if (level[column] > peaks[pixel]) peaks[pixel] = level[column];
    }
  }
  return { shares, totals, peaks };
}

/**
 * Bars with pixels of their own, and those that share them.
 * @param {Bars} bars
 */
function sorted(bars) {
  /** @param {number} column */
  const alone = (column) => bars.to[column] - bars.from[column] >= SHARED;
  return {
    wide: bars.columns.filter(alone),
    crowded: { ...bars, columns: bars.columns.filter((column) => !alone(column)) },
  };
}

/**
 * The next value above one that an axis may well end at, and be halved.
 * @param {number} value
 */
export function axisEnd(value) {
  if (value <= 0) return 1;
  const unit = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 3, 4, 5, 6, 8].find((step) => step * unit >= value * (1 - 1e-9)) ?? 10) * unit;
}

/**
 * Height in pixels of a level; nothing above zero vanishes.
 * @param {number} level
 * @param {number} room
 */
function heightOf(level, room) {
  return level > 0 ? Math.max(Math.round(level * room), 1) : 0;
}

/**
 * Paint bars that stand on `base` and may rise by `room`; all numbers are pixels of the screen.
 *
 * Where bars share a pixel column, it is as high as the highest of them, and each feature has its share of its length:
 * the colours of a place say which features are found there.
 * @param {CanvasRenderingContext2D} context
 * @param {Bars} bars
 * @param {{ width: number, base: number, room: number, colors: string[] }} look
 */
export function paintBars(context, bars, { width, base, room, colors }) {
  const { wide, crowded } = sorted(bars);
  for (const column of wide) {
    const [start, end] = edges(bars, column);
    const height = heightOf(bars.level[column], room);
    context.fillStyle = colors[bars.feature[column]];
    context.fillRect(start, base - height, end - start, height);
  }
  if (crowded.columns.length === 0) return;
  const { shares, totals, peaks } = crowd(crowded, width, colors.length);
  const floors = new Float32Array(width).fill(base);
  for (const [feature, color] of colors.entries()) {
    context.fillStyle = color;
    for (let pixel = 0; pixel < width; pixel += 1) {
      const share = shares[pixel * colors.length + feature];
      if (share === 0) continue;
      const height = (heightOf(peaks[pixel], room) * share) / totals[pixel];
      floors[pixel] -= height;
      context.fillRect(pixel, floors[pixel], 1, height);
    }
  }
}

/**
 * Where a bar begins and ends, on whole pixels, with a gap to the next where there is room for one.
 * @param {Pick<Bars, "from" | "to">} bars
 * @param {number} column
 */
export function edges({ from, to }, column) {
  const [start, end] = [Math.round(from[column]), Math.round(to[column])];
  return [start, end - (end - start >= 3 ? Math.max(1, Math.round((end - start) / 12)) : 0)];
}

/**
 * Paint a row of marks a feature, as the Features page has under its bars: a mark where one of its bins stands.
 * @param {CanvasRenderingContext2D} context
 * @param {Bars} bars
 * @param {{ width: number, top: number, height: number, gap: number, colors: string[], rows: number[] }} look
 */
export function paintRows(context, bars, { width, top, height, gap, colors, rows }) {
  const of = new Map(rows.map((feature, row) => [feature, row]));
  const { wide, crowded } = sorted(bars);
  for (const column of wide) {
    const [start, end] = edges(bars, column);
    context.fillStyle = colors[bars.feature[column]];
    context.fillRect(start, top + (of.get(bars.feature[column]) ?? 0) * height, end - start, height - gap);
  }
  if (crowded.columns.length === 0) return;
  const { shares } = crowd(crowded, width, colors.length);
  for (const [feature, row] of of) {
    context.fillStyle = colors[feature];
    for (let pixel = 0; pixel < width; pixel += 1) {
      const share = shares[pixel * colors.length + feature];
      if (share === 0) continue;
      // A single bin among many still shows.
      context.globalAlpha = Math.max(Math.min(share, 1), 0.35);
      context.fillRect(pixel, top + row * height, 1, height - gap);
    }
  }
  context.globalAlpha = 1;
}
