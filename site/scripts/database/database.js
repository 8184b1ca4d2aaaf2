// The shapes, classes and projections of the database, as the views ask for them.

import { chunk, part } from "../base/chunks.js";
import { picturesOf } from "../base/pictures.js";
import { reachOf } from "./hit-range.js";
import { sharesOf } from "./shares.js";
import { Sheets } from "./sheets.js";
import { textsOf } from "./texts.js";

/** @import { Theme } from "../base/theme.js" */
/** @import { Choice } from "./similarity.js" */

/**
 * A map of all shapes, with its quality: of a projection, of a subset of the features, or one that was made here. Shapes
 * that have no place on it have coordinates that are no numbers.
 * @typedef {object} ShapeMap
 * @property {string} key
 * @property {string} title
 * @property {string} [note]
 * @property {string[]} features
 * @property {ArrayLike<number>} x
 * @property {ArrayLike<number>} y
 * @property {(number | null)[]} hit
 * @property {number} neighbours
 * @property {(number | null)[]} hitOfClass
 * @property {number | null} hitOfAll
 * @property {Chunk.WithoutCopies | null} [withoutCopies]
 * @property {number | null} chance
 * @property {number | null} chanceSpread
 * @property {Faith | null} [faith] how far it shows who is like whom
 * @property {Int32Array} [sample] the shapes that it was measured on, rising, where these are not all that have a place
 * @property {Choice} [compares] what it is made from, where this is not its features, or those of all maps of the site
 * @property {() => Promise<void>} [know] fetches what it shows of the neighbours of each shape
 *
 * Without what is known of each shape as long as nobody asked for it; a diagram have the maps of projections.
 * @typedef {Omit<Chunk.Faith, "kept" | "shepard"> & { kept?: Shares, false?: Shares, missing?: Shares, shepard?: Chunk.Shepard | null }} Faith
 * @typedef {(number | null)[] | null} Shares of each shape
 *
 * @typedef {ShapeMap & { base: number }} Method one that belongs to a projection of all features: itself, or the one it is set beside
 * @typedef {{ x: number, y: number, width: number, height: number }} Bounds the middle and the size of a rectangle
 */

export class Database {
  /**
   * @param {Chunk.Overview} data
   * @param {() => Theme} theme
   */
  constructor(data, theme) {
    this.data = data;
    this.theme = theme;
    this.count = data.shapes.groups.length;
    this.ids = textsOf(data.shapes.ids);
    this.names = textsOf(data.shapes.names);
    this.groups = data.shapes.groups;
    this.classes = data.classes;
    this.pictures = picturesOf(data);
    /** @type {ShapeMap[]} of all features, or of the bins that the site was made for */
    this.projections = data.methods.map((method) => ({ ...mapOf(method), know: () => this.#know() }));
    /** @type {Method[]} those, and others that are added to them */
    this.methods = this.projections.map((map, base) => ({ ...map, base }));
    /** @type {Map<number, number>} */
    this.sizes = new Map();
    for (const group of this.groups) this.sizes.set(group, (this.sizes.get(group) ?? 0) + 1);
    this.bounds = this.methods.map(bounds);
    this.revision = 0;
    /** @type {Sheets | null} small pictures for maps, where there are very many shapes and they were fetched */
    this.sheets = null;
  }

  /** Fetch the small pictures for maps, if there are any. */
  async fetchSheets() {
    const sheets = await chunk("sheets");
    if (Object.keys(sheets.maps).length > 0) this.sheets ??= new Sheets(sheets, this.count);
  }

  /**
   * Add the map of a subset of the features beside projection `base`; its index among the methods.
   * @param {ShapeMap} map
   * @param {number} base
   */
  add(map, base) {
    const known = this.methods.findIndex(({ key }) => key === map.key);
    if (known >= 0) return known;
    this.methods.push({ ...map, base });
    this.bounds.push(bounds(map));
    this.revision += 1;
    return this.methods.length - 1;
  }

  /**
   * Show another map as the only one, for a page whose maps are made while one looks.
   * @param {ShapeMap} map
   */
  replace(map) {
    this.methods = [{ ...map, base: 0 }];
    this.bounds = [bounds(map)];
    this.revision += 1;
  }

  /** Fetch what the projections show of the neighbours of each shape. */
  async #know() {
    const trust = await chunk("trust");
    for (const { key, faith } of this.projections) if (faith && !faith.false) tell(faith, trust[key]);
  }

  /** @type {Map<string, number> | undefined} */
  #indexOfId;

  /** For who looks for very many. */
  get indexOfId() {
    this.#indexOfId ??= new Map(Array.from(this.ids, (id, index) => [id, index]));
    return this.#indexOfId;
  }

  /** Colours and chart configuration of the theme in use. */
  get marks() {
    return this.data.marks.themes[this.theme()];
  }

  get labelled() {
    return this.classes.length > 0;
  }

  /** Whether there are classes to tell apart. */
  get separable() {
    return this.classes.length > 1;
  }

  /**
   * What is known of a shape beyond its place.
   * @param {number} index
   * @returns {Promise<Chunk.ShapeDetails>}
   */
  async details(index) {
    const size = this.data.partSizes.details;
    return (await part("details", Math.floor(index / size)))[index % size];
  }

  /** @param {number} group */
  className(group) {
    return group < 0 ? "no label" : this.classes[group];
  }

  /** @param {number} group */
  color(group) {
    return group < 0 ? this.marks.unlabelled : this.marks.classes[group];
  }

  /** @param {number} group */
  symbol(group) {
    return group < 0 ? this.data.marks.plain : this.data.marks.symbols[group];
  }

  /**
   * Indices of the shapes nearest to one on a map, nearest first; as many as its neighbourhood hit counts.
   * @param {number} index
   * @param {number} methodIndex
   */
  neighbours(index, methodIndex) {
    const key = `${index} ${methodIndex} ${this.revision}`;
    if (this.#nearest?.key !== key) this.#nearest = { key, found: this.#findNeighbours(index, methodIndex) };
    return this.#nearest.found;
  }

  // A moving map asks for the neighbours of one shape with every frame.
  /** @type {{ key: string, found: number[] } | null} */
  #nearest = null;

  /**
   * @param {number} index
   * @param {number} methodIndex
   */
  #findNeighbours(index, methodIndex) {
    const { x, y, neighbours, sample, compares } = this.methods[methodIndex];
    // What lies beside the shapes of a sample was put there: it says nothing of who is near.
    const among = (compares && sample) ?? null;
    // The nearest so far, nearest first: few, where a sort would go over all shapes.
    /** @type {{ other: number, distance: number }[]} */
    const found = [];
    const { length } = among ?? x;
    for (let number = 0; number < length; number += 1) {
      const other = among === null ? number : among[number];
      const distance = (x[other] - x[index]) ** 2 + (y[other] - y[index]) ** 2;
      if (other === index || !Number.isFinite(distance)) continue;
      if (found.length === neighbours && distance >= found[neighbours - 1].distance) continue;
      let place = found.length;
      while (place > 0 && found[place - 1].distance > distance) place -= 1;
      found.splice(place, 0, { other, distance });
      if (found.length > neighbours) found.pop();
    }
    return found.map(({ other }) => other);
  }

  /**
   * Classes among some shapes with their counts, most frequent first.
   * @param {Iterable<number>} indices
   */
  census(indices) {
    /** @type {Map<number, number>} */
    const counts = new Map();
    for (const index of indices) counts.set(this.groups[index], (counts.get(this.groups[index]) ?? 0) + 1);
    return [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0]);
  }

  /** One row a shape, as the map charts want them. */
  rows() {
    return Array.from({ length: this.count }, (_, index) => ({
      index,
      group: this.groups[index],
      x: this.methods.map((method) => method.x[index]),
      y: this.methods.map((method) => method.y[index]),
      hit: this.methods.map((method) => reachOf(this, method, index)),
      picture: this.pictures.at(index),
    }));
  }
}

/**
 * A map as chunks hold it.
 * @param {Chunk.Method} method
 * @returns {ShapeMap}
 */
export function mapOf({ hit, faith, ...method }) {
  return { ...method, hit: sharesOf(hit), faith: faith && { ...faith, kept: sharesOf(faith.kept) } };
}

/**
 * Take what is known of the neighbours of each shape to the rest that is known of a map.
 * @param {Faith} faith
 * @param {Chunk.Trust} trust
 */
export function tell(faith, trust) {
  faith.false = trust.false && sharesOf(trust.false);
  faith.missing = trust.missing && sharesOf(trust.missing);
}

/**
 * The rectangle a projection fills; never empty, so that a single shape has a map too. A shape without a place on it
 * has coordinates that are no numbers.
 * @param {{ x: ArrayLike<number>, y: ArrayLike<number> }} map
 * @returns {Bounds}
 */
export function bounds({ x, y }) {
  let [left, right, bottom, top] = [Infinity, -Infinity, Infinity, -Infinity];
  // Without arrays, and with comparisons that numbers that are none never pass: it goes over all shapes of a map that moves.
  for (let index = 0; index < x.length; index += 1) {
    if (x[index] < left) left = x[index];
    if (x[index] > right) right = x[index];
    if (y[index] < bottom) bottom = y[index];
    if (y[index] > top) top = y[index];
  }
  if (left > right) return { x: 0, y: 0, width: 0.5, height: 0.5 };
  return {
    x: (left + right) / 2,
    y: (bottom + top) / 2,
    width: Math.max(right - left, 0.5),
    height: Math.max(top - bottom, 0.5),
  };
}
