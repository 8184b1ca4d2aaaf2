// A sample of a large database: each class in proportion, always the same shapes.

import { entry } from "../base/entry.js";

/** More shapes than this are too many for a map or a score while one waits; docs/using/workbench.md has the measurements. */
export const MOST_SHAPES = 3000;

/**
 * As many of `rows` as a browser can take, rising; to the letter as `sample_rows` of shapeviz_report/pages/sampling.py,
 * which says how they are chosen.
 * @template {number[] | Int32Array} Rows
 * @param {Rows} rows
 * @param {ArrayLike<number>} groups
 * @param {number} [most]
 * @returns {Rows | Int32Array}
 */
export function sampled(rows, groups, most = MOST_SHAPES) {
  if (rows.length <= most) return rows;
  /** @type {Map<number, { row: number, place: number }[]>} */
  const members = new Map();
  for (const row of rows) entry(members, groups[row], () => []).push({ row, place: scattered(row) });
  const ranked = [...members.values()].flatMap((own) =>
    own.sort((a, b) => a.place - b.place).map((member, number) => ({ ...member, rank: number / own.length })),
  );
  ranked.sort((a, b) => a.rank - b.rank || a.place - b.place);
  return Int32Array.from(ranked.slice(0, most), ({ row }) => row).sort();
}

/** Of values that come in parts, so many parts are read for a sample at most; each is 50 kB. */
export const MOST_PARTS = 100;

/**
 * About `most` of some shapes whose values come in parts, rising: those that lie in some of the parts, which are taken at
 * equal steps from all that hold any, or every so many-th of them. Every shape is as likely as any other to be taken.
 * Which shapes of a class share a part has nothing to do with their values, but the parts follow class by class: a sample
 * that is to speak for shapes of many classes is taken from many parts, so that each class is there in proportion. All
 * where few parts hold them all.
 * @param {number[]} shapes rising
 * @param {ArrayLike<number>} places of all shapes in the order of the parts
 * @param {number} aPart
 * @param {number} most
 * @param {number} [least] parts that are read, where there are as many
 */
export function sampledByParts(shapes, places, aPart, most, least = 1) {
  const holds = new Uint8Array(Math.ceil(places.length / aPart));
  for (const shape of shapes) holds[Math.floor(places[shape] / aPart)] = 1;
  const parts = [...holds.keys()].filter((number) => holds[number] === 1);
  const needed = Math.ceil((parts.length * most) / Math.max(shapes.length, most));
  const wanted = Math.min(Math.max(needed, least), MOST_PARTS, parts.length);
  if (wanted === parts.length && shapes.length <= most) return shapes;
  /** @type {Map<number, number[]>} */
  const read = new Map();
  for (let number = 0; number < wanted; number += 1)
    read.set(parts[Math.floor(((number + 0.5) * parts.length) / wanted)], []);
  for (const shape of shapes) read.get(Math.floor(places[shape] / aPart))?.push(shape);
  const found = [...read.values()].flat();
  const step = Math.max(Math.floor(found.length / most), 1);
  return found.filter((_, place) => place % step === 0).sort((a, b) => a - b);
}

/**
 * A number for each row that has nothing to do with where it stands.
 * @param {number} row
 */
function scattered(row) {
  let mixed = Math.imul(row + 1, 0x9e3779b1);
  mixed = Math.imul(mixed ^ (mixed >>> 15), 0x85ebca6b);
  return (mixed ^ (mixed >>> 13)) >>> 0;
}
