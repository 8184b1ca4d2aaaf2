// Subsets of the features, from best to worst: what each of them reaches, and its map.

import { chunk } from "../base/chunks.js";

/** @import { Faith, ShapeMap } from "./database.js" */

export class Subsets {
  /** @param {Chunk.Search} data */
  constructor(data) {
    this.data = data;
    this.features = data.features;
    this.count = data.members.length;
    this.labelled = data.hit[0] !== null;
    this.places = new Map(data.members.map((code, place) => [code, place]));
    this.everything = /** @type {number} */ (this.find(this.features));
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
   * The map of a subset, as the Database has projections; classes are numbered as there.
   * @param {number} place
   * @param {number} classCount
   * @returns {Promise<ShapeMap & Pick<Chunk.Method, "note" | "features">>}
   */
  async map(place, classCount) {
    const maps = await chunk("subsets");
    const { data } = this;
    const hitOfClass = new Array(classCount).fill(null);
    for (const [column, group] of data.classes.entries()) hitOfClass[group] = data.hitOfClass[place][column];
    const features = this.names(place);
    const faith = this.faith(place);
    return {
      key: `${data.method}:${features.join("+")}`,
      title: data.methodTitle,
      note: data.note,
      features,
      x: maps.x[place].map((step) => step / maps.steps),
      y: maps.y[place].map((step) => step / maps.steps),
      hit: maps.hit[place].map((step) => (step < 0 ? null : step / maps.hitSteps)),
      neighbours: data.neighbours,
      hitOfClass,
      hitOfAll: data.hit[place],
      chance: data.chance,
      chanceSpread: null,
      faith,
      async know() {
        if (!faith || faith.kept) return;
        const { steps, ...shares } = await chunk("faith");
        for (const kind of /** @type {const} */ (["kept", "false", "missing"]))
          faith[kind] = shares[kind]?.[place].map((step) => step / steps) ?? null;
      },
    };
  }
}
