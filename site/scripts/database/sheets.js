// Small pictures of shapes on sheets, which maps of very many show: of each map those that its grids show, as
// shapeviz_report/pages/map_pictures.py chooses them.

import { entry } from "../base/entry.js";
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
  #shown = new Map();

  /**
   * @param {Chunk.Sheets} data
   * @param {number} count of shapes
   */
  constructor({ grids, across, maps }, count) {
    this.grids = grids;
    this.across = across;
    this.maps = maps;
    this.count = count;
  }

  /**
   * What is known of a map; of one that has no sheets, what is known of the first.
   * @param {string} key
   * @returns {Shown}
   */
  #of(key) {
    const own = key in this.maps ? key : Object.keys(this.maps)[0];
    return entry(this.#shown, own, () => {
      const place = new Int32Array(this.count).fill(-1);
      for (const [position, row] of this.maps[own].rows.entries()) place[row] = position;
      return { ...this.maps[own], place };
    });
  }

  /**
   * The number of the finest grid whose cells are no smaller than that; of the coarsest, 0, where all are.
   * @param {number} cell in units of the plane
   */
  grid(cell) {
    return Math.max(
      this.grids.findLastIndex((cells) => PLANE / cells >= cell),
      0,
    );
  }

  /**
   * The shapes of a map that a grid shows as pictures.
   * @param {string} key
   * @param {number} [grid]
   */
  shapes(key, grid = 0) {
    const { rows, ends } = this.#of(key);
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
