// Parts of a map that are drawn to select what lies in them: what they hold, and how they look.

/** @import { Place } from "./brush.js" */

/**
 * @typedef {object} Area
 * @property {string} path its outline, as SVG writes paths
 * @property {(x: number, y: number) => boolean} holds
 */

/**
 * The box between two corners.
 * @param {Place} from
 * @param {Place} to
 * @returns {Area}
 */
export function boxOf([fromX, fromY], [toX, toY]) {
  const [left, right] = [Math.min(fromX, toX), Math.max(fromX, toX)];
  const [top, bottom] = [Math.min(fromY, toY), Math.max(fromY, toY)];
  return {
    path: `M${left} ${top}H${right}V${bottom}H${left}Z`,
    holds: (x, y) => x >= left && x <= right && y >= top && y <= bottom,
  };
}

/**
 * All that a line goes round, from its end straight back to its beginning. What it goes round twice is inside too, so
 * that a loop that crosses itself has no holes.
 * @param {Place[]} line
 * @returns {Area}
 */
export function lassoOf(line) {
  const [left, right] = [Math.min(...line.map(([x]) => x)), Math.max(...line.map(([x]) => x))];
  const [top, bottom] = [Math.min(...line.map(([, y]) => y)), Math.max(...line.map(([, y]) => y))];
  const strips = stripsOf(line, top, bottom);
  return {
    path: `M${line.map(([x, y]) => `${x} ${y}`).join("L")}Z`,
    holds: (x, y) =>
      x >= left && x <= right && y >= top && y <= bottom && rounds(strips[Math.floor((y - top) / STRIP)], x, y) !== 0,
  };
}

/** Of the edges of a line those are looked at that reach into the strip of a place, which is so many pixels high. */
const STRIP = 8;

/**
 * The edges of a closed line that reach into each strip, from the top: x and y of one end and of the other.
 * @param {Place[]} line
 * @param {number} top
 * @param {number} bottom
 */
function stripsOf(line, top, bottom) {
  /** @type {number[][]} */
  const strips = Array.from({ length: Math.floor((bottom - top) / STRIP) + 1 }, () => []);
  let [fromX, fromY] = line.at(-1);
  for (const [toX, toY] of line) {
    const last = Math.floor((Math.max(fromY, toY) - top) / STRIP);
    for (let strip = Math.floor((Math.min(fromY, toY) - top) / STRIP); strip <= last; strip += 1)
      strips[strip].push(fromX, fromY, toX, toY);
    [fromX, fromY] = [toX, toY];
  }
  return strips;
}

/**
 * How many times a closed line goes round a place, clockwise less anticlockwise.
 * @param {number[]} edges of the line, all that reach the height of the place
 * @param {number} x
 * @param {number} y
 */
function rounds(edges, x, y) {
  let number = 0;
  for (let place = 0; place < edges.length; place += 4) {
    const [fromX, fromY, toX, toY] = [edges[place], edges[place + 1], edges[place + 2], edges[place + 3]];
    // Which side of the edge the place lies on; half-open, so that a corner at its height counts once.
    const side = (toX - fromX) * (y - fromY) - (x - fromX) * (toY - fromY);
    if (fromY <= y && toY > y && side > 0) number += 1;
    else if (fromY > y && toY <= y && side < 0) number -= 1;
  }
  return number;
}
