// Where names stand on a map: never nearer to another class than to their own, or with a line to it, or nowhere.
//
// A name is read as that of the marks closest to it. So a place beside its class counts only if the nearest mark of
// the class is clearly nearer than that of any other; where there is none, a name stands in free space with a line to
// its class; and where there is no such space either, it is left out.

/** @typedef {{ index: number, group: number, x: number, y: number }} Mark a shape that is shown, in pixels */
/** @typedef {{ left: number, right: number, top: number, bottom: number }} Box */
/** @typedef {{ x1: number, y1: number, x2: number, y2: number }} Line */
/**
 * @typedef {object} Place
 * @property {number} group the class
 * @property {number} anchor index of the shape that the name moves with
 * @property {number} dx from there to the middle of the name
 * @property {number} dy
 * @property {boolean} leader whether a line leads from the name to the anchor
 */

/** @typedef {{ x: number, y: number, group: number }} Dot */

/** How much nearer than another class its own has to be, in pixels. */
const CLEARLY = 4;
/** Between names, and from a name to the frame. */
const APART = 2;
/** From a name with a line to the marks of others. */
const FREE = 5;
/** The farthest that a name without a line stands from its class. */
const SIGHT = 30;
const WAYS = Array.from({ length: 20 }, (_, step) => {
  const angle = (2 * Math.PI * step) / 20 - Math.PI / 2;
  return [Math.cos(angle), Math.sin(angle)];
});
const STEP = 5;
/** The radius of marks from which there is something to see on them. */
const LARGE = 6;
/** The longest way from the anchor, beside the class and with a line. */
const BESIDE = 130;
const LED = 190;
/** Classes are in pieces; a name may stand at one of the largest. */
const PIECES = 3;
const NEIGHBOURHOOD = 40;

/**
 * Choose places for names.
 *
 * @param {readonly Mark[]} marks shapes that are shown; those of group -1 have no name and are in the way all the same
 * @param {ReadonlyMap<number, { width: number, height: number }>} names the size of each name with what stands before it
 * @param {{ width: number, height: number }} frame
 * @param {number} radius of a mark
 * @param {readonly Place[]} [kept] places from before, kept where they still hold, so that names do not jump
 * @returns {Place[]} large classes first
 */
export function placeNames(marks, names, frame, radius, kept = []) {
  const field = new Field(marks, radius);
  // Where there is room for some names only, those of large classes help most.
  const groups = [...Map.groupBy(marks, ({ group }) => group)]
    .flatMap(([group, members]) => {
      const size = names.get(group);
      return size === undefined ? [] : [{ group, members, size }];
    })
    .sort((a, b) => b.members.length - a.members.length || a.group - b.group);
  const taken = new Taken(frame);
  /** @type {Map<number, Place>} */
  const places = new Map();
  const before = new Map(kept.map((place) => [place.group, place]));
  const positions = new Map(marks.map((mark) => [mark.index, mark]));
  // Names that can stay go first: otherwise a newcomer takes their places.
  for (const { group, size } of groups) {
    const place = before.get(group);
    if (place === undefined) continue;
    const anchor = positions.get(place.anchor);
    if (anchor?.group !== group) continue;
    const candidate = new Candidate(anchor, place.dx, place.dy, size, place.leader);
    if (taken.hasRoom(candidate) && holds(candidate, group, field)) {
      taken.add(candidate);
      places.set(group, place);
    }
  }
  for (const { group, members, size } of groups) {
    if (places.has(group)) continue;
    const candidate = best(pieces(members), group, size, field, taken, radius);
    if (candidate === null) continue;
    taken.add(candidate);
    const { anchor, dx, dy, leader } = candidate;
    places.set(group, { group, anchor: anchor.index, dx, dy, leader });
  }
  return groups.flatMap(({ group }) => places.get(group) ?? []);
}

/** A place that a name could have. */
class Candidate {
  /**
   * @param {Mark} anchor
   * @param {number} dx
   * @param {number} dy
   * @param {{ width: number, height: number }} size
   * @param {boolean} leader
   */
  constructor(anchor, dx, dy, { width, height }, leader) {
    const [x, y] = [anchor.x + dx, anchor.y + dy];
    this.anchor = anchor;
    this.dx = dx;
    this.dy = dy;
    this.leader = leader;
    /** @type {Box} */
    this.box = { left: x - width / 2, right: x + width / 2, top: y - height / 2, bottom: y + height / 2 };
    /** @type {Line | null} */
    this.line = leader ? leaderOf(this.box, anchor) : null;
  }
}

/**
 * The line from a name to its shape.
 *
 * @param {Box} box
 * @param {{ x: number, y: number }} anchor
 * @returns {Line}
 */
export function leaderOf(box, anchor) {
  return {
    x1: Math.min(Math.max(anchor.x, box.left), box.right),
    y1: Math.min(Math.max(anchor.y, box.top), box.bottom),
    x2: anchor.x,
    y2: anchor.y,
  };
}

/**
 * Whether a name that has its place may keep it: by less than a new one needs, lest it come and go.
 *
 * @param {Candidate} candidate
 * @param {number} group
 * @param {Field} field
 */
function holds(candidate, group, field) {
  const others = field.gap(candidate.box, SIGHT, (of) => of !== group);
  if (candidate.leader) return others > 1;
  return others > 1 && field.gap(candidate.box, SIGHT, (of) => of === group) + 1 < others;
}

/**
 * The best place for a name: beside one of the pieces of its class, else with a line, else null.
 *
 * @param {Mark[]} anchors
 * @param {number} group
 * @param {{ width: number, height: number }} size
 * @param {Field} field
 * @param {Taken} taken
 * @param {number} radius
 * @returns {Candidate | null}
 */
function best(anchors, group, size, field, taken, radius) {
  let [led, shortest] = [/** @type {Candidate | null} */ (null), LED];
  for (const [rank, anchor] of anchors.entries()) {
    // The largest piece is where a name is looked for; others only help where it has no place there.
    let [beside, least] = [/** @type {Candidate | null} */ (null), Infinity];
    for (const [cos, sin] of WAYS) {
      const [sideways, upwards] = [(cos * Math.abs(cos) * size.width) / 2, (sin * Math.abs(sin) * size.height) / 2];
      for (let way = 0; way < Math.min(least, Math.max(BESIDE, shortest)); way += STEP) {
        const candidate = new Candidate(anchor, cos * way + sideways, sin * way + upwards, size, false);
        if (!taken.hasRoom(candidate)) continue;
        const others = field.gap(candidate.box, FREE, (of) => of !== group);
        if (others <= radius / 2) continue;
        const own = field.gap(candidate.box, SIGHT, (of) => of === group);
        if (way <= BESIDE && own < SIGHT) {
          // Better a little farther than over marks of its own, and much farther than over its pictures.
          const cost = way + (own > 0 ? 0 : 12 + 4 * (field.covered(candidate.box) + Math.max(radius - LARGE, 0)));
          if (cost < least && field.gap(candidate.box, own + CLEARLY, (of) => of !== group) > own + CLEARLY)
            [beside, least] = [candidate, cost];
        }
        if (beside === null && own > 0 && others > FREE && way + 30 * rank < shortest) {
          const lined = new Candidate(anchor, candidate.dx, candidate.dy, size, true);
          if (taken.hasRoom(lined)) [led, shortest] = [lined, way + 30 * rank];
        }
      }
    }
    if (beside !== null) return beside;
  }
  return led;
}

/** Marks in cells, to find those near a box. */
class Field {
  /** @type {Map<number, Dot[]>} */
  #cells = new Map();

  /**
   * @param {readonly Mark[]} marks
   * @param {number} radius
   */
  constructor(marks, radius) {
    this.radius = radius;
    // Marks on one pixel of one class are one.
    const seen = new Set();
    for (const { x, y, group } of marks) {
      const [column, row] = [Math.round(x), Math.round(y)];
      const dot = `${column},${row},${group}`;
      if (seen.has(dot)) continue;
      seen.add(dot);
      const key = keyOf(Math.floor(column / CELL), Math.floor(row / CELL));
      const cell = this.#cells.get(key) ?? [];
      if (cell.push({ x: column, y: row, group }) === 1) this.#cells.set(key, cell);
    }
  }

  /**
   * Pixels from a box to the closest edge of a mark; 0 where one is covered, more than `reach` where none is in reach.
   *
   * @param {Box} box
   * @param {number} reach
   * @param {(group: number) => boolean} counts which classes count
   */
  gap(box, reach, counts) {
    let closest = Infinity;
    this.#each(box, reach + this.radius, ({ x, y, group }) => {
      if (!counts(group)) return;
      const dx = Math.max(box.left - x, 0, x - box.right);
      const dy = Math.max(box.top - y, 0, y - box.bottom);
      closest = Math.min(closest, dx * dx + dy * dy);
    });
    return Math.max(0, Math.sqrt(closest) - this.radius);
  }

  /**
   * How many marks a box covers.
   *
   * @param {Box} box
   */
  covered(box) {
    let count = 0;
    this.#each(box, 0, ({ x, y }) => {
      if (x > box.left && x < box.right && y > box.top && y < box.bottom) count += 1;
    });
    return count;
  }

  /**
   * @param {Box} box
   * @param {number} margin
   * @param {(dot: Dot) => void} visit
   */
  #each(box, margin, visit) {
    const [first, last] = [Math.floor((box.left - margin) / CELL), Math.floor((box.right + margin) / CELL)];
    const bottom = Math.floor((box.bottom + margin) / CELL);
    for (let row = Math.floor((box.top - margin) / CELL); row <= bottom; row += 1)
      for (let column = first; column <= last; column += 1) this.#cells.get(keyOf(column, row))?.forEach(visit);
  }
}

const CELL = 12;

/**
 * @param {number} column
 * @param {number} row
 */
function keyOf(column, row) {
  return row * 100000 + column;
}

/** The names that have their places already, with their lines. */
class Taken {
  /** @type {Candidate[]} */
  #all = [];

  /** @param {{ width: number, height: number }} frame */
  constructor(frame) {
    this.frame = frame;
  }

  /** @param {Candidate} candidate */
  add(candidate) {
    this.#all.push(candidate);
  }

  /** @param {Candidate} candidate */
  hasRoom({ box, line }) {
    if (box.left < APART || box.top < APART) return false;
    if (box.right > this.frame.width - APART || box.bottom > this.frame.height - APART) return false;
    return this.#all.every(
      (other) =>
        !overlap(box, other.box) &&
        (line === null || (!meets(line, other.box) && (other.line === null || !cross(line, other.line)))) &&
        (other.line === null || !meets(other.line, box)),
    );
  }
}

/**
 * @param {Box} a
 * @param {Box} b
 */
function overlap(a, b) {
  return a.left - APART < b.right && b.left - APART < a.right && a.top - APART < b.bottom && b.top - APART < a.bottom;
}

/**
 * Whether a line touches a box (Liang and Barsky's clipping).
 *
 * @param {Line} line
 * @param {Box} box
 */
function meets({ x1, y1, x2, y2 }, box) {
  let [from, to] = [0, 1];
  for (const [direction, room] of [
    [x1 - x2, x1 - box.left],
    [x2 - x1, box.right - x1],
    [y1 - y2, y1 - box.top],
    [y2 - y1, box.bottom - y1],
  ]) {
    if (direction === 0) {
      if (room < 0) return false;
    } else if (direction < 0) from = Math.max(from, room / direction);
    else to = Math.min(to, room / direction);
  }
  return from <= to;
}

/**
 * Whether two lines cross.
 *
 * @param {Line} a
 * @param {Line} b
 */
function cross(a, b) {
  return sideOf(a, b.x1, b.y1) !== sideOf(a, b.x2, b.y2) && sideOf(b, a.x1, a.y1) !== sideOf(b, a.x2, a.y2);
}

/**
 * @param {Line} line
 * @param {number} x
 * @param {number} y
 */
function sideOf({ x1, y1, x2, y2 }, x, y) {
  return Math.sign((x2 - x1) * (y - y1) - (y2 - y1) * (x - x1));
}

/**
 * The marks at the hearts of the largest pieces of a class, so that a name does not float between two halves of it.
 *
 * @param {readonly Mark[]} members
 * @returns {Mark[]}
 */
function pieces(members) {
  /** @type {Mark[]} */
  const found = [];
  let rest = members;
  while (rest.length > 0 && found.length < PIECES) {
    const densest = densestOf(rest);
    const crowd = rest.filter((mark) => near(mark, densest, 1.5 * NEIGHBOURHOOD));
    const x = crowd.reduce((sum, mark) => sum + mark.x, 0) / crowd.length;
    const y = crowd.reduce((sum, mark) => sum + mark.y, 0) / crowd.length;
    found.push(crowd.reduce((a, b) => ((b.x - x) ** 2 + (b.y - y) ** 2 < (a.x - x) ** 2 + (a.y - y) ** 2 ? b : a)));
    rest = rest.filter((mark) => !near(mark, densest, 2 * NEIGHBOURHOOD));
  }
  return found;
}

/**
 * @param {Mark} mark
 * @param {Mark} other
 * @param {number} reach
 */
function near(mark, other, reach) {
  return Math.abs(mark.x - other.x) < reach && Math.abs(mark.y - other.y) < reach;
}

/**
 * A mark with most others in its cell and those around it.
 *
 * @param {readonly Mark[]} marks
 */
function densestOf(marks) {
  const cells = marks.map(({ x, y }) => keyOf(Math.floor(x / NEIGHBOURHOOD), Math.floor(y / NEIGHBOURHOOD)));
  /** @type {Map<number, number>} */
  const counts = new Map();
  for (const cell of cells) counts.set(cell, (counts.get(cell) ?? 0) + 1);
  let [best, most] = [marks[0], -1];
  for (const [position, cell] of cells.entries()) {
    let sum = 0;
    for (let i = -1; i <= 1; i += 1) for (let j = -1; j <= 1; j += 1) sum += counts.get(cell + keyOf(i, j)) ?? 0;
    if (sum > most) [best, most] = [marks[position], sum];
  }
  return best;
}
