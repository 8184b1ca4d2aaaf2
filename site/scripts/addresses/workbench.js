// The work in the address: a link, and a reload, bring back the same maps and the same figures.

import { Address, choice } from "../base/address.js";
import { readShortNames, shortNames } from "./bin-names.js";
import { classesNamed } from "./classes.js";
import { coloredBy } from "./colors.js";
import { LINES } from "./lines.js";
import { missMap, PROJECTIONS } from "./maps.js";
import { joinNames, splitNames } from "./names.js";
import { selected } from "./selected.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { Kind, Ways } from "../base/address.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database, Faith, ShapeMap } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { MapValues } from "../map/scene.js" */
/** @import { Standing } from "../engine/inquiry.js" */

/**
 * What the Workbench has in its state: what is in use, what is asked, and what is known.
 * @typedef {object} WorkValues
 * @property {Set<number>} hidden classes that are not in use
 * @property {Set<number>} features
 * @property {Set<number>} bins chosen columns
 * @property {string} projection
 * @property {string} scorer
 * @property {{ from: Set<number> | null, against: Set<number> | null, each: boolean }} separation
 * @property {string} color what it says: `class`, `hit`, or the key of a field or a bin
 * @property {any} step of the history
 * @property {ShapeMap | null} originalMap
 * @property {ShapeMap | null} refinedMap
 * @property {Standing} originalStatus
 * @property {number} originalProgress
 * @property {Standing} refinedStatus
 * @property {number} refinedProgress
 * @property {Faith | null} originalFaith how far the maps show who is like whom, as far as it was asked for
 * @property {Standing} originalFaithStatus
 * @property {number} originalFaithProgress
 * @property {Faith | null} refinedFaith
 * @property {Standing} refinedFaithStatus
 * @property {number} refinedFaithProgress
 * @property {Standing} scoresStatus
 * @property {number} scoresProgress
 * @property {Standing} offerStatus
 * @property {number} offerProgress
 * @property {{ before: number, reached: number, bins: number } | null} refused what was found and not taken: NH of the maps
 *   at hand and of its own, and how many bins it has
 * @property {Float64Array | null} scores
 *
 * @typedef {State<WorkValues & Shared & { opened: number | null, pointedGroup: number | null} & Pick<MapValues, "drag" | "join" | "coloring" | "lines" | "alike">>} WorkState
 */

/** Its best bins make the best maps, on shapes that had no say too (docs/method/scorers.md). */
export const DEFAULT_SCORER = "rfe";

/** All classes in use, each from the rest: what a reader who asks nothing in particular wants to know. */
export const EVERY_CLASS = Object.freeze({ from: null, against: null, each: true });

/**
 * The work is a place, each change of it a step.
 * @param {Database} database
 * @param {Chunk.Workbench} data
 */
export function workAddress(database, data) {
  const method = PROJECTIONS.includes(data.method) ? data.method : PROJECTIONS[0];
  return new Address([
    { name: "hidden", ...classesInUse(database), place: true, words: "the classes" },
    { names: ["features", "bins"], ...binsInUse(data), place: true, words: "features and bins" },
    { name: "projection", key: "map", kind: projection(database), standard: method, place: true, words: "the map" },
    {
      name: "scorer",
      key: "scorer",
      kind: choice(
        data.scorers.map(({ key }) => key),
        "scorer",
      ),
      standard: DEFAULT_SCORER,
      place: true,
      words: "the scorer",
    },
    { name: "separation", ...separation(database), place: true, words: "the question" },
    coloredBy(database),
    selected(database),
    LINES,
  ]);
}

/**
 * Whether a site of chosen bins is made from just these.
 * @param {Set<number>} bins
 * @param {number[] | null} ofSite
 */
export function isSame(bins, ofSite) {
  return ofSite !== null && bins.size === ofSite.length && ofSite.every((column) => bins.has(column));
}

/**
 * A projection that maps are made by here.
 * @param {Database} database
 * @returns {Kind}
 */
function projection(database) {
  const own = choice(PROJECTIONS);
  return {
    read(keys, miss) {
      missMap(keys[0], database, miss);
      return own.read(keys, miss);
    },
    write: own.write,
  };
}

/**
 * The classes that are not in use; named are these or the others, whichever are fewer.
 * @param {Database} database
 * @returns {Ways}
 */
function classesInUse(database) {
  const everyone = [...database.sizes.keys()].sort((a, b) => a - b);
  return {
    keys: /^(hide|hide-unlabelled|class|unlabelled)$/,
    read(query, miss) {
      const named = (/** @type {string} */ key, /** @type {string} */ unlabelled) =>
        new Set([
          ...classesNamed(query.getAll(key), database, miss),
          ...(query.has(unlabelled) && database.labelled && database.sizes.has(-1) ? [-1] : []),
        ]);
      const used = named("class", "unlabelled");
      return used.size > 0 ? new Set(everyone.filter((group) => !used.has(group))) : named("hide", "hide-unlabelled");
    },
    write(query, hidden) {
      const used = everyone.filter((group) => !hidden.has(group));
      const fewer = used.length > 0 && used.length < hidden.size;
      for (const group of fewer ? used : [...hidden].sort((a, b) => a - b)) {
        if (group < 0) query.set(fewer ? "unlabelled" : "hide-unlabelled", "");
        else query.append(fewer ? "class" : "hide", database.classes[group]);
      }
    },
  };
}

/**
 * The features in use, and the chosen ones of their bins; bins of the site where the address names none.
 * @param {Chunk.Workbench} data
 * @returns {Ways}
 */
function binsInUse({ features, bins: ofSite }) {
  const names = features.map(({ name }) => name);
  /** @param {number} column */
  const featureOf = (column) => features.findLastIndex(({ start }) => start <= column);
  return {
    keys: /^(features|bins)$/,
    read(query, miss) {
      const known = splitNames(query.get("features"), names, miss);
      const used = [...features.keys()].filter((index) => known.length === 0 || known.includes(names[index]));
      const chosen = readShortNames(query.get("bins"), features, miss);
      // Nothing says that none is chosen; words of which none is a bin say nothing.
      const bins = chosen.size > 0 || query.get("bins") === "" ? chosen : (ofSite ?? []);
      return {
        features: new Set(used),
        bins: new Set([...bins].filter((column) => used.includes(featureOf(column)))),
      };
    },
    write(query, { features: used, bins }) {
      if (used.size < features.length)
        query.set("features", joinNames([...used].sort((a, b) => a - b).map((index) => names[index])));
      if (!isSame(bins, ofSite ?? [])) query.set("bins", shortNames(bins, features));
    },
  };
}

/**
 * Which classes are to be told apart from which, each for itself or together.
 * @param {Database} database
 * @returns {Ways}
 */
function separation(database) {
  /**
   * @param {URLSearchParams} query
   * @param {string} key
   * @param {Miss} miss
   */
  const read = (query, key, miss) => {
    const named = new Set(classesNamed(query.getAll(key), database, miss));
    return named.size > 0 || query.get(key) === "" ? named : null;
  };
  /**
   * @param {URLSearchParams} query
   * @param {string} key
   * @param {Set<number> | null} groups
   */
  const write = (query, key, groups) => {
    for (const group of groups ?? []) query.append(key, database.classes[group]);
    if (groups?.size === 0) query.set(key, "");
  };
  return {
    keys: /^(separate|from|together)$/,
    read: (query, miss) => ({
      from: read(query, "separate", miss),
      against: read(query, "from", miss),
      each: !query.has("together"),
    }),
    write(query, { from, against, each }) {
      write(query, "separate", from);
      write(query, "from", against);
      if (!each) query.set("together", "");
    },
  };
}
