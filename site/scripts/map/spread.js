// Pictures of shapes beside each other: where they stand on a map so that none covers another, and which have no room.
//
// Pictures are pushed apart until they no longer touch; where more shapes lie together than there is room for within reach
// of their places, the rest stay dots, and pictures make way for dots of other groups; in a crowd few pictures stand among
// many dots. Nothing here knows what part of the map is in view, so that moving a map moves no picture on it.

/** @typedef {{ left: number, right: number, top: number, bottom: number }} Frame */
/**
 * @typedef {object} Spread
 * @property {Float64Array} x where each picture stands, or the place of a shape without one
 * @property {Float64Array} y
 * @property {Uint8Array} pictured 1 for a shape that has a picture
 */

/** The farthest that a picture stands from its place, in sizes of a picture. */
export const FARTHEST = 3;
/** So many sizes of a picture around a shape are looked at, and this share of them may be filled with pictures. */
const AROUND = 3;
const FULLEST = 0.62;
/** Where so many times more shapes lie than have room, pictures stand for others: so many sizes apart, among dots. */
const CROWD = 6;
const APART = 1.15;
/** The share of a picture that another may cover. */
export const TOLERANCE = 0.06;
/** How often pictures are pushed apart again without those that found no place. */
const ROUNDS = 12;

const STEPS = 120;
/** Squares of a grid on a side: a map that is zoomed far in is large, and few of its shapes are looked at. */
const MOST_CELLS = 2000;
/** How strongly places draw their pictures back, at first; less and less with every step. */
const PULL = 0.06;

/**
 * Spread pictures of a size.
 *
 * @param {ArrayLike<number>} x places in pixels of the whole map
 * @param {ArrayLike<number>} y
 * @param {number} size of a picture
 * @param {object} [among]
 * @param {Frame | null} [among.frame] which pictures do not leave
 * @param {number} [among.first] so many shapes, the first, have a picture wherever it finds a place within reach
 * @param {ArrayLike<number> | null} [among.groups] dots of one group are left to be seen by pictures of others
 * @param {number} [among.dot] radius of a dot
 * @param {boolean} [among.crowd] whether each stands for many others, wherever it lies
 * @returns {Spread} shapes that come first come first to a picture
 */
export function spread(x, y, size, { frame = null, first = 0, groups = null, dot = 0, crowd = false } = {}) {
  const pictured = chosen(x, y, size, first, crowd);
  for (let round = 1; ; round += 1) {
    /** @type {number[][]} */
    const [rows, dots] = [[], []];
    for (let row = 0; row < x.length; row += 1) (pictured[row] === 0 ? dots : rows).push(row);
    const places = { x: Float64Array.from(x), y: Float64Array.from(y) };
    const obstacles = groups === null ? null : new Obstacles(x, y, groups, dots, size, dot);
    const own = rows.map((row) => groups?.[row] ?? -1);
    const moved = apart(
      rows.map((row) => x[row]),
      rows.map((row) => y[row]),
      size,
      frame,
      (places) => obstacles?.push(places, own) ?? 0,
    );
    // What could not be pushed apart within reach has no room.
    const standing = new Cells(moved.x, moved.y, size);
    standing.clear();
    const least = size * (1 - TOLERANCE);
    let without = 0;
    for (const [place, row] of rows.entries()) {
      const isFree = (/** @type {number} */ left, /** @type {number} */ top) => !standing.any(left, top, least);
      let fits = isFree(moved.x[place], moved.y[place]);
      if (row < first) {
        const room = fits ? null : roomNear([x[row], y[row]], size, frame, isFree);
        if (room !== null) [moved.x[place], moved.y[place], fits] = [...room, true];
      } else fits &&= !obstacles?.anyUnder(moved.x[place], moved.y[place], own[place]);
      if (fits) {
        standing.add(place);
        [places.x[row], places.y[row]] = [moved.x[place], moved.y[place]];
      } else {
        pictured[row] = 0;
        without += 1;
      }
    }
    // What has no room is a dot, which others make way for in their turn.
    if (without === 0 || round === ROUNDS) return { ...places, pictured };
  }
}

/**
 * The place nearest to one, within reach, where a picture has room; null where there is none.
 * @param {[number, number]} place
 * @param {number} size
 * @param {Frame | null} frame
 * @param {(x: number, y: number) => boolean} isFree
 * @returns {[number, number] | null}
 */
function roomNear([x, y], size, frame, isFree) {
  for (let distance = 0; distance <= FARTHEST * size; distance += size / 4) {
    for (let turn = 0; turn < 24; turn += 1) {
      const angle = (2 * Math.PI * turn) / 24;
      const left = within(x + distance * Math.cos(angle), frame?.left, frame?.right, size);
      const top = within(y + distance * Math.sin(angle), frame?.top, frame?.bottom, size);
      if (isFree(left, top)) return [left, top];
    }
  }
  return null;
}

/**
 * The shapes whose pictures lie apart at their exact places, `distance` sizes or more.
 *
 * @param {ArrayLike<number>} x
 * @param {ArrayLike<number>} y
 * @param {number} size
 * @param {number} distance
 * @returns {Spread}
 */
export function thinned(x, y, size, distance) {
  const pictured = new Uint8Array(x.length);
  const taken = new Cells(x, y, size * distance);
  taken.clear();
  for (let row = 0; row < x.length; row += 1) {
    if (taken.any(x[row], y[row], size * distance)) continue;
    taken.add(row);
    pictured[row] = 1;
  }
  return { x: Float64Array.from(x), y: Float64Array.from(y), pictured };
}

/**
 * Which shapes are to have a picture: all where there is room for all, those that lie apart in a crowd.
 * @param {ArrayLike<number>} x
 * @param {ArrayLike<number>} y
 * @param {number} size
 * @param {number} first so many have one in any case
 * @param {boolean} everywhere whether all is a crowd
 */
function chosen(x, y, size, first, everywhere) {
  const reach = AROUND * size;
  const room = FULLEST * 4 * AROUND ** 2 - 1;
  const all = new Cells(x, y, reach);
  const taken = new Cells(x, y, reach);
  taken.clear();
  const pictured = new Uint8Array(x.length);
  for (let row = 0; row < x.length; row += 1) {
    const crowd = everywhere || all.count(x[row], y[row], reach, CROWD * room) > CROWD * room;
    if (
      row >= first &&
      (crowd ? taken.any(x[row], y[row], APART * size) : taken.count(x[row], y[row], reach, room) > room)
    )
      continue;
    taken.add(row);
    pictured[row] = 1;
  }
  return pictured;
}

/**
 * Places pushed apart until none is nearer to another than a size, as far as they may go.
 * @param {number[]} x
 * @param {number[]} y
 * @param {number} size
 * @param {Frame | null} frame
 * @param {(places: { x: Float64Array, y: Float64Array }) => number} makeWay moves places; by how far is the farthest from its goal
 */
function apart(x, y, size, frame, makeWay) {
  const moved = { x: Float64Array.from(x), y: Float64Array.from(y) };
  const reach = FARTHEST * size;
  const cells = new Cells(moved.x, moved.y, size);
  for (let step = 0; step < STEPS; step += 1) {
    const pull = PULL * (1 - step / (STEPS * 0.6));
    if (pull > 0 && step > 0) {
      for (let row = 0; row < x.length; row += 1) {
        moved.x[row] += pull * (x[row] - moved.x[row]);
        moved.y[row] += pull * (y[row] - moved.y[row]);
      }
    }
    cells.clear();
    for (let row = 0; row < x.length; row += 1) cells.add(row);
    let worst = 0;
    cells.pairs(size, (row, other, distance) => {
      worst = Math.max(worst, size - distance);
      // Of two in one place each goes its own way, and always the same.
      const [dx, dy] =
        distance > 1e-6 * size
          ? [(moved.x[other] - moved.x[row]) / distance, (moved.y[other] - moved.y[row]) / distance]
          : [Math.cos(2.4 * (row + other)), Math.sin(2.4 * (row + other))];
      const push = (size - distance) / 2;
      moved.x[row] -= push * dx;
      moved.y[row] -= push * dy;
      moved.x[other] += push * dx;
      moved.y[other] += push * dy;
    });
    worst = Math.max(worst, makeWay(moved));
    for (let row = 0; row < x.length; row += 1) {
      const [dx, dy] = [moved.x[row] - x[row], moved.y[row] - y[row]];
      const shorter = Math.min(reach / Math.max(Math.hypot(dx, dy), 1e-9), 1);
      moved.x[row] = within(x[row] + shorter * dx, frame?.left, frame?.right, size);
      moved.y[row] = within(y[row] + shorter * dy, frame?.top, frame?.bottom, size);
    }
    if (worst < (size * TOLERANCE) / 3) break;
  }
  return moved;
}

/**
 * @param {number} value
 * @param {number | undefined} from
 * @param {number | undefined} to
 * @param {number} size
 */
function within(value, from = -Infinity, to = Infinity, size = 0) {
  return to - from < size ? (from + to) / 2 : Math.min(Math.max(value, from + size / 2), to - size / 2);
}

/** Dots that pictures of other groups make way for. */
class Obstacles {
  /**
   * @param {ArrayLike<number>} x
   * @param {ArrayLike<number>} y
   * @param {ArrayLike<number>} groups
   * @param {number[]} dots the rows of dots
   * @param {number} size of a picture
   * @param {number} radius of a dot
   */
  constructor(x, y, groups, dots, size, radius) {
    this.groups = dots.map((row) => groups[row]);
    this.size = size;
    this.clear = Math.min(size / 2 + radius, size);
    this.cells = new Cells(
      dots.map((row) => x[row]),
      dots.map((row) => y[row]),
      size,
    );
  }

  /**
   * Push pictures a step away from the dot of another group that each covers most; how much that is at worst.
   * @param {{ x: Float64Array, y: Float64Array }} places of pictures
   * @param {number[]} groups of the pictures
   */
  push({ x, y }, groups) {
    let worst = 0;
    for (const [place, group] of groups.entries()) {
      let [nearest, least] = [-1, this.clear];
      this.cells.near(x[place], y[place], this.clear, (dot, distance) => {
        if (this.groups[dot] !== group && distance < least) [nearest, least] = [dot, distance];
      });
      if (nearest < 0) continue;
      const push = this.clear - least;
      worst = Math.max(worst, push);
      const [dx, dy] =
        least > 1e-6 * this.size
          ? [(x[place] - this.cells.x[nearest]) / least, (y[place] - this.cells.y[nearest]) / least]
          : [Math.cos(2.4 * place), Math.sin(2.4 * place)];
      x[place] += (push / 2) * dx;
      y[place] += (push / 2) * dy;
    }
    return worst;
  }

  /**
   * Whether a picture covers the middle of a dot of another group.
   * @param {number} x
   * @param {number} y
   * @param {number} group of the picture
   */
  anyUnder(x, y, group) {
    let found = false;
    this.cells.near(x, y, this.size / 2, (dot) => {
      found ||= this.groups[dot] !== group;
    });
    return found;
  }
}

/** Places in squares of a grid, to find those near one. */
class Cells {
  /**
   * @param {ArrayLike<number>} x
   * @param {ArrayLike<number>} y
   * @param {number} side
   */
  constructor(x, y, side) {
    this.x = x;
    this.y = y;
    this.side = side;
    let [left, right, top, bottom] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let row = 0; row < x.length; row += 1) {
      [left, right] = [Math.min(left, x[row]), Math.max(right, x[row])];
      [top, bottom] = [Math.min(top, y[row]), Math.max(bottom, y[row])];
    }
    // Places that go beyond stand in the outermost squares.
    this.left = left - FARTHEST * side;
    this.top = top - FARTHEST * side;
    const across = (/** @type {number} */ length) => Math.min(Math.ceil(length / side + 2 * FARTHEST), MOST_CELLS);
    this.columns = Math.max(across(right - left), 1);
    this.lines = Math.max(across(bottom - top), 1);
    // The last that came into each square, and the one before each.
    this.last = new Int32Array(this.columns * this.lines).fill(-1);
    this.before = new Int32Array(x.length);
    for (let row = 0; row < x.length; row += 1) this.add(row);
  }

  clear() {
    this.last.fill(-1);
  }

  /** @param {number} row */
  add(row) {
    const cell = this.#line(this.y[row]) * this.columns + this.#column(this.x[row]);
    this.before[row] = this.last[cell];
    this.last[cell] = row;
  }

  /** @param {number} x */
  #column(x) {
    return Math.min(Math.max(Math.floor((x - this.left) / this.side), 0), this.columns - 1);
  }

  /** @param {number} y */
  #line(y) {
    return Math.min(Math.max(Math.floor((y - this.top) / this.side), 0), this.lines - 1);
  }

  /**
   * How many lie within a distance of a place, counted up to one more than `most`.
   * @param {number} x
   * @param {number} y
   * @param {number} distance no more than the side of a square
   * @param {number} [most]
   */
  count(x, y, distance, most = Infinity) {
    const [column, line] = [this.#column(x), this.#line(y)];
    let found = 0;
    for (let high = Math.max(line - 1, 0); high <= Math.min(line + 1, this.lines - 1); high += 1) {
      for (let wide = Math.max(column - 1, 0); wide <= Math.min(column + 1, this.columns - 1); wide += 1) {
        for (let row = this.last[high * this.columns + wide]; row >= 0; row = this.before[row]) {
          if ((this.x[row] - x) ** 2 + (this.y[row] - y) ** 2 >= distance ** 2) continue;
          found += 1;
          if (found > most) return found;
        }
      }
    }
    return found;
  }

  /**
   * Tell of those within a distance of a place.
   * @param {number} x
   * @param {number} y
   * @param {number} distance no more than the side of a square
   * @param {(row: number, distance: number) => void} tell
   */
  near(x, y, distance, tell) {
    const [column, line] = [this.#column(x), this.#line(y)];
    for (let high = Math.max(line - 1, 0); high <= Math.min(line + 1, this.lines - 1); high += 1) {
      for (let wide = Math.max(column - 1, 0); wide <= Math.min(column + 1, this.columns - 1); wide += 1) {
        for (let row = this.last[high * this.columns + wide]; row >= 0; row = this.before[row]) {
          const away = Math.hypot(this.x[row] - x, this.y[row] - y);
          if (away < distance) tell(row, away);
        }
      }
    }
  }

  /**
   * Whether any lies within a distance of a place.
   * @param {number} x
   * @param {number} y
   * @param {number} distance no more than the side of a square
   */
  any(x, y, distance) {
    return this.count(x, y, distance, 0) > 0;
  }

  /**
   * Tell of all that lie nearer to each other than a distance; where telling moves them, from where they then are.
   * @param {number} distance no more than the side of a square
   * @param {(row: number, other: number, distance: number) => void} tell
   */
  pairs(distance, tell) {
    const { x, y, columns, lines, last, before } = this;
    for (let row = 0; row < x.length; row += 1) {
      const [column, line] = [this.#column(x[row]), this.#line(y[row])];
      for (let high = Math.max(line - 1, 0); high <= Math.min(line + 1, lines - 1); high += 1) {
        for (let wide = Math.max(column - 1, 0); wide <= Math.min(column + 1, columns - 1); wide += 1) {
          for (let other = last[high * columns + wide]; other >= 0; other = before[other]) {
            if (other <= row) continue;
            const [dx, dy] = [x[other] - x[row], y[other] - y[row]];
            if (dx * dx + dy * dy < distance * distance) tell(row, other, Math.sqrt(dx * dx + dy * dy));
          }
        }
      }
    }
  }
}
