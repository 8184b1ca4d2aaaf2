// Who of some points is nearest to others, exactly: points stand in groups around a few of them, and by the triangle
// inequality most groups, and most points of a group, need not be looked at.

/** @import { Points } from "./distances.js" */

/** Bounds that rounding may have moved by so little decide nothing. */
const SLACK = 1e-6;

/** A point that others stand around: how far the farthest is, who they are, and how far each is. */
/** @typedef {{ at: number, radius: number, members: Int32Array, far: Float64Array }} Group */

export class Nearest {
  /** Products so far, for who reports progress. */
  work = 0;

  /** @param {Points} points at least one */
  constructor(points) {
    this.points = points;
    const { count } = points;
    const groups = Math.ceil(Math.sqrt(count));
    const middles = Array.from({ length: groups }, (_, number) => Math.floor((number * count) / groups));
    /** @type {{ row: number, far: number }[][]} */
    const members = middles.map(() => []);
    for (let row = 0; row < count; row += 1) {
      const own = points.values.subarray(row * points.width, (row + 1) * points.width);
      let [best, least] = [0, Infinity];
      for (const [number, middle] of middles.entries()) {
        const squared = this.#squared(own, middle, least);
        if (squared < least) [best, least] = [number, squared];
      }
      members[best].push({ row, far: Math.sqrt(least) });
    }
    /** @type {Group[]} */
    this.groups = middles.flatMap((at, number) => {
      const own = members[number];
      if (own.length === 0) return [];
      return {
        at,
        radius: own.reduce((most, { far }) => Math.max(most, far), 0),
        members: Int32Array.from(own, ({ row }) => row),
        far: Float64Array.from(own, ({ far }) => far),
      };
    });
    this.#away = new Float64Array(this.groups.length);
  }

  /** @type {Float64Array} how far the middle of each group is from the point that is asked for */
  #away;

  /**
   * The row of the nearest point, the first of those that are equally near, and its squared distance.
   * @param {Float32Array} point
   */
  find(point) {
    const { groups } = this;
    const away = this.#away;
    const found = { row: 0, squared: Infinity };
    let first = 0;
    for (let number = 0; number < groups.length; number += 1) {
      const { at } = groups[number];
      const squared = this.#squared(point, at, Infinity);
      away[number] = Math.sqrt(squared);
      if (squared >= found.squared) continue;
      first = number;
      found.row = at;
      found.squared = squared;
    }
    this.#search(groups[first], away[first], point, found);
    for (let number = 0; number < groups.length; number += 1)
      if (number !== first) this.#search(groups[number], away[number], point, found);
    return found;
  }

  /**
   * @param {Group} group
   * @param {number} away
   * @param {Float32Array} point
   * @param {{ row: number, squared: number }} found what is nearest so far
   */
  #search({ radius, members, far }, away, point, found) {
    let reach = Math.sqrt(found.squared) * (1 + SLACK) + SLACK;
    if (away - radius > reach) return;
    for (let place = 0; place < members.length; place += 1) {
      if (Math.abs(away - far[place]) > reach) continue;
      const row = members[place];
      const squared = this.#squared(point, row, found.squared);
      if (squared < found.squared || (squared === found.squared && row < found.row)) {
        found.row = row;
        found.squared = squared;
        reach = Math.sqrt(squared) * (1 + SLACK) + SLACK;
      }
    }
  }

  /**
   * The squared distance to the point of a row; more than `limit` where it is more, but not how much.
   * @param {Float32Array} point
   * @param {number} row
   * @param {number} limit
   */
  #squared(point, row, limit) {
    const { width, values } = this.points;
    const start = row * width;
    let sum = 0;
    let place = 0;
    while (place < width && sum <= limit) {
      const end = Math.min(place + 8, width);
      for (; place < end; place += 1) {
        const difference = values[start + place] - point[place];
        sum += difference * difference;
      }
    }
    this.work += place;
    return sum;
  }
}
