// The state of the Features page in its address: the chosen subset, the greedy path, and the colours of the map.

import { Address, choice, named } from "../base/address.js";
import { CAMERA } from "./camera.js";
import { namedElsewhere } from "./classes.js";
import { coloredBy } from "./colors.js";
import { LINES } from "./lines.js";
import { joinNames, splitNames } from "./names.js";
import { selected } from "./selected.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Subsets } from "../database/subsets.js" */
/** @import { MapValues } from "../map/scene.js" */

/**
 * What the Features page has in its state, beside what its map has.
 * @typedef {object} FeaturesValues
 * @property {number} chosen place of a subset
 * @property {number | null} pointedPlace
 * @property {number | null} s of the greedy path
 * @property {string | null} rank the measure that subsets are ranked by
 * @property {import("../database/subsets.js").Among} among which subsets are ranked
 * @property {string} color what it says: `class`, `hit`, or the key of a field or a bin
 * @property {number | null} method the map, once it is there
 * @property {import("../map/scene.js").Camera | null} camera
 * @property {number | null} opened
 * @property {number | null} pointedGroup
 * @property {"move" | "select"} drag
 *
 * @typedef {State<FeaturesValues & Shared & Pick<MapValues, "coloring" | "lines" | "alike">>} FeaturesState
 */

/**
 * @param {Subsets} subsets
 * @param {Database} database
 */
export function featuresAddress(subsets, database) {
  const everyone = subsets.labelled ? 0 : subsets.everything;
  const known = [...subsets.features, ...database.data.methods.flatMap(({ features }) => features)];
  const sizes = subsets.data.greedy.map(({ s }) => s);
  return new Address([
    {
      name: "chosen",
      words: "the features",
      keys: /^features$/,
      standard: everyone,
      read: (query, miss) => subsets.find(splitNames(query.get("features"), subsets.features, miss, known)),
      write: (query, chosen) => query.set("features", joinNames(subsets.names(chosen))),
      place: true,
      often: true,
    },
    {
      name: "s",
      key: "s",
      kind: {
        read(/** @type {string[]} */ [word], /** @type {Miss} */ miss) {
          if (word === "none") return null;
          const size = sizes.find((s) => s === Number(word));
          if (size === undefined && word) miss("setting", word);
          return size;
        },
        write: (/** @type {number | null} */ s) => [String(s ?? "none")],
      },
      standard: sizes[0] ?? null,
    },
    {
      name: "rank",
      key: "rank",
      kind: choice(
        subsets.measures.map(({ name }) => name),
        "measure",
      ),
      standard: subsets.measures[0]?.name ?? null,
      words: "what subsets are ranked by",
    },
    {
      name: "among",
      key: "among",
      kind: choice(subsets.data.paper ? ["all", "paper"] : ["all"], "setting"),
      standard: "all",
      place: true,
      words: "which subsets are ranked",
    },
    coloredBy(database),
    selected(database),
    namedElsewhere(database),
    {
      name: "opened",
      key: "open",
      kind: named(database.ids, "shape"),
      standard: null,
      place: true,
      words: "the marked shape",
    },
    LINES,
    CAMERA,
  ]);
}
