// Colours of a model's vertices, in linear light: those of its file or clay, the values of a descriptor, what falls
// into one bin, and where a difference lies.

/** @import { Model } from "./model.js" */

/** How much light the darkest tone sends back of what the marked colour does. */
const DARK = 0.3;

/** What black and white send back, as in `render/shading.py`. */
const [DARKEST, BRIGHTEST] = [0.03, 0.72];

export class Paint {
  /** @param {Pick<Chunk.Selection, "ramp" | "clay" | "marked">} selection */
  constructor({ ramp, clay, marked }) {
    this.ramp = ramp.map(linear);
    this.clay = clay;
    this.marked = marked;
  }

  /**
   * The colours of its file; clay where it has none, or where they are not wanted.
   * @param {Model} solid
   * @param {{ clay?: boolean }} [options]
   */
  plain(solid, { clay = false } = {}) {
    return this.#fill(solid, (vertex) => (clay ? null : reflected(solid.color(vertex))) ?? this.clay);
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
   * From clay for nothing to the darkest for densities that are `strongest` or more.
   * @param {Model} solid
   * @param {Float64Array} densities one a vertex
   * @param {number} strongest
   */
  density(solid, densities, strongest) {
    return this.#fill(solid, (vertex) => this.#between(strongest > 0 ? Math.min(densities[vertex] / strongest, 1) : 0));
  }

  /**
   * From clay through the colour of what is marked to a dark tone of it: two steps tell more densities apart than one.
   * @param {number} part
   */
  #between(part) {
    const dark = this.marked.map((value) => DARK * value);
    const [from, to] = part < 0.5 ? [this.clay, this.marked] : [this.marked, dark];
    const along = part < 0.5 ? 2 * part : 2 * part - 1;
    return from.map((value, channel) => value + along * (to[channel] - value));
  }

  /**
   * Those colours from none to the strongest, for a legend: codes as style sheets have them.
   * @param {number} steps
   */
  scale(steps) {
    return Array.from({ length: steps }, (_, step) => code(this.#between(step / (steps - 1))));
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
  return [1, 3, 5].map((at) => light(Number.parseInt(code.slice(at, at + 2), 16)));
}

/** @param {number} step of a channel, from 0 to 255 */
function light(step) {
  const value = step / 255;
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

/**
 * As in pictures: black and white things send back some light, and not all.
 * @param {number[] | null} color
 */
function reflected(color) {
  return color?.map((step) => DARKEST + (BRIGHTEST - DARKEST) * light(step));
}

/** @param {number[]} color */
function code(color) {
  const channels = color.map((value) => (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
  return `rgb(${channels.map((value) => Math.round(255 * Math.min(value, 1))).join(" ")})`;
}
