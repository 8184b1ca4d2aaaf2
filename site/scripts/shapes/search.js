// The search of the gallery.

import { findWords, searchTexts } from "../database/search.js";

/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Database } from "../database/database.js" */

/**
 * The shapes that the words of the search find; null without words.
 * @param {Database} database
 * @param {GalleryState} state
 */
export async function search(database, state) {
  const query = state.get("query");
  if (query === "") {
    state.set({ matches: null });
    return;
  }
  const known = await searchTexts(database);
  if (state.get("query") === query) state.set({ matches: new Set(findWords(known, query)) });
}

/** @param {GalleryState} state */
export function watchSearch(state) {
  const field = document.getElementById("search");
  const show = () => {
    if (field.value.trim() !== state.get("query")) field.value = state.get("query");
  };
  field.addEventListener("input", () => state.set({ query: field.value.trim() }));
  state.listen((changed) => {
    if (changed.has("query")) show();
  });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    if (event.key === "Escape") takeBack(state);
    else if (event.key === "/" && !event.target.matches("input[type=search]")) {
      field.focus();
      event.preventDefault();
    }
  });
  show();
}

/**
 * One press takes back the last thing: the search, then the selection.
 * @param {GalleryState} state
 */
function takeBack(state) {
  if (state.get("query") !== "") state.set({ query: "" });
  else state.set({ selection: new Set() });
}
