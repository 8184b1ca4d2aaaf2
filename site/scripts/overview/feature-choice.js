// What the map of the Overview is made from: all features, or the bins that the site was made for; the best subset of the
// features; or one chosen on the Features page.

import { chunk } from "../base/chunks.js";
import { entry } from "../base/entry.js";
import { mapOf, tell } from "../database/database.js";
import { Subsets } from "../database/subsets.js";
import { withOthers } from "./placed-map.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database, ShapeMap } from "../database/database.js" */

const ALL = "all";
const BEST = "best";
const CHOSEN = "chosen";

export class FeatureChoice {
  /** @type {string[] | null} */
  #chosen = null;
  /** What was asked for last; null once the map is another, whoever changed it. */
  /** @type {string | null} */
  #asked = null;

  /**
   * @param {Database} database
   * @param {OverviewState} state
   */
  constructor(database, state) {
    this.database = database;
    this.state = state;
    this.searched = /** @type {Chunk.SubsetChoice} */ (database.data.subsets);
    this.base = database.methods.findIndex(({ key }) => key === this.searched.method);
    this.node = document.getElementById("features");
    this.node.addEventListener("change", (event) => this.#choose(event.target.value));
    state.listen((changed) => {
      if (changed.has("method")) {
        this.#asked = null;
        this.show();
      }
    });
    this.show();
  }

  /** @param {string} value */
  async #choose(value) {
    this.#asked = value;
    if (value === ALL) this.state.set({ method: this.base });
    else {
      const names = (value === BEST ? this.searched.best : this.#chosen) ?? [];
      const method = await subsetMethod(this.database, names);
      // Its map may have taken seconds, in which the reader chose another.
      if (method !== null && this.#asked === value) this.state.set({ method });
    }
  }

  show() {
    const index = this.state.get("method");
    const { base, features } = this.database.methods[index];
    this.node.hidden = features.length === 0; // of a map that was brought along, which is of no features
    const best = base !== index && same(features, this.searched.best);
    if (base !== index && !best) this.#chosen = features;
    const value = base === index ? ALL : best ? BEST : CHOSEN;
    for (const input of this.node.querySelectorAll("input")) input.checked = input.value === value;
    const chosen = this.#chosen;
    if (chosen === null) return;
    const label = /** @type {Found} */ (this.node.querySelector(`[value=${CHOSEN}]`).closest("label"));
    label.hidden = false;
    label.title = chosen.join(", ");
    label.querySelector("bdi").textContent = chosen.join(" ");
  }
}

/**
 * What the address says, with the map of its features loaded.
 * @param {Database} database
 * @param {Record<string, any>} found
 */
export async function addressedMap(database, { features, ...values }) {
  const method = features.length > 0 ? await subsetMethod(database, features) : null;
  return method === null ? values : { ...values, method };
}

/** @type {Map<string, Promise<number | null>>} by the names of their features */
const known = new Map();

/**
 * The index of a subset's map in the database, where it is added when first asked for; null if it was not evaluated.
 * @param {Database} database
 * @param {string[]} names
 */
function subsetMethod(database, names) {
  return entry(known, names.join("\n"), () => addSubset(database, names));
}

/**
 * @param {Database} database
 * @param {string[]} names
 */
async function addSubset(database, names) {
  const { method, features, bins, best, laidOut } = /** @type {Chunk.SubsetChoice} */ (database.data.subsets);
  const base = database.methods.findIndex(({ key }) => key === method);
  if (bins === null && names.length === features.length) return base;
  if (laidOut && same(names, best)) return database.add(await bestMap(), base);
  const subsets = new Subsets(await chunk("search"));
  const place = subsets.find(names);
  if (place === undefined) return null;
  const map = await subsets.map(place, database);
  const { rows } = subsets.data;
  return database.add(rows === null ? map : await withOthers(database, map, rows), base);
}

/** @returns {Promise<ShapeMap>} */
async function bestMap() {
  const { trust, ...method } = await chunk("best");
  const map = mapOf(method);
  if (map.faith) tell(map.faith, trust);
  return map;
}

/**
 * @param {string[]} one
 * @param {string[] | null} other
 */
function same(one, other) {
  return other !== null && one.join("\n") === other.join("\n");
}
