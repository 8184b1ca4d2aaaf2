// Paints bars of bins: thousands in a frame, the highest of those that share a pixel.

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
 * The highest bar of every pixel column that bars share: which it is, -1 where there is none.
 *
 * @param {Bars} bars
 * @param {number} width
 */
function highest(bars, width) {
  const { columns, from, to, level } = bars;
  const tops = new Int32Array(width).fill(-1);
  for (const column of columns) {
    if (isAlone(bars, column)) continue;
    for (let pixel = Math.max(Math.floor(from[column]), 0); pixel < Math.min(to[column], width); pixel += 1) {
      if (tops[pixel] < 0 || level[column] > level[tops[pixel]]) tops[pixel] = column;
    }
  }
  return tops;
}

/**
 * Whether a bar has pixels of its own.
 * @param {Pick<Bars, "from" | "to">} bars
 * @param {number} column
 */
function isAlone({ from, to }, column) {
  return to[column] - from[column] >= SHARED;
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
 * Where bars share a pixel column, the highest of them stands for all: its height, and its colour alone. What else is
 * there, the rows of `paintRows` show.
 * @param {CanvasRenderingContext2D} context
 * @param {Bars} bars
 * @param {{ width: number, base: number, room: number, colors: string[] }} look
 */
export function paintBars(context, bars, { width, base, room, colors }) {
  /**
   * @param {number} column
   * @param {number} start
   * @param {number} end
   */
  const paint = (column, start, end) => {
    const height = heightOf(bars.level[column], room);
    context.fillStyle = colors[bars.feature[column]];
    context.fillRect(start, base - height, end - start, height);
  };
  for (const column of bars.columns) if (isAlone(bars, column)) paint(column, ...edges(bars, column));
  highest(bars, width).forEach((column, pixel) => column >= 0 && paint(column, pixel, pixel + 1));
}

/**
 * Where a bar begins and ends, on whole pixels, with a gap to the next where there is room for one.
 * @param {Pick<Bars, "from" | "to">} bars
 * @param {number} column
 * @returns {[number, number]}
 */
export function edges({ from, to }, column) {
  const [start, end] = [Math.round(from[column]), Math.round(to[column])];
  return [start, end - (end - start >= 3 ? Math.max(1, Math.round((end - start) / 12)) : 0)];
}

/**
 * Paint a row of marks a feature, as the Features page has under its bars: a mark where one of its bins stands.
 * @param {CanvasRenderingContext2D} context
 * @param {Bars} bars
 * @param {{ top: number, height: number, gap: number, colors: string[], rows: number[] }} look
 */
export function paintRows(context, bars, { top, height, gap, colors, rows }) {
  const of = new Map(rows.map((feature, row) => [feature, row]));
  for (const column of bars.columns) {
    const feature = bars.feature[column];
    const [start, end] = isAlone(bars, column) ? edges(bars, column) : pixelOf(bars, column);
    context.fillStyle = colors[feature];
    context.fillRect(start, top + (of.get(feature) ?? 0) * height, end - start, height - gap);
  }
}

/**
 * The pixel in which the middle of a bar lies.
 * @param {Pick<Bars, "from" | "to">} bars
 * @param {number} column
 */
function pixelOf({ from, to }, column) {
  const pixel = Math.floor((from[column] + to[column]) / 2);
  return [pixel, pixel + 1];
}
