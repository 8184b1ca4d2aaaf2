// Small pictures of shapes on sheets, which maps of very many show: of each map those that its grids show, as
// shapeviz_report/pages/map_pictures.py chooses them.

import { resource } from "../base/place.js";

/**
 * A picture on a sheet: in which column and line it lies.
 * @typedef {{ address: string, column: number, line: number }} Cut
 *
 * @typedef {{ rows: Int32Array, ends: number[], sheets: string[], place: Int32Array }} Shown
 */

/** The places of a map go from -1 to 1. */
const PLANE = 2;

export class Sheets {
  /** @type {Map<string, Shown>} */
  #maps = new Map();

  /**
   * @param {Chunk.Sheets} data
   * @param {number} count of shapes
   */
  constructor({ grids, across, maps }, count) {
    this.grids = grids;
    this.across = across;
    for (const [key, { rows, ends, sheets }] of Object.entries(maps)) {
      const place = new Int32Array(count).fill(-1);
      for (const [position, row] of rows.entries()) place[row] = position;
      this.#maps.set(key, { rows, ends, sheets, place });
    }
  }

  /**
   * What is known of a map; of one that has no sheets, what is known of the first.
   * @param {string} key
   * @returns {Shown}
   */
  #of(key) {
    return /** @type {Shown} */ (this.#maps.get(key) ?? this.#maps.values().next().value);
  }

  /**
   * The shapes of a map that may have a picture where cells are to be no smaller than that: those of the coarsest grid at
   * least.
   * @param {string} key
   * @param {number} [cell] in units of the plane
   */
  shapes(key, cell = Infinity) {
    const { rows, ends } = this.#of(key);
    const grid = Math.max(
      this.grids.findLastIndex((cells) => PLANE / cells >= cell),
      0,
    );
    return rows.subarray(0, ends[grid]);
  }

  /**
   * The picture of a shape that a map may show.
   * @param {string} key
   * @param {number} row
   * @returns {Cut}
   */
  cut(key, row) {
    const { sheets, place } = this.#of(key);
    const on = this.across ** 2;
    const position = place[row];
    const within = position % on;
    return {
      address: resource(`sheets/${sheets[Math.floor(position / on)]}`),
      column: within % this.across,
      line: Math.floor(within / this.across),
    };
  }
}
