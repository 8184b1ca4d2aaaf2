// The bins of a database that has more values than a page can hold: they come shape by shape, or bin by bin, when asked
// for, each in levels from the lowest to the highest value of its column. shapeviz_report/pages/levels.py writes them.

import { chunks, isThere, part } from "../base/chunks.js";
import { Bins, loadBins } from "./bins.js";
import { levelsOf, STEPS } from "./levels.js";
import { sampledByParts } from "./sample.js";

/** Shapes that are kept at hand, at least; 2.7 kB each. */
const MOST_KNOWN = 4000;

/** @type {Promise<Bins> | null} */
let loaded = null;

/** The bins of all shapes of the site, whatever its size. */
export function loadAllBins() {
  loaded ??= load();
  return loaded;
}

async function load() {
  if (!isThere("levels")) return loadBins();
  const [work, levels] = await chunks("workbench", "levels");
  return new LevelBins(work, levels);
}

export class LevelBins extends Bins {
  /**
   * @param {Chunk.Workbench} work
   * @param {Chunk.Levels} levels
   */
  constructor(work, levels) {
    super({ ...work, sample: new Int32Array() }, new ArrayBuffer(0));
    this.levels = levels;
    /** How many shapes there are. */
    this.shapes = levels.order.length;
  }

  /** @type {Map<number, Uint8Array>} the levels of a shape; the one that was asked for last comes last */
  #known = new Map();
  /** @type {Int32Array | null} */
  #places = null;

  /** The place of every shape in the order of the rows. */
  get places() {
    this.#places ??= placesIn(this.levels.order);
    return this.#places;
  }

  /**
   * About so many of some shapes, from few parts of the rows, or from more.
   * @param {number[]} shapes rising
   * @param {ArrayLike<number>} _groups
   * @param {number} most
   * @param {number} [parts]
   */
  some(shapes, _groups, most, parts) {
    return sampledByParts(shapes, this.places, this.levels.rowsAPart, most, parts);
  }

  /** @param {Iterable<number>} shapes */
  async know(shapes) {
    const { rowsAPart } = this.levels;
    const { places } = this;
    const wanted = new Set(shapes);
    /** @type {Map<number, number[]>} */
    const byPart = new Map();
    for (const shape of wanted) {
      const known = this.#known.get(shape);
      if (known !== undefined) this.#keep(shape, known);
      else {
        const number = Math.floor(places[shape] / rowsAPart);
        byPart.set(number, [...(byPart.get(number) ?? []), shape]);
      }
    }
    await Promise.all(
      [...byPart].map(async ([number, missing]) => {
        const rows = await part("rows", number);
        for (const shape of missing) {
          const start = (places[shape] - number * rowsAPart) * this.count;
          // A copy, as what it is a part of need not stay.
          this.#keep(shape, new Uint8Array(rows, start, this.count).slice());
        }
      }),
    );
    for (const shape of this.#known.keys()) {
      if (this.#known.size <= Math.max(MOST_KNOWN, wanted.size)) break;
      this.#known.delete(shape);
    }
  }

  /**
   * @param {number} shape
   * @param {Uint8Array} levels
   */
  #keep(shape, levels) {
    this.#known.delete(shape);
    this.#known.set(shape, levels);
  }

  /**
   * The level of a shape in a column; no number where it is not at hand.
   * @param {number} column
   * @param {number} shape
   */
  at(column, shape) {
    return this.#known.get(shape)?.[column] ?? NaN;
  }

  /** @param {number[]} shapes */
  #rowsOf(shapes) {
    return shapes.map((shape) => /** @type {Uint8Array} */ (this.#known.get(shape)));
  }

  /**
   * Not by `at`: to look each shape up for each column takes longer than all that is done with the values.
   * @param {number[]} shapes
   */
  reader(shapes) {
    const rows = this.#rowsOf(shapes);
    return (/** @type {number} */ column) => rows.map((levels) => levels[column]);
  }

  /** @param {number[]} shapes */
  valuesOf(shapes) {
    const rows = this.#rowsOf(shapes);
    const values = new Float32Array(this.count * rows.length);
    for (let column = 0, place = 0; column < this.count; column += 1) {
      const low = this.levels.low[column];
      const step = this.stepOf(column);
      for (const levels of rows) {
        values[place] = low + step * levels[column];
        place += 1;
      }
    }
    return values;
  }

  /**
   * @param {number} column
   * @param {number} level
   */
  valueAt(column, level) {
    return this.levels.low[column] + this.stepOf(column) * level;
  }

  /** @param {number} column */
  stepOf(column) {
    return (this.levels.high[column] - this.levels.low[column]) / STEPS;
  }

  /** @param {number} column */
  variance(column) {
    return this.levels.variances[column];
  }

  /** @param {number} column */
  async shares(column) {
    const levels = await levelsOf(this, column);
    const told = Array.from({ length: STEPS + 1 }, (_, level) => this.shareAt(column, level));
    return Array.from(levels, (level) => told[level]);
  }
}

/**
 * The place of every shape in an order.
 * @param {Int32Array} order
 */
function placesIn(order) {
  const places = new Int32Array(order.length);
  for (let place = 0; place < order.length; place += 1) places[order[place]] = place;
  return places;
}
