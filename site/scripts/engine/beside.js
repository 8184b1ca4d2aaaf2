// The task "beside": places for shapes that a map was not made of, each beside the one of the map that is most like it by
// what the map compares.

import { factorsOf, scaledPoints } from "./distances.js";
import { Nearest } from "./nearest.js";

/**
 * Values of some columns for further shapes: `steps` from `low`, each worth `step`, a column.
 * @typedef {{ steps: Uint8Array | Uint16Array, low: number, step: number }} Column
 */

/** Products between two reports: some milliseconds of work. */
const WORK = 2e6;

/** Those beside a shape stand on a spiral, each turned by this angle from the last one, so that none hides another. */
const TURN = Math.PI * (3 - Math.sqrt(5));

/** Of the way to the next shape of the map, the part that those beside a shape have: so they are beside no other. */
const ROOM = 0.45;

/** They have at least this, of a map from -1 to 1, and at most so many times the usual: a shape far from all others needs no more. */
const LEAST_ROOM = 0.001;
const MOST_ROOM = 2;

/**
 * @param {FeatureValues} table
 * @param {{ rows: Int32Array, columns: Int32Array, by: "features" | "bins", xy: Float32Array, others: Column[] }} task
 *   rows, columns, by: what the map was made of; xy (2 n): where it has them; others: the same columns of further shapes
 * @returns {Steps<{ xy: Float32Array }>} the places of these
 */
export function* placeBeside(table, { rows, columns, by, xy, others }) {
  const points = scaledPoints(table, rows, columns, by);
  const factors = factorsOf(table, columns, by);
  const nearest = new Nearest(points);
  const count = others[0].steps.length;
  const beside = new Int32Array(count);
  const squared = new Float64Array(count);
  const point = new Float32Array(columns.length);
  let reported = 0;
  for (let other = 0; other < count; other += 1) {
    for (const [place, { steps, low, step }] of others.entries())
      point[place] = (low + step * steps[other]) * factors[place];
    const found = nearest.find(point);
    beside[other] = found.row;
    squared[other] = found.squared;
    if (nearest.work - reported > WORK) {
      reported = nearest.work;
      yield { progress: other / count };
    }
  }
  return { xy: spread(xy, beside, squared) };
}

/**
 * Places around those of the map: on a spiral a shape, the most alike in the middle.
 * @param {Float32Array} xy
 * @param {Int32Array} beside whom each further shape belongs to
 * @param {Float64Array} squared how far it is from that one
 */
export function spread(xy, beside, squared) {
  const rooms = roomsOf(xy);
  const sizes = new Int32Array(rooms.length);
  for (const row of beside) sizes[row] += 1;
  const order = Int32Array.from(beside.keys()).sort((a, b) => squared[a] - squared[b] || a - b);
  const placed = new Float32Array(2 * beside.length);
  const taken = new Int32Array(rooms.length);
  for (const other of order) {
    const row = beside[other];
    taken[row] += 1;
    const away = rooms[row] * Math.sqrt(taken[row] / sizes[row]);
    placed[2 * other] = xy[2 * row] + away * Math.cos(taken[row] * TURN);
    placed[2 * other + 1] = xy[2 * row + 1] + away * Math.sin(taken[row] * TURN);
  }
  return placed;
}

/**
 * How far from each shape of a map others may stand.
 * @param {Float32Array} xy
 */
function roomsOf(xy) {
  const count = xy.length / 2;
  const nearest = new Float64Array(count).fill(Infinity);
  for (let row = 0; row < count; row += 1)
    for (let other = 0; other < row; other += 1) {
      const squared = (xy[2 * row] - xy[2 * other]) ** 2 + (xy[2 * row + 1] - xy[2 * other + 1]) ** 2;
      if (squared < nearest[row]) nearest[row] = squared;
      if (squared < nearest[other]) nearest[other] = squared;
    }
  const rooms = nearest.map((squared) => ROOM * Math.sqrt(squared));
  const usual = rooms.slice().sort()[count >> 1];
  return rooms.map((room) => Math.max(Math.min(room, MOST_ROOM * usual), LEAST_ROOM));
}
