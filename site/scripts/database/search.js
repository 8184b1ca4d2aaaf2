// Find shapes by name, label or metadata as one types.

import { chunk } from "../base/chunks.js";
import { count } from "../base/words.js";

/** @import { State } from "../base/state.js" */
/** @import { Database } from "./database.js" */

export class Search {
  /**
   * @param {Database} database
   * @param {State} state
   * @param {(text: string) => void} announce
   */
  constructor(database, state, announce) {
    this.database = database;
    this.state = state;
    this.announce = announce;
    /** @type {string[] | null} */
    this.texts = null;
    this.field = document.getElementById("search");
    this.select = document.getElementById("search-select");
    this.field.addEventListener("input", () => state.set({ query: this.field.value.trim() }));
    this.field.addEventListener("keydown", (event) => {
      if (event.key === "Enter") this.#selectAll();
    });
    this.select.addEventListener("click", () => this.#selectAll());
    state.listen((changed) => {
      if (changed.has("query")) this.run();
    });
  }

  async run() {
    const query = this.state.get("query");
    if (this.field.value.trim() !== query) this.field.value = query;
    if (query === "") {
      this.select.hidden = true;
      this.state.set({ matches: null });
      return;
    }
    this.texts ??= await searchTexts(this.database);
    if (this.state.get("query") !== query) return;
    const found = findWords(this.texts, query);
    this.select.hidden = false;
    this.select.disabled = found.length === 0;
    this.select.textContent = found.length === 0 ? "none found" : `Select ${found.length}`;
    this.announce(`${count(found.length, "shape")} found`);
    this.state.set({ matches: new Set(found) });
  }

  #selectAll() {
    const matches = this.state.get("matches");
    if (!matches?.size) return;
    this.state.set({ selection: new Set(matches), query: "" });
  }
}

/**
 * One searchable text a shape: its id, name, labels and metadata.
 * @param {Database} database
 */
export async function searchTexts(database) {
  const { shapes } = await chunk("details");
  return shapes.map(({ labels, metadata }, index) =>
    plain(
      [
        database.ids[index],
        database.names[index],
        ...labels.filter(Boolean),
        ...metadata.map(([, value]) => value),
      ].join("\n"),
    ),
  );
}

/**
 * The numbers of the texts that hold all words of a query, parts of words included.
 * @param {string[]} texts
 * @param {string} query
 */
export function findWords(texts, query) {
  const words = plain(query).split(/\s+/);
  /** @type {number[]} */
  const found = [];
  for (const [index, text] of texts.entries()) if (words.every((word) => text.includes(word))) found.push(index);
  return found;
}

/**
 * Small letters without accents: who types "munze" means "Münze".
 * @param {string} text
 */
function plain(text) {
  return text
    .toLowerCase()
    .normalize("NFD")
    .replace(/[\u0300-\u036f]/g, "");
}
