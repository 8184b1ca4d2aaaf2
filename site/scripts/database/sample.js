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

/**
 * A number for each row that has nothing to do with where it stands.
 * @param {number} row
 */
function scattered(row) {
  let mixed = Math.imul(row + 1, 0x9e3779b1);
  mixed = Math.imul(mixed ^ (mixed >>> 15), 0x85ebca6b);
  return (mixed ^ (mixed >>> 13)) >>> 0;
}
