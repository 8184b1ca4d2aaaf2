// Clusters of marks on a map as it is drawn: which is the largest of a class, and what is in its middle.

/**
 * A shape that is shown, in pixels; with a radius of its own where it is not drawn as large as most.
 * @typedef {{ index: number, group: number, x: number, y: number, radius?: number }} Mark
 */

/** Marks whose edges are no farther from each other are one cluster. */
const LINK = 20;
const NEIGHBOURHOOD = 40;

/** Of many marks that a class has in one place, one: others would tell nothing that it does not, and take their time. */
export class Thinning {
  /**
   * @param {number} width of the drawing
   * @param {number} height
   * @param {number} side of a place
   */
  constructor(width, height, side) {
    this.side = side;
    this.columns = Math.ceil(width / side) + 1;
    this.last = new Int32Array(this.columns * (Math.ceil(height / side) + 1)).fill(-2);
  }

  /**
   * Whether a mark is the first of its class there; as shapes come class by class, the last one tells.
   * @param {number} x
   * @param {number} y
   * @param {number} group
   */
  takes(x, y, group) {
    const place = Math.floor(y / this.side) * this.columns + Math.floor(x / this.side);
    if (this.last[place] === group) return false;
    this.last[place] = group;
    return true;
  }
}

/**
 * The largest cluster of a class: marks each of which is linked to another of them.
 *
 * @param {readonly Mark[]} members
 * @param {number} most the largest radius
 * @returns {Mark[]}
 */
export function largestCluster(members, most) {
  const side = 2 * most + LINK;
  // The last mark in each cell, and the one before each; as lists, those of a crowd would be many megabytes.
  /** @type {Map<number, number>} */
  const last = new Map();
  const before = new Int32Array(members.length);
  for (let place = 0; place < members.length; place += 1) {
    const key = keyOf(Math.floor(members[place].x / side), Math.floor(members[place].y / side));
    before[place] = last.get(key) ?? -1;
    last.set(key, place);
  }
  // One cluster after the other.
  const found = new Int32Array(members.length);
  let [end, first, beyond] = [0, 0, 0];
  for (const key of last.keys()) {
    for (let next = last.get(key) ?? -1; next >= 0; next = last.get(key) ?? -1) {
      const start = end;
      last.set(key, before[next]);
      found[end++] = next;
      for (let at = start; at < end; at += 1) {
        const mark = members[found[at]];
        for (let i = -1; i <= 1; i += 1) {
          for (let j = -1; j <= 1; j += 1) {
            const cell = keyOf(Math.floor(mark.x / side) + i, Math.floor(mark.y / side) + j);
            let kept = -1;
            for (let near = last.get(cell) ?? -1; near >= 0; near = before[near]) {
              if (!linked(mark, members[near], most)) {
                kept = near;
                continue;
              }
              found[end++] = near;
              if (kept < 0) last.set(cell, before[near]);
              else before[kept] = before[near];
            }
          }
        }
      }
      if (end - start > beyond - first) [first, beyond] = [start, end];
    }
  }
  return Array.from(found.subarray(first, beyond), (place) => members[place]);
}

/**
 * @param {Mark} mark
 * @param {Mark} other
 * @param {number} most
 */
function linked({ x, y, radius }, other, most) {
  const across = x - other.x;
  const down = y - other.y;
  const reach = (radius ?? most) + (other.radius ?? most) + LINK;
  return across * across + down * down <= reach * reach;
}

/**
 * The mark in the middle of where most of a cluster lie, so that a name does not float between two halves of it; one of the
 * largest, such as a picture among dots.
 *
 * @param {readonly Mark[]} cluster
 * @param {number} most the largest radius
 * @returns {Mark}
 */
export function heartOf(cluster, most) {
  const reach = Math.max(NEIGHBOURHOOD, 3 * most);
  const densest = densestOf(cluster, reach);
  const crowd = cluster.filter(
    (mark) => Math.abs(mark.x - densest.x) < 1.5 * reach && Math.abs(mark.y - densest.y) < 1.5 * reach,
  );
  const x = crowd.reduce((sum, mark) => sum + mark.x, 0) / crowd.length;
  const y = crowd.reduce((sum, mark) => sum + mark.y, 0) / crowd.length;
  /** @param {Mark} mark */
  const rank = (mark) => Math.hypot(mark.x - x, mark.y - y);
  const largest = Math.max(...crowd.map(({ radius }) => radius ?? most));
  return crowd.filter(({ radius }) => (radius ?? most) === largest).reduce((a, b) => (rank(b) < rank(a) ? b : a));
}

/**
 * A mark with most others in its cell and those around it.
 *
 * @param {readonly Mark[]} marks
 * @param {number} side of a cell
 */
function densestOf(marks, side) {
  const cells = marks.map(({ x, y }) => keyOf(Math.floor(x / side), Math.floor(y / side)));
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

/**
 * The key of a cell.
 * @param {number} column
 * @param {number} row
 */
export function keyOf(column, row) {
  return row * 100000 + column;
}
