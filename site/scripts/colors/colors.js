// What the reader colours a map by, on every page with one: any field of the database, a neighbourhood hit, or a bin; and
// what its colours are.

import { missField } from "../addresses/fields.js";
import { chunk, chunks } from "../base/chunks.js";
import { Finder } from "../base/finder.js";
import { binName } from "../bins-kit/bin-name.js";
import { Fields } from "../database/fields.js";
import { loadAllBins } from "../database/level-bins.js";
import { binColoring, fieldColoring, trustColoring } from "../map/coloring.js";
import { showLegend } from "./legend.js";

/** @import { Miss } from "../base/missing.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Trust } from "../map/coloring.js" */
/** @import { MapValues } from "../map/scene.js" */
/** @import { Shared } from "../database/selection.js" */

const BIN = "bin:";
const TRUST = "map:";

function choice() {
  return document.getElementById("color-by");
}

/** The keys of the fields that a page offers. */
function offered() {
  /** @type {string[]} */
  const keys = Array.from(choice().options, ({ value }) => value);
  return keys.filter((key) => key !== BIN);
}

/** What maps are coloured by where nobody has said it. */
export function firstKey() {
  return offered()[0];
}

/**
 * Whether there is such a field or bin to colour by: an address may name what is not there.
 * @param {string} key
 * @param {Database} database
 * @param {Miss} miss
 */
export async function isKnown(key, database, miss) {
  if (offered().includes(key)) return true;
  if (key.startsWith(BIN)) {
    const name = key.slice(BIN.length);
    if ((await loadAllBins()).names.includes(name)) return true;
    miss("bin", name);
  } else if (!key.startsWith(TRUST)) missField(key, database, await loadFields(database), miss);
  return false;
}

/** @param {Database} database */
async function loadFields(database) {
  return new Fields(database, ...(await chunks("fields", "hierarchy")));
}

export class Colors {
  /** @type {Promise<Fields> | null} */
  #fields = null;
  /** @type {Finder<number> | null} */
  #finder = null;

  /**
   * @param {Database} database
   * @param {State<MapValues & Shared>} state
   * @param {object} ways
   * @param {() => string | null} ways.key of the field or the bin that is asked for; null where the map tells something else
   * @param {(key: string) => void} ways.choose
   */
  constructor(database, state, { key, choose }) {
    this.database = database;
    this.state = state;
    this.key = key;
    this.choose = choose;
    this.choice = choice();
    this.node = document.getElementById("color-choice");
    this.finder = /** @type {Found} */ (document.querySelector("[data-finder=color]"));
    this.field = document.getElementById("color-search");
    this.choice.addEventListener("change", () => this.#change());
  }

  async #change() {
    if (this.choice.value !== BIN) {
      this.choose(this.choice.value);
      return;
    }
    // To begin with, the first of those that keep the classes apart best, where a build found some.
    const { found } = await chunk("workbench");
    const bins = await loadAllBins();
    this.choose(BIN + bins.names[found?.bins[0] ?? 0]);
    await this.make();
    this.field.focus();
    this.field.select();
  }

  /** Make what is asked for; the answer is whether it is still asked for. */
  async make() {
    const key = this.key();
    const bin = key?.startsWith(BIN) ?? false;
    const coloring = key === null ? null : await this.#of(key);
    if (key !== this.key()) return false;
    if (key !== null) this.choice.value = bin ? BIN : key;
    this.node.hidden = key === null;
    this.finder.hidden = !bin;
    showLegend(coloring, this.state);
    this.state.set({ coloring });
    return true;
  }

  /** @param {string} key */
  #of(key) {
    if (key.startsWith(BIN)) return this.#ofBin(key.slice(BIN.length));
    return key.startsWith(TRUST) ? this.#ofMap(key.slice(TRUST.length)) : this.#ofField(key);
  }

  /**
   * What is known of the map in view only.
   * @param {string} kind
   */
  async #ofMap(kind) {
    const { database, state } = this;
    const current = () => database.methods[state.get("method") ?? 0];
    await current().know?.();
    return trustColoring(database, /** @type {Trust} */ (kind), current);
  }

  /** @param {string} name */
  async #ofBin(name) {
    const bins = await loadAllBins();
    this.#finder ??= new Finder("color-search", "color-found", {
      find: (text) => bins.find(text),
      prepare: () => bins.prepareToFind(),
      none: () => bins.searchHint,
      label: (column) => binName(bins, column),
      choose: (column) => this.choose(BIN + bins.names[column]),
    });
    this.field.value = name;
    const column = bins.names.indexOf(name);
    return column < 0 ? null : binColoring(this.database, bins, column, await bins.shares(column));
  }

  /** @param {string} key */
  async #ofField(key) {
    this.#fields ??= loadFields(this.database);
    const field = (await this.#fields).byKey.get(key);
    return field ? fieldColoring(this.database, field) : null;
  }
}
