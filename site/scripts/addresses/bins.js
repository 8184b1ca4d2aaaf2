// What the Bins page shows, in its address.

import { Address, choice, named } from "../base/address.js";
import { pageAddress } from "../base/place.js";
import { shortNames } from "./bin-names.js";
import { namedElsewhere, classNoun } from "./classes.js";
import { selected } from "./selected.js";

/** @import { Kind, Ways } from "../base/address.js" */
/** @import { State } from "../base/state.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */

/**
 * What the Bins page has in its state.
 * @typedef {object} BinsValues
 * @property {string} size of sets: "fewest", or how many bins
 * @property {number} step
 * @property {number} bin
 * @property {number | null} group the class that the bin separates
 * @property {number | "most" | "least" | null} shape
 * @property {"value" | "inside"} reading
 *
 * @typedef {State<BinsValues & Shared>} BinsState
 */

const SIZES = ["fewest", "1", "2", "3"];
const READINGS = ["value", "inside"];
const ENDS = ["most", "least"];

/**
 * `first` is the bin that is looked at unless the address names one, and the class that it is to separate.
 * @param {Database} database
 * @param {Bins} bins
 * @param {Chunk.Selection} selection
 * @param {{ bin: number, group: number | null }} first
 */
export function binsAddress(database, bins, selection, first) {
  const last = Math.max(selection.path.length - 1, 0);
  return new Address([
    { name: "size", key: "size", kind: choice(SIZES, "setting"), standard: SIZES[0], place: true },
    { name: "step", key: "step", kind: step(last), standard: last, place: true, often: true, words: "the step" },
    { names: ["bin", "group"], ...binOfClass(database, bins), standard: first, place: true, words: "the bin" },
    { name: "shape", ...shapeOrEnd(database), standard: null },
    { name: "reading", key: "reading", kind: choice(READINGS, "setting"), standard: READINGS[0] },
    selected(database),
    namedElsewhere(database),
  ]);
}

/**
 * Where the Workbench shows the map of some bins.
 * @param {number[]} columns
 * @param {Chunk.Feature[]} features
 */
export function workbenchAddress(columns, features) {
  return pageAddress("workbench.html", { bins: shortNames(columns, features), map: "tsne" });
}

/**
 * A step of the path, from 0; readers count from 1.
 * @param {number} last
 * @returns {Kind}
 */
function step(last) {
  /** @type {Kind["read"]} */
  const read = ([word], miss) => {
    const place = Number(word) - 1;
    if (Number.isInteger(place) && place >= 0 && place <= last) return place;
    if (word) miss("step", word);
    return undefined;
  };
  return { read, write: (place) => [String(place + 1)] };
}

/**
 * @param {Database} database
 * @param {Bins} bins
 * @returns {Ways}
 */
function binOfClass(database, bins) {
  const [ofBin, ofClass] = [named(bins.names, "bin"), named(database.classes, classNoun(database))];
  return {
    keys: /^(bin|of)$/,
    read(query, miss) {
      const bin = ofBin.read(query.getAll("bin"), miss);
      const group = ofClass.read(query.getAll("of"), miss) ?? null;
      return bin === undefined ? undefined : { bin, group };
    },
    write(query, { bin, group }) {
      query.set("bin", bins.names[bin]);
      if (group !== null) query.set("of", database.classes[group]);
    },
  };
}

/**
 * A shape, or the one with the most or the least of the bin.
 * @param {Database} database
 * @returns {Ways}
 */
function shapeOrEnd(database) {
  const ofId = named(database.ids, "shape");
  return {
    keys: /^(shape|id)$/,
    read(query, miss) {
      const end = query.get("shape");
      if (end !== null && ENDS.includes(end)) return end;
      if (end) miss("setting", end);
      return ofId.read(query.getAll("id"), miss);
    },
    write(query, shape) {
      if (ENDS.includes(shape)) query.set("shape", shape);
      else query.set("id", database.ids.at(shape));
    },
  };
}
