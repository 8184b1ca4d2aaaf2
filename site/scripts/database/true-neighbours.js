// Who is most alike to a shape by what a map compares, whatever the map shows: fetched, or found, when first asked for.

import { part } from "../base/chunks.js";
import { LevelSimilarity, similarityOf } from "./level-similarity.js";

/** @import { Bins } from "./bins.js" */
/** @import { Database, ShapeMap } from "./database.js" */
/** @import { Choice, Similarity } from "./similarity.js" */

export class TrueNeighbours {
  /** @type {Uint32Array | null} those by all features, as many of each shape */
  #given = null;
  /** @type {{ bins: Bins, similarity: Similarity | LevelSimilarity } | null} */
  #by = null;
  /** @type {Set<string>} */
  #fetched = new Set();
  /** @type {{ index: number, map: ShapeMap, found: number[] } | null} */
  #last = null;

  /**
   * @param {Database} database with the maps of projections
   * @param {() => Promise<Bins>} loadBins
   * @param {() => void} heard is told when more is known
   */
  constructor(database, loadBins, heard) {
    this.database = database;
    this.loadBins = loadBins;
    this.heard = heard;
    this.ofSite = new Set(database.data.methods.map(({ key }) => key));
  }

  /**
   * As many shapes as the map has neighbours, the most alike first; null as long as it is not known.
   * @param {number} index
   * @param {ShapeMap} map
   * @returns {number[] | null}
   */
  of(index, map) {
    const last = this.#last;
    if (last?.index === index && last.map === map) return last.found;
    const found = this.ofSite.has(map.key) ? this.#all(index, map) : this.#among(index, map);
    if (found !== null) this.#last = { index, map, found };
    return found;
  }

  /**
   * @param {number} index
   * @param {ShapeMap} map
   */
  #all(index, { neighbours }) {
    if (this.#given === null) {
      this.#fetch("given", async () => {
        this.#given = new Uint32Array(await part("neighbours", 0));
      });
      return null;
    }
    const each = this.#given.length / this.database.count;
    return [...this.#given.subarray(index * each, index * each + neighbours)];
  }

  /**
   * @param {number} index
   * @param {ShapeMap} map
   */
  #among(index, map) {
    if (this.#by === null) {
      this.#fetch("bins", async () => {
        const bins = await this.loadBins();
        this.#by = { bins, similarity: similarityOf(bins) };
      });
      return null;
    }
    const { bins, similarity } = this.#by;
    /** @type {Choice} */
    const choice = map.compares ?? {
      features: [...bins.features.keys()].filter((feature) => map.features.includes(bins.features[feature].name)),
    };
    /** @param {number} other */
    const placed = (other) => !Number.isNaN(map.x[other]);
    if (similarity instanceof LevelSimilarity) {
      this.#look(index, map, () => similarity.nearest(index, choice, map.neighbours, placed));
      return null;
    }
    const row = bins.rowOf(index);
    if (row < 0) return null;
    return similarity
      .nearest(row, choice, map.neighbours, (other) => placed(bins.shapeOf(other)))
      .map((other) => bins.shapeOf(other));
  }

  /** @type {{ index: number, map: ShapeMap } | null} what is looked for */
  #asked = null;

  /**
   * @param {number} index
   * @param {ShapeMap} map
   * @param {() => Promise<number[]>} work
   */
  async #look(index, map, work) {
    if (this.#asked?.index === index && this.#asked.map === map) return;
    const asked = (this.#asked = { index, map });
    const found = await work();
    if (asked !== this.#asked) return;
    this.#asked = null;
    this.#last = { index, map, found };
    this.heard();
  }

  /**
   * @param {string} what
   * @param {() => Promise<void>} work
   */
  async #fetch(what, work) {
    if (this.#fetched.has(what)) return;
    this.#fetched.add(what);
    await work();
    this.heard();
  }
}
