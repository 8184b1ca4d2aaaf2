// The bins of all features: their names, what they mean, and their value for every shape.

import { chunk, joined } from "../base/chunks.js";
import { entry } from "../base/entry.js";
import { currentTheme } from "../base/theme.js";
import { measured, percent, percents, shortened } from "../base/words.js";
import { BinWords } from "./bin-words.js";
import { sampled } from "./sample.js";

const STEPS = 65535;

/** @type {Promise<Bins> | null} */
let loaded = null;

/** The bins of the site, fetched once a page. */
export function loadBins() {
  loaded ??= load();
  return loaded;
}

async function load() {
  const data = await chunk("workbench");
  return new Bins(data, await joined("bins", data.bytesOfBins, data.bytesAPart));
}

/** What stands in names of bins and in no words. */
const OF_NAMES = /[[\]:]/;

export class Bins {
  /**
   * @param {Chunk.Workbench} data
   * @param {ArrayBuffer} bytes the parts "bins"
   */
  constructor(data, bytes) {
    this.features = data.features;
    this.called = data.called;
    this.sentences = data.sentences;
    this.marks = data.marks;
    this.balanced = data.scaling === "balanced";
    this.names = binNames(this.features);
    this.#words = new BinWords(this);
    this.count = this.names.length;
    this.steps = new Uint16Array(bytes);
    /** How many shapes it knows: all, or those of a sample. */
    this.rows = this.steps.length / this.count;
    this.sample = data.sample;
    this.#rowOf = data.sample && rowsOf(data.sample);
    this.#featureOf = Int32Array.from(
      this.features.flatMap(({ dimensions, bins }, index) => Array(dimensions * bins).fill(index)),
    );
  }

  /** @type {Int32Array} */
  #featureOf;
  /** @type {Int32Array | null} */
  #rowOf;

  /**
   * The row of `steps` that a shape has; -1 where it is not of the sample.
   * @param {number} shape
   */
  rowOf(shape) {
    return this.#rowOf === null ? shape : (this.#rowOf[shape] ?? -1);
  }

  /**
   * The shape of a row of `steps`.
   * @param {number} row
   */
  shapeOf(row) {
    return this.sample === null ? row : this.sample[row];
  }

  /**
   * The index of the feature that a column belongs to.
   * @param {number} column
   */
  featureOf(column) {
    return this.#featureOf[column];
  }

  /**
   * A column's name in few letters: of a long one, the feature is cut, not the bin.
   * @param {number} column
   * @param {number} length
   */
  shortName(column, length) {
    const { name } = this.features[this.#featureOf[column]];
    const place = this.names[column].slice(name.length);
    return `${shortened(name, Math.max(length - place.length, 2))}${place}`;
  }

  /**
   * The number of a column's bin within its dimension, from 0.
   * @param {number} column
   */
  binOf(column) {
    const { start, bins } = this.features[this.#featureOf[column]];
    return (column - start) % bins;
  }

  /**
   * Whether a column is a share of the surface; features of whole shapes and external ones hold values of their own.
   * @param {number} column
   */
  isShare(column) {
    return this.features[this.#featureOf[column]].bins > 1;
  }

  /**
   * The number of a column's dimension among those of the local descriptors; null for all other features.
   * @param {number} column
   */
  dimensionOf(column) {
    if (!this.isShare(column)) return null;
    let before = 0;
    for (const feature of this.features.slice(0, this.#featureOf[column]))
      if (feature.bins > 1) before += feature.dimensions;
    const { start, bins: width } = this.features[this.#featureOf[column]];
    return before + Math.floor((column - start) / width);
  }

  /**
   * The compared value of a shape: the square root of its share of the surface where features are balanced; no number where
   * it is not of the sample.
   * @param {number} column
   * @param {number} shape
   */
  value(column, shape) {
    return this.valueAt(column, this.at(column, shape));
  }

  /**
   * The compared values of some shapes that are at hand, column after column.
   * @param {number[]} shapes
   */
  valuesOf(shapes) {
    const values = new Float32Array(this.count * shapes.length);
    for (let column = 0; column < this.count; column += 1) {
      for (let place = 0; place < shapes.length; place += 1)
        values[column * shapes.length + place] = this.value(column, shapes[place]);
    }
    return values;
  }

  /**
   * The step of a shape in a column; no number where it is not of the sample.
   * @param {number} column
   * @param {number} shape
   */
  at(column, shape) {
    const row = this.rowOf(shape);
    return row < 0 ? NaN : this.steps[column * this.rows + row];
  }

  /**
   * What tells the steps of some shapes, which are at hand, in a column.
   * @param {number[]} shapes
   * @returns {(column: number) => number[]}
   */
  reader(shapes) {
    return (column) => shapes.map((shape) => this.at(column, shape));
  }

  /**
   * The compared value at a step of a column.
   * @param {number} column
   * @param {number} step
   */
  valueAt(column, step) {
    const { low, high } = this.features[this.#featureOf[column]];
    return low + ((high - low) * step) / STEPS;
  }

  /**
   * What one step of `steps` is worth in a column.
   * @param {number} column
   */
  stepOf(column) {
    const { low, high } = this.features[this.#featureOf[column]];
    return (high - low) / STEPS;
  }

  /**
   * The compared values in one column, of all shapes or of the sample.
   * @param {number} column
   */
  column(column) {
    return Float32Array.from({ length: this.rows }, (_, row) =>
      this.valueAt(column, this.steps[column * this.rows + row]),
    );
  }

  /** @type {Map<number, number>} */
  #variances = new Map();

  /**
   * The variance of the compared values in a column.
   * @param {number} column
   */
  variance(column) {
    return entry(this.#variances, column, () => {
      const { steps, rows } = this;
      const start = column * rows;
      let total = 0;
      for (let row = 0; row < rows; row += 1) total += steps[start + row];
      const mean = total / rows;
      let squares = 0;
      for (let row = 0; row < rows; row += 1) squares += (steps[start + row] - mean) ** 2;
      return (squares / rows) * this.stepOf(column) ** 2;
    });
  }

  /**
   * Have the values of some shapes at hand.
   * @param {Iterable<number>} _shapes
   */
  async know(_shapes) {}

  /**
   * So many of some shapes that speak for all of them, rising; all where there are no more.
   * @param {number[]} shapes rising
   * @param {ArrayLike<number>} groups
   * @param {number} most
   * @param {number} [_parts] from how many parts at least, where values come in parts
   */
  some(shapes, groups, most, _parts) {
    return [...sampled(shapes, groups, most)];
  }

  /**
   * What `share` gives for every shape.
   * @param {number} column
   * @returns {Promise<number[]>}
   */
  async shares(column) {
    return Array.from({ length: this.rows }, (_, row) => this.share(column, row));
  }

  /**
   * A copy of the compared values in some columns, as the engine wants them.
   * @param {ArrayLike<number>} columns
   */
  stepped(columns) {
    const { features, rows } = this;
    const steps = new Uint16Array(columns.length * rows);
    for (let place = 0; place < columns.length; place += 1)
      steps.set(this.steps.subarray(columns[place] * rows, (columns[place] + 1) * rows), place * rows);
    return {
      steps,
      most: STEPS,
      low: features.map(({ low }) => low),
      high: features.map(({ high }) => high),
    };
  }

  /**
   * What a reader can picture: the share of a shape's surface, or of its pairs of places, that falls into a bin, in
   * [0, 1]; else the value itself; no number where it is not of the sample.
   * @param {number} column
   * @param {number} shape
   */
  share(column, shape) {
    return this.shareAt(column, this.at(column, shape));
  }

  /**
   * The same at a step of a column; rises with it.
   * @param {number} column
   * @param {number} step
   */
  shareAt(column, step) {
    const value = this.valueAt(column, step);
    return this.isSquare(column) ? value * value : value;
  }

  /**
   * Whether what `share` gives is the square of the compared value.
   * @param {number} column
   */
  isSquare(column) {
    return this.features[this.#featureOf[column]].rooted || (this.balanced && this.isShare(column));
  }

  /**
   * Whether what `share` gives is a share, of the surface or of pairs of places.
   * @param {number} column
   */
  inPercent(column) {
    return this.isShare(column) || this.features[this.#featureOf[column]].rooted;
  }

  /**
   * Values of a column, as `share` gives them, for readers: one by one.
   * @param {number} column
   * @returns {(value: number) => string}
   */
  telling(column) {
    return this.inPercent(column) ? (value) => percent(value) : measured;
  }

  /**
   * The same for values in one sentence, each told apart from the last one.
   * @param {number} column
   * @param {number[]} values
   */
  tell(column, values) {
    return this.inPercent(column) ? percents(...values) : values.map(measured);
  }

  /**
   * The columns that a text means: one name, or the beginning of several (`FPFH[14]:3`, `agd`, `PFH[2`), rising; else
   * what says it in words ("thick", "saddle"), best first; else all that several names name, with spaces or commas
   * between.
   * @param {string} text
   * @returns {number[]}
   */
  find(text) {
    const wanted = text.trim().toLowerCase();
    if (wanted === "") return [];
    const named = this.#named(wanted);
    if (named.length > 0) return named;
    const found = new Set(this.#where((name) => name.includes(wanted)));
    if (!OF_NAMES.test(wanted)) for (const column of this.#words.find(wanted)) found.add(column);
    if (found.size > 0) return [...found];
    const names = wanted.split(/[\s,;]+/).filter(Boolean);
    return [...new Set(names.flatMap((name) => this.#named(name)))].sort((a, b) => a - b);
  }

  /** Get ready to find: the first letter would else wait for it. */
  prepareToFind() {
    return this.#words.prepare();
  }

  /** What one may type instead, for who found nothing. */
  get searchHint() {
    const [first] = this.names;
    const words = this.#words.listed();
    return words.length === 0
      ? `No bin is called so. They have names as ${first}.`
      : `No bin is known by this. Words that find some: ${words.join(", ")}; or a name, as ${first}.`;
  }

  /** @type {string[] | null} */
  #searched = null;
  /** @type {BinWords} */
  #words;

  /** @param {string} wanted */
  #named(wanted) {
    const exact = this.#where((name) => name === wanted);
    return exact.length > 0 ? exact : this.#where((name) => name.startsWith(wanted));
  }

  /** @param {(name: string) => boolean} holds */
  #where(holds) {
    this.#searched ??= this.names.map((name) => name.toLowerCase());
    return this.#searched.flatMap((name, column) => (holds(name) ? [column] : []));
  }

  /**
   * How easily a stranger pictures the surface that a bin counts from its plain words; 1 is not at all.
   * @param {number} column
   */
  ease(column) {
    return this.features[this.#featureOf[column]].ease;
  }

  /**
   * What a bin means, exactly.
   * @param {number} column
   */
  sentence(column) {
    return this.sentences[column];
  }

  /**
   * The colour of a column's feature in the theme in use.
   * @param {number} column
   */
  color(column) {
    return this.colorOf(this.#featureOf[column]);
  }

  /**
   * The colour of a feature in the theme in use.
   * @param {number} feature
   */
  colorOf(feature) {
    return this.marks[currentTheme()].features[this.features[feature].hue];
  }
}

/**
 * The place of every shape in a sample, -1 for one that is not of it; up to the last that is.
 * @param {Int32Array} sample rising
 */
function rowsOf(sample) {
  const places = new Int32Array(/** @type {number} */ (sample.at(-1)) + 1).fill(-1);
  for (const [row, shape] of sample.entries()) places[shape] = row;
  return places;
}

/**
 * The names of all bins of some features.
 * @param {Chunk.Feature[]} features
 */
export function binNames(features) {
  return features.flatMap(namesOf);
}

/**
 * Names as `FeatureBlock.columns` makes them: the dimension from 0, the bin from 1.
 * @param {Chunk.Feature} feature
 */
function namesOf({ name, dimensions, bins }) {
  return Array.from({ length: dimensions * bins }, (_, place) => {
    const dimension = dimensions === 1 ? "" : `[${Math.floor(place / bins)}]`;
    return bins === 1 ? `${name}${dimension}` : `${name}${dimension}:${(place % bins) + 1}`;
  });
}
