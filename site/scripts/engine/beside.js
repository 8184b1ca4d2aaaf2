// The task "beside": places for shapes that a map was not made of, each beside the one of the map that is most like it by
// what the map compares.

import { factorsOf } from "./distances.js";
import { Nearest } from "./nearest.js";
import { reader } from "./table.js";

/**
 * What a map compares: columns of the table, of which shapes are rows; or further numbers of shapes, each with what a
 * squared difference of one counts.
 * @typedef {{ columns: Int32Array, by: "features" | "bins" }} OfTable
 * @typedef {{ numbers: { values: Uint8Array, unit: number }[] }} OfNumbers
 */

/** Products between two reports: some milliseconds of work. */
const WORK = 2e6;

/** Those beside a shape stand on a spiral, each turned by this angle from the last one, so that none hides another. */
const TURN = Math.PI * (3 - Math.sqrt(5));

/** Of the way to the next shape of the map, the part that those beside a shape have: so they are beside no other. */
const ROOM = 0.45;

/** They have at least this, of a map from -1 to 1; and no more than so many times the usual, however far the next is. */
const LEAST_ROOM = 0.001;
const MOST_ROOM = 2;

/**
 * @param {FeatureValues} table
 * @param {{ compared: OfTable | OfNumbers, shapes: Int32Array, xy: ArrayLike<number>, others: Int32Array }} task
 *   shapes, xy (2 n): those that the map was made of, and where it has them; others: who is to be placed
 * @returns {Steps<{ xy: Float32Array }>} the places of these
 */
export function* placeBeside(table, { compared, shapes, xy, others }) {
  const { width, read } = pointReader(table, compared);
  const points = { count: shapes.length, width, values: new Float32Array(shapes.length * width) };
  for (const [row, shape] of shapes.entries()) read(shape, points.values.subarray(row * width, (row + 1) * width));
  const nearest = new Nearest(points);
  const beside = new Int32Array(others.length);
  const squared = new Float64Array(others.length);
  const point = new Float32Array(width);
  let reported = 0;
  for (const [place, shape] of others.entries()) {
    read(shape, point);
    const found = nearest.find(point);
    beside[place] = found.row;
    squared[place] = found.squared;
    if (nearest.work - reported > WORK) {
      reported = nearest.work;
      yield { progress: place / others.length };
    }
  }
  return { xy: spread(xy, beside, squared) };
}

/**
 * What writes a shape as a point into an array.
 * @param {FeatureValues} table
 * @param {OfTable | OfNumbers} compared
 * @returns {{ width: number, read: (shape: number, point: Float32Array) => void }}
 */
function pointReader(table, compared) {
  if ("numbers" in compared) {
    const { numbers } = compared;
    const roots = numbers.map(({ unit }) => Math.sqrt(unit));
    return {
      width: numbers.length,
      read(shape, point) {
        for (let place = 0; place < point.length; place += 1)
          point[place] = numbers[place].values[shape] * roots[place];
      },
    };
  }
  const { columns, by } = compared;
  const factors = factorsOf(table, columns, by);
  const readers = Array.from(columns, (column) => reader(table, column));
  return {
    width: columns.length,
    read(shape, point) {
      for (let place = 0; place < point.length; place += 1) point[place] = readers[place](shape) * factors[place];
    },
  };
}

/**
 * Places around those of the map: on a spiral a shape, the most alike in the middle.
 * @param {ArrayLike<number>} xy
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
 * @param {ArrayLike<number>} xy
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
