// Colours of a model's vertices, in linear light: plain clay, the values of a descriptor, what falls into one bin.

/** @import { Model } from "./model.js" */

export class Paint {
  /** @param {Pick<Chunk.Selection, "ramp" | "clay" | "marked">} selection */
  constructor({ ramp, clay, marked }) {
    this.ramp = ramp.map(linear);
    this.clay = clay;
    this.marked = marked;
  }

  /** @param {Model} solid */
  plain(solid) {
    return this.#fill(solid, () => this.clay);
  }

  /**
   * The bins of one dimension of the descriptors, from low to high values.
   * @param {Model} solid
   * @param {number} dimension
   */
  values(solid, dimension) {
    const bins = solid.bins(dimension);
    return this.#fill(solid, (vertex) => this.ramp[bins[vertex]]);
  }

  /**
   * What falls into bin `place`, from 0, of a dimension.
   * @param {Model} solid
   * @param {number} dimension
   * @param {number} place
   */
  inside(solid, dimension, place) {
    const bins = solid.bins(dimension);
    return this.#fill(solid, (vertex) => (bins[vertex] === place ? this.marked : this.clay));
  }

  /**
   * @param {Model} solid
   * @param {(vertex: number) => number[]} colorOf
   */
  #fill({ vertexCount }, colorOf) {
    const colors = new Float32Array(3 * vertexCount);
    for (let vertex = 0; vertex < vertexCount; vertex += 1) colors.set(colorOf(vertex), 3 * vertex);
    return colors;
  }
}

/** @param {string} code */
function linear(code) {
  return [1, 3, 5].map((at) => {
    const value = Number.parseInt(code.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
}
