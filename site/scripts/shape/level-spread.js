// How the values of a bin are spread, in a database that has more of them than a page can hold: from what the build has
// counted, class by class.

import { part } from "../base/chunks.js";
import { entry } from "../base/entry.js";
import { quantile } from "../bins-kit/bin-card.js";

/** @import { Database } from "../database/database.js" */
/** @import { LevelBins } from "../database/level-bins.js" */
/** @import { Quarters } from "./spread.js" */

const QUARTERS = [0.25, 0.5, 0.75];

export class LevelSpread {
  /**
   * @param {Database} database
   * @param {LevelBins} bins
   */
  constructor(database, bins) {
    this.database = database;
    this.bins = bins;
    this.aCell = bins.levels.levelsACell;
  }

  /** @type {Chunk.ClassPart} of all shapes */
  #all;
  /** @type {{ shape: number, own: Chunk.ClassPart | null } | null} the class of a shape */
  #class = null;
  /** @type {Map<number, Quarters>} */
  #ofAll = new Map();

  /**
   * Have at hand what is told of a shape.
   * @param {number} shape
   */
  async know(shape) {
    const group = this.database.groups[shape];
    const [all, own] = await Promise.all([
      part("classes", this.database.classes.length),
      group < 0 ? null : part("classes", group),
      this.bins.know([shape]),
    ]);
    this.#all = all;
    this.#class = { shape, own };
  }

  /** @param {number} column */
  all(column) {
    return entry(this.#ofAll, column, () => this.#quarters(column, this.#all, null));
  }

  /**
   * @param {number} column
   * @param {number} shape
   */
  fellows(column, shape) {
    const own = this.#class?.own ?? null;
    return own === null || own.shapes < 2 ? null : this.#quarters(column, own, shape);
  }

  /**
   * @param {number} column
   * @param {number} shape
   */
  rank(column, shape) {
    const { cells, shapes } = this.#all;
    const level = this.bins.at(column, shape);
    const first = this.#first(cells, column);
    const cell = Math.floor(level / this.aCell);
    let below = 0;
    for (let place = first; place < first + cell; place += 1) below += cells[place];
    // Within its cell the others lie evenly.
    const share = (level - cell * this.aCell + 0.5) / this.aCell;
    return shapes > 1 ? (below + (cells[first + cell] - 1) * share) / (shapes - 1) : 0.5;
  }

  /**
   * @param {number} feature
   * @param {number} shape
   */
  mostUnusual(feature, shape) {
    const { bins } = this;
    const { start, dimensions, bins: width } = bins.features[feature];
    let [best, most] = [0, -1];
    for (let dimension = 0; dimension < dimensions; dimension += 1) {
      let total = 0;
      for (let place = 0; place < width; place += 1) {
        const column = start + dimension * width + place;
        total += ((bins.at(column, shape) - this.#all.means[column]) * bins.stepOf(column)) ** 2;
      }
      if (total > most) [best, most] = [dimension, total];
    }
    return best;
  }

  /**
   * @param {Uint32Array} cells
   * @param {number} column
   */
  #first(cells, column) {
    return (column * cells.length) / this.bins.count;
  }

  /**
   * @param {number} column
   * @param {Chunk.ClassPart} counted
   * @param {number | null} but a shape that is not counted
   * @returns {Quarters}
   */
  #quarters(column, { cells, shapes }, but) {
    const { bins, aCell } = this;
    const first = this.#first(cells, column);
    const counts = cells.slice(first, this.#first(cells, column + 1));
    if (but !== null) counts[Math.floor(bins.at(column, but) / aCell)] -= 1;
    const length = but === null ? shapes : shapes - 1;
    /** @param {number} place among all in rising order */
    const at = (place) => {
      let [cell, before] = [0, 0];
      while (before + counts[cell] <= place) {
        before += counts[cell];
        cell += 1;
      }
      // Those of a cell lie evenly in it, the lowest of all at its lower end and the highest at its upper.
      const within = counts[cell] > 1 ? (place - before) / (counts[cell] - 1) : 0.5;
      return bins.shareAt(column, (cell + within) * aCell - within);
    };
    const [low, middle, high] = QUARTERS.map((share) => quantile({ length, at }, share));
    return { low, middle, high, least: at(0), most: at(length - 1) };
  }
}
