// Subsets of the features, from best to worst: what each of them reaches, and its map.

import { chunk } from "../base/chunks.js";
import { sharesOf } from "./shares.js";

/** @import { Database, Faith, ShapeMap } from "./database.js" */

/**
 * What each subset's map reaches by a measure, and what it is at random where that is the same for all.
 * @typedef {object} SubsetMeasure
 * @property {"nh" | "kept" | "trustworthiness" | "continuity" | "stress"} name
 * @property {(number | null)[] | null} values by place
 * @property {number | null} chance
 * @property {boolean} low whether lower is better
 */

/** @typedef {"all" | "paper"} Among which subsets: all that were searched, or those of the paper's features alone */

export class Subsets {
  /** @param {Chunk.Search} data */
  constructor(data) {
    this.data = data;
    this.features = data.features;
    this.count = data.members.length;
    this.labelled = data.hit[0] !== null;
    this.places = new Map(data.members.map((code, place) => [code, place]));
    this.everything = /** @type {number} */ (this.find(this.features));
    this.measures = this.#measures();
  }

  /** What subsets can be ranked by, that of the labels first; places stand in its order. */
  #measures() {
    const { hit, chance, faith } = this.data;
    /** @type {SubsetMeasure[]} */
    const all = [
      { name: "nh", values: this.labelled ? hit : null, chance, low: false },
      ...(faith
        ? /** @type {SubsetMeasure[]} */ ([
            // Of all others any map keeps all.
            { name: "kept", values: faith.chance === 1 ? null : faith.mean, chance: faith.chance, low: false },
            { name: "trustworthiness", values: faith.trustworthiness, chance: faith.random, low: false },
            { name: "continuity", values: faith.continuity, chance: faith.random, low: false },
            { name: "stress", values: faith.stress, chance: null, low: true },
          ])
        : []),
    ];
    return all.filter(({ values }) => values?.some((value) => value !== null));
  }

  /**
   * The places from the best to the worst by a measure; as they are where there is none.
   * @param {SubsetMeasure | undefined} measure
   * @param {Among} among
   */
  ranked(measure, among) {
    const places = Array.from({ length: this.count }, (_, place) => place).filter((place) =>
      this.isAmong(place, among),
    );
    if (measure === undefined || measure.name === "nh") return places;
    const sign = measure.low ? 1 : -1;
    /** @param {number} place */
    const worth = (place) => sign * (measure.values?.[place] ?? sign * Infinity);
    return places.sort((one, other) => worth(one) - worth(other) || one - other);
  }

  /**
   * @param {number} place
   * @param {Among} among
   */
  isAmong(place, among) {
    return this.features.every((_, feature) => this.isOf(feature, among) || !this.has(place, feature));
  }

  /**
   * Whether a feature may be of such subsets.
   * @param {number} feature
   * @param {Among} among
   */
  isOf(feature, among) {
    return among === "all" || this.data.paper === null || this.data.paper.includes(feature);
  }

  /**
   * The place of all features of such subsets.
   * @param {Among} among
   */
  whole(among) {
    return /** @type {number} */ (this.find(this.features.filter((_, feature) => this.isOf(feature, among))));
  }

  /**
   * The spread of NH_c over subsets, a box a class.
   * @param {Among} among
   */
  boxes(among) {
    return (among === "paper" && this.data.boxesOfPaper) || this.data.boxes;
  }

  /**
   * The place of a subset given by the names of its features; undefined if it was not evaluated.
   * @param {readonly string[]} names
   */
  find(names) {
    return this.places.get(this.features.map((name) => (names.includes(name) ? "1" : "0")).join(""));
  }

  /**
   * @param {number} place
   * @param {number} feature
   */
  has(place, feature) {
    return this.data.members[place][feature] === "1";
  }

  /** @param {number} place */
  names(place) {
    return this.features.filter((_, feature) => this.has(place, feature));
  }

  /**
   * The place of the subset that has one feature more, or one less.
   * @param {number} place
   * @param {number} feature
   */
  toggled(place, feature) {
    const names = this.features.filter((_, other) => this.has(place, other) !== (other === feature));
    return this.find(names);
  }

  /**
   * The only feature of a subset, or -1.
   * @param {number} place
   */
  single(place) {
    const code = this.data.members[place];
    return code.indexOf("1") === code.lastIndexOf("1") ? code.indexOf("1") : -1;
  }

  /**
   * How far the map of a subset shows who is like whom.
   * @param {number} place
   * @returns {Faith | null}
   */
  faith(place) {
    const { faith } = this.data;
    if (faith === null) return null;
    return {
      mean: /** @type {number} */ (faith.mean[place]),
      chance: faith.chance,
      trustworthiness: faith.trustworthiness?.[place] ?? null,
      continuity: faith.continuity?.[place] ?? null,
      random: faith.random,
      stress: faith.stress[place],
      randomStress: faith.randomStress[place],
    };
  }

  /**
   * The map of a subset, as the Database has projections; classes are numbered as there. Shapes that the search left out have
   * no place on it.
   * @param {number} place
   * @param {Database} database
   * @returns {Promise<ShapeMap & Pick<Chunk.Method, "note" | "features">>}
   */
  async map(place, { count, classes }) {
    const maps = await chunk("subsets");
    const { data } = this;
    const { rows } = data;
    const hitOfClass = new Array(classes.length).fill(null);
    for (const [column, group] of data.classes.entries()) hitOfClass[group] = data.hitOfClass[place][column];
    const features = this.names(place);
    const faith = this.faith(place);
    /**
     * @template Value
     * @param {ArrayLike<Value>} values
     * @param {Value} none
     * @returns {ArrayLike<Value>}
     */
    const ofAll = (values, none) => {
      if (rows === null) return values;
      const all = new Array(count).fill(none);
      for (const [index, row] of rows.entries()) all[row] = values[index];
      return all;
    };
    /** @param {ArrayLike<number>} steps */
    const placed = (steps) => Float64Array.from(ofAll(steps, NaN), (step) => step / maps.steps);
    /** @param {Uint16Array} steps */
    const shares = (steps) => /** @type {(number | null)[]} */ (ofAll(sharesOf(steps), null));
    return {
      key: `${data.method}:${features.join("+")}`,
      title: data.methodTitle,
      note: data.note,
      features,
      x: placed(maps.x[place]),
      y: placed(maps.y[place]),
      hit: shares(maps.hit[place]),
      neighbours: data.neighbours,
      hitOfClass,
      hitOfAll: data.hit[place],
      chance: data.chance,
      chanceSpread: null,
      faith,
      async know() {
        if (!faith || faith.kept) return;
        const known = await chunk("faith");
        for (const kind of /** @type {const} */ (["kept", "false", "missing"])) {
          const steps = known[kind];
          faith[kind] = steps && shares(steps[place]);
        }
      },
    };
  }
}
