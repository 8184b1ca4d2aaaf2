// What similar means on this page: which features are compared, or which bins. The address has it as text.

import { readShortNames, shortNames } from "../addresses/bin-names.js";
import { joinNames, splitNames } from "../addresses/names.js";
import { count } from "../base/words.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Choice } from "../database/similarity.js" */

/** @typedef {{ key: string, columns: number[], words: string, title?: string }} BinSet bins to choose at once */

export class Comparison {
  /**
   * @param {Chunk.Workbench} data
   * @param {number[] | null} selected the bins of the site's own search
   * @param {boolean} related whether the site knows which shapes have the same neighbours
   * @param {ShapeState} state
   */
  constructor(data, selected, related, state) {
    this.data = data;
    this.related = related;
    this.state = state;
    this.names = data.features.map(({ name }) => name);
    /** @type {(BinSet | null)[]} */
    const sets = [
      data.bins && { key: "maps", columns: data.bins, words: `The ${count(data.bins.length, "bin")} of the maps` },
      selected && {
        key: "selected",
        columns: selected,
        words: count(selected.length, "selected bin"),
        title: "The bins that the Bins page found to keep all groups apart",
      },
    ];
    this.sets = sets.filter((set) => set !== null);
  }

  /**
   * What distances are of; of all features too where these only order what a neighbourhood has found.
   * @returns {Choice}
   */
  get choice() {
    const { data, names, state } = this;
    if (this.byNeighbourhood) return { features: [...names.keys()] };
    const columns = [...readShortNames(state.get("bins"), data.features)].sort((a, b) => a - b);
    if (columns.length > 0) return { columns };
    const features = splitNames(state.get("features"), names).map((/** @type {string} */ name) => names.indexOf(name));
    if (features.length > 0) return { features };
    return data.bins ? { columns: data.bins } : { features: [...names.keys()] };
  }

  /** Whether shapes are similar that have the same neighbours. */
  get byNeighbourhood() {
    return this.related && this.state.get("neighbourhood");
  }

  /** Whether all features are compared, by their plain distances. */
  get everything() {
    return !this.byNeighbourhood && this.choice.features?.length === this.names.length;
  }

  compareAll() {
    this.#compare(this.data.bins ? joinNames(this.names) : "", "");
  }

  compareByNeighbourhood() {
    this.state.set({ features: "", bins: "", neighbourhood: true });
  }

  /**
   * Add a feature to those that are compared, or leave it out; from all features or from bins, to this one alone.
   * @param {number} feature
   */
  toggle(feature) {
    const { features } = this.choice;
    const kept =
      features === undefined || this.everything || this.byNeighbourhood
        ? [feature]
        : features.includes(feature)
          ? features.filter((other) => other !== feature)
          : [...features, feature];
    if (kept.length === 0 || kept.length === this.names.length) this.compareAll();
    else this.#compare(joinNames(this.names.filter((_, other) => kept.includes(other))), "");
  }

  /** @param {number[]} columns */
  compareBins(columns) {
    const [text, ofMaps] = [columns, this.data.bins ?? []].map((chosen) => shortNames(chosen, this.data.features));
    this.#compare("", text === ofMaps ? "" : text);
  }

  /**
   * @param {string} features
   * @param {string} bins
   */
  #compare(features, bins) {
    this.state.set({ features, bins, neighbourhood: false });
  }
}
