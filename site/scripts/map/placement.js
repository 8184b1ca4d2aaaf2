// Where names stand on a map: never nearer to another class than to their own, or with a line to it, or nowhere.
//
// A name is read as that of the marks closest to it, and as that of a whole class: so it stands at the largest cluster of
// its class as it is drawn, never at a stray. A place there counts only if the nearest mark of the cluster is clearly nearer
// than that of any other class; where there is none, a name stands in free space with a line to a mark that others leave
// to be seen; and where there is no such space either, it is left out.

import { heartOf, largestCluster } from "./clusters.js";

/** @import { Mark } from "./clusters.js" */
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

/** @typedef {{ x: number, y: number, group: number, radius: number, main: boolean }} Dot whether in its largest cluster */

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
/** The longest way from the anchor beside the class; and from a mark by a line, longer by what it crosses of others. */
const BESIDE = 130;
const LED = 190;
/** Lines may end at so many marks of a cluster. */
const ENDS = 24;

/**
 * Choose places for names.
 *
 * @param {readonly Mark[]} marks shapes that are shown; those of group -1 have no name and are in the way all the same
 * @param {ReadonlyMap<number, { width: number, height: number }>} names the size of each name with what stands before it
 * @param {{ width: number, height: number, covered?: Box[] }} frame with what lies over the map
 * @param {number} radius of a mark, the largest
 * @param {readonly Place[]} [kept] places from before, kept where they still hold, so that names do not jump
 * @returns {Place[]} large classes first
 */
export function placeNames(marks, names, frame, radius, kept = []) {
  // Where there is room for some names only, those of large classes help most.
  const groups = [...Map.groupBy(marks, ({ group }) => group)]
    .flatMap(([group, members]) => {
      const size = names.get(group);
      return size === undefined ? [] : [{ group, members, size, cluster: largestCluster(members, radius) }];
    })
    .sort((a, b) => b.members.length - a.members.length || a.group - b.group);
  const clustered = new Set(groups.flatMap(({ cluster }) => cluster));
  const field = new Field(marks, clustered, radius, frame);
  const taken = new Taken(frame);
  /** @type {Map<number, Place>} */
  const places = new Map();
  /**
   * @param {number} group
   * @param {Candidate | null} candidate
   */
  const take = (group, candidate) => {
    if (candidate === null) return;
    taken.add(candidate);
    const { anchor, dx, dy, leader } = candidate;
    places.set(group, { group, anchor: anchor.index, dx, dy, leader });
  };
  const before = new Map(kept.map((place) => [place.group, place]));
  // Names that can stay go first: otherwise a newcomer takes their places. Then those that stand beside their class,
  // which find room at few places.
  for (const { group, size, cluster } of groups) {
    const place = before.get(group);
    const anchor = cluster.find(({ index }) => index === place?.anchor);
    if (place === undefined || anchor === undefined) continue;
    const candidate = new Candidate(anchor, place.dx, place.dy, size, place.leader);
    if (taken.hasRoom(candidate.box, candidate.line) && holds(candidate, group, field)) take(group, candidate);
  }
  for (const { group, size, cluster } of groups)
    if (!places.has(group)) take(group, beside(heartOf(cluster, radius), group, size, field, taken));
  for (const { group, size, cluster } of groups)
    if (!places.has(group)) take(group, led(heartOf(cluster, radius), cluster, group, size, field, taken));
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
  constructor(anchor, dx, dy, size, leader) {
    this.anchor = anchor;
    this.dx = dx;
    this.dy = dy;
    this.leader = leader;
    /** @type {Box} */
    this.box = { left: 0, right: 0, top: 0, bottom: 0 };
    setBox(this.box, anchor, dx, dy, size);
    /** @type {Line | null} */
    this.line = leader ? leaderOf(this.box, anchor) : null;
  }
}

/**
 * Where a name stands.
 *
 * @param {Box} box is set to it
 * @param {Mark} anchor
 * @param {number} dx
 * @param {number} dy
 * @param {{ width: number, height: number }} size
 */
function setBox(box, anchor, dx, dy, { width, height }) {
  const [x, y] = [anchor.x + dx, anchor.y + dy];
  box.left = x - width / 2;
  box.right = x + width / 2;
  box.top = y - height / 2;
  box.bottom = y + height / 2;
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
  const others = field.gap(candidate.box, SIGHT, (dot) => dot.group !== group);
  if (others <= 1) return false;
  if (candidate.line !== null) return field.seen(candidate.anchor) && costOf(candidate.line, group, field, LED) < LED;
  return field.gap(candidate.box, SIGHT, (dot) => dot.group === group && dot.main) + 1 < others;
}

/**
 * The places about a mark where a name has room, from near to far on each way.
 *
 * @param {Mark} heart
 * @param {{ width: number, height: number }} size
 * @param {Taken} taken
 * @param {() => number} most how far it is worth to go, at any moment
 * @returns {Generator<{ candidate: Candidate, way: number }>}
 */
function* placesAbout(heart, size, taken, most) {
  // One for all that are tried, most of which have no room.
  const box = { left: 0, right: 0, top: 0, bottom: 0 };
  for (const [cos, sin] of WAYS) {
    const [sideways, upwards] = [(cos * Math.abs(cos) * size.width) / 2, (sin * Math.abs(sin) * size.height) / 2];
    for (let way = 0; way < most(); way += STEP) {
      const [dx, dy] = [cos * way + sideways, sin * way + upwards];
      setBox(box, heart, dx, dy, size);
      if (taken.hasRoom(box, null)) yield { candidate: new Candidate(heart, dx, dy, size, false), way };
    }
  }
}

/**
 * The best place for a name beside the largest cluster of its class, or null.
 *
 * @param {Mark} heart of the cluster
 * @param {number} group
 * @param {{ width: number, height: number }} size
 * @param {Field} field
 * @param {Taken} taken
 * @returns {Candidate | null}
 */
function beside(heart, group, size, field, taken) {
  let [best, least] = [/** @type {Candidate | null} */ (null), Infinity];
  /** @param {Dot} dot */
  const foreign = (dot) => dot.group !== group;
  for (const { candidate, way } of placesAbout(heart, size, taken, () => Math.min(least, BESIDE))) {
    // What is close is told quickest.
    if (field.reaches(candidate.box, CLEARLY, foreign)) continue;
    const own = field.gap(candidate.box, SIGHT, (dot) => dot.group === group && dot.main);
    if (own >= SIGHT || field.reaches(candidate.box, own + CLEARLY, foreign)) continue;
    // Better a little farther than over marks of its own, and much farther than over its pictures.
    const over = field.covered(candidate.box) + Math.max(field.radius - LARGE, 0);
    const cost = way + (own > 0 ? 0 : 12 + 4 * over);
    if (cost < least) [best, least] = [candidate, cost];
  }
  return best;
}

/**
 * The best place for a name with a line to a mark of the largest cluster of its class, or null.
 *
 * @param {Mark} heart of the cluster
 * @param {Mark[]} cluster
 * @param {number} group
 * @param {{ width: number, height: number }} size
 * @param {Field} field
 * @param {Taken} taken
 * @returns {Candidate | null}
 */
function led(heart, cluster, group, size, field, taken) {
  let [best, least] = [/** @type {Candidate | null} */ (null), LED];
  /** @type {Mark[] | null} */
  let ends = null;
  for (const { candidate } of placesAbout(heart, size, taken, () => LED)) {
    if (field.reaches(candidate.box, FREE, () => true)) continue;
    // Many names have no free space at all.
    ends ??= endsIn(cluster, heart, field);
    for (const end of ends) {
      const line = leaderOf(candidate.box, end);
      if (lengthOf(line) >= least) continue;
      const cost = costOf(line, group, field, least);
      if (cost >= least || !taken.hasRoom(candidate.box, line)) continue;
      const [x, y] = [heart.x + candidate.dx, heart.y + candidate.dy];
      [best, least] = [new Candidate(end, x - end.x, y - end.y, size, true), cost];
    }
  }
  return best;
}

/**
 * The marks of a cluster at which a line may end: those that are seen, pictures rather than dots among them.
 *
 * @param {Mark[]} cluster
 * @param {Mark} heart of it
 * @param {Field} field
 */
function endsIn(cluster, heart, field) {
  const seen = cluster.filter((mark) => field.seen(mark));
  const largest = seen.reduce((most, { radius = field.radius }) => Math.max(most, radius), 0);
  const large = seen.filter((mark) => (mark.radius ?? field.radius) === largest);
  return large.filter((mark, place) => mark === heart || place % Math.ceil(large.length / ENDS) === 0);
}

/**
 * The length of a line, and once more the width of the marks of others that it crosses; `most` where it is no less.
 *
 * @param {Line} line
 * @param {number} group
 * @param {Field} field
 * @param {number} most
 */
function costOf(line, group, field, most) {
  const length = lengthOf(line);
  return length + field.crossed(line, group, most - length);
}

/** @param {Line} line */
function lengthOf({ x1, y1, x2, y2 }) {
  return Math.sqrt((x2 - x1) ** 2 + (y2 - y1) ** 2);
}

/** Marks in cells, to find those near a box. */
class Field {
  /** @type {(Dot[] | undefined)[]} */
  #cells = [];

  /**
   * @param {readonly Mark[]} marks
   * @param {ReadonlySet<Mark>} clustered those in the largest cluster of their class
   * @param {number} radius the largest
   * @param {{ width: number, height: number }} frame about all of them
   */
  constructor(marks, clustered, radius, { width, height }) {
    this.radius = radius;
    this.columns = Math.floor(width / CELL) + 1;
    this.rows = Math.floor(height / CELL) + 1;
    // Marks on one pixel of one class are one.
    const known = new Set();
    for (const mark of marks) {
      const { group, radius: own = radius } = mark;
      const [column, row] = [Math.round(mark.x), Math.round(mark.y)];
      const main = clustered.has(mark);
      const dot = ((group * 2 + Number(main)) * 2 + Number(own < radius)) * 1e8 + row * 1e4 + column;
      if (known.has(dot)) continue;
      known.add(dot);
      const [across, down] = [within(column, this.columns), within(row, this.rows)];
      const cell = (this.#cells[down * this.columns + across] ??= []);
      cell.push({ x: column, y: row, group, radius: own, main });
    }
  }

  /**
   * Pixels from a box to the closest edge of a mark; 0 where one is covered, more than `reach` where none is in reach.
   *
   * @param {Box} box
   * @param {number} reach
   * @param {(dot: Dot) => boolean} counts which marks count
   */
  gap(box, reach, counts) {
    let closest = Infinity;
    this.#each(box, reach + this.radius, (dot) => {
      const dx = Math.max(box.left - dot.x, 0, dot.x - box.right);
      const dy = Math.max(box.top - dot.y, 0, dot.y - box.bottom);
      // Most are too far, and that is told without a root.
      if (dx * dx + dy * dy < (closest + dot.radius) ** 2 && counts(dot))
        closest = Math.min(closest, Math.sqrt(dx * dx + dy * dy) - dot.radius);
    });
    return Math.max(0, closest);
  }

  /**
   * Whether the edge of a mark is no farther from a box than `distance`, or the box covers one.
   *
   * @param {Box} box
   * @param {number} distance
   * @param {(dot: Dot) => boolean} counts which marks count
   */
  reaches(box, distance, counts) {
    return this.#any(box, distance + this.radius, (dot) => {
      const dx = Math.max(box.left - dot.x, 0, dot.x - box.right);
      const dy = Math.max(box.top - dot.y, 0, dot.y - box.bottom);
      return dx * dx + dy * dy <= (distance + dot.radius) ** 2 && counts(dot);
    });
  }

  /**
   * Whether the middle of a mark is covered by none of another class.
   *
   * @param {Mark} mark
   */
  seen({ x, y, group }) {
    return !this.reaches({ left: x, right: x, top: y, bottom: y }, 0, (dot) => dot.group !== group);
  }

  /**
   * The widths of all marks of other classes that a line crosses, together; summed up to `most`.
   *
   * @param {Line} line
   * @param {number} group
   * @param {number} most
   */
  crossed({ x1, y1, x2, y2 }, group, most) {
    const box = { left: Math.min(x1, x2), right: Math.max(x1, x2), top: Math.min(y1, y2), bottom: Math.max(y1, y2) };
    const [dx, dy] = [x2 - x1, y2 - y1];
    const squared = Math.max(dx * dx + dy * dy, 1e-9);
    let sum = 0;
    this.#any(box, this.radius, (dot) => {
      if (dot.group === group) return false;
      const along = Math.min(Math.max(((dot.x - x1) * dx + (dot.y - y1) * dy) / squared, 0), 1);
      const across = x1 + along * dx - dot.x;
      const down = y1 + along * dy - dot.y;
      if (across * across + down * down < dot.radius ** 2) sum += 2 * dot.radius;
      return sum >= most;
    });
    return sum;
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
   * Visit the marks about a box.
   *
   * @param {Box} box
   * @param {number} margin
   * @param {(dot: Dot) => void} visit
   */
  #each(box, margin, visit) {
    this.#any(box, margin, (dot) => {
      visit(dot);
      return false;
    });
  }

  /**
   * Whether any mark about a box is one that is looked for: the first ends the search.
   *
   * @param {Box} box
   * @param {number} margin
   * @param {(dot: Dot) => boolean} is
   */
  #any(box, margin, is) {
    const { columns } = this;
    const [first, last] = [within(box.left - margin, columns), within(box.right + margin, columns)];
    const bottom = within(box.bottom + margin, this.rows);
    for (let row = within(box.top - margin, this.rows); row <= bottom; row += 1) {
      for (let column = first; column <= last; column += 1) {
        const cell = this.#cells[row * columns + column];
        if (cell?.some(is)) return true;
      }
    }
    return false;
  }
}

/**
 * The cell of a place along a side; those outside are in the outermost.
 *
 * @param {number} place
 * @param {number} cells
 */
function within(place, cells) {
  return Math.min(Math.max(Math.floor(place / CELL), 0), cells - 1);
}
const CELL = 12;

/** The names that have their places already, with their lines. */
class Taken {
  /** @type {Candidate[]} */
  #all = [];

  /** @param {{ width: number, height: number, covered?: Box[] }} frame */
  constructor(frame) {
    this.frame = frame;
  }

  /** @param {Candidate} candidate */
  add(candidate) {
    this.#all.push(candidate);
  }

  /**
   * @param {Box} box
   * @param {Line | null} line
   */
  hasRoom(box, line) {
    if (box.left < APART || box.top < APART) return false;
    if (box.right > this.frame.width - APART || box.bottom > this.frame.height - APART) return false;
    if (this.frame.covered?.some((own) => overlap(box, own))) return false;
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
 * Whether a line touches a box: it does not lie on one side of it, and its corners not on one side of the line.
 *
 * @param {Line} line
 * @param {Box} box
 */
function meets(line, { left, right, top, bottom }) {
  const { x1, y1, x2, y2 } = line;
  if ((x1 < left && x2 < left) || (x1 > right && x2 > right)) return false;
  if ((y1 < top && y2 < top) || (y1 > bottom && y2 > bottom)) return false;
  const sides =
    sideOf(line, left, top) + sideOf(line, right, top) + sideOf(line, left, bottom) + sideOf(line, right, bottom);
  return Math.abs(sides) < 4;
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
