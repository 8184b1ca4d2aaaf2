// The Shapes page: all shapes as pictures, to search, filter, group, sort, and select.

import { carrySelection, follow } from "../tray/carry.js";
import { chunk } from "../base/chunks.js";
import { readGalleryAddress, writeGalleryAddress } from "../addresses/shapes.js";
import { Arrangement } from "../shapes/arrangement.js";
import { Cells } from "../shapes/cells.js";
import { Chips } from "../shapes/chips.js";
import { Controls } from "../shapes/controls.js";
import { Facets } from "../shapes/facets.js";
import { Fields } from "../database/fields.js";
import { galleryTables } from "../shapes/tables.js";
import { Grid } from "../shapes/grid.js";
import { Keys } from "../shapes/keys.js";
import { Sieve } from "../shapes/sieve.js";
import { watchActions } from "../shapes/actions.js";
import { Panel } from "../shapes/panel.js";
import { Model } from "../database/model.js";
import { pageAddress } from "../base/place.js";
import { findWords, searchTexts } from "../database/search.js";
import { State } from "../base/state.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, watchTheme } from "../base/theme.js";
import { Tray } from "../tray/tray.js";
import { count } from "../base/words.js";

const WRITE_AFTER = 250;
const SAY_AFTER = 500;

async function main() {
  const [overview, described, hierarchy] = await Promise.all(["overview", "fields", "hierarchy"].map(chunk));
  const model = new Model(overview, currentTheme);
  const fields = new Fields(model, described, hierarchy);
  const state = new State({ ...readGalleryAddress(model, fields), matches: null, theme: currentTheme(), opened: null, brushing: false });
  const sieve = new Sieve(model, fields);
  const arrangement = new Arrangement(model, fields);
  const grid = new Grid(model, state);
  const chips = new Chips(fields, sieve, state);
  const facets = new Facets(model, fields, sieve, state);
  const panel = new Panel(sieve, state);
  const showActions = watchActions(model, sieve, grid, state);
  new Controls(model, fields, state);

  let cells = null;
  const arrange = (fromTop) => {
    const how = { group: state.get("group"), sort: state.get("sort"), down: state.get("down") };
    if (cells === null || cells.how !== JSON.stringify([how, state.get("theme")])) {
      cells = new Cells(model, fields, how);
      cells.how = JSON.stringify([how, state.get("theme")]);
    }
    grid.show(arrangement.arrange((row) => sieve.passes(row), how), cells, fromTop);
    grid.mark();
  };
  const sift = () => {
    sieve.sift(state.get("matches"), state.get("only") ? state.get("selection") : null, state.get("filters"));
    chips.show();
    facets.show();
    panel.show();
    showActions();
  };
  const write = () => writeGalleryAddress(model, fields, state);
  const later = delayed(write, WRITE_AFTER);
  const say = delayed(() => {
    document.getElementById("live").textContent = `${count(sieve.size, "shape")} shown`;
  }, SAY_AFTER);

  state.listen((changed) => {
    const has = (...names) => names.some((name) => changed.has(name));
    if (has("query")) search(model, state);
    // Who takes back the last of the selected shapes sees all again.
    if (has("selection") && state.get("only") && state.get("selection").size === 0) state.set({ only: false });
    const taken = has("selection") && state.get("only");
    if (taken || has("matches", "only", "filters")) {
      sift();
      say();
    }
    if (has("matches", "only", "filters", "group", "sort", "down")) arrange(true);
    else if (taken) arrange(false);
    else if (has("theme")) arrange(false);
    else if (has("size", "closed")) grid.rearrange();
    if (has("selection")) grid.mark();
    if (has("query", "only", "filters", "group", "sort", "down", "size", "closed", "selection", "at")) later();
  });
  new Keys(grid, state, {
    leave: (at) => {
      // Whoever comes back finds the shape where it was.
      state.set({ at });
      write();
    },
  });
  const open = (index) => follow(pageAddress("shape.html", { id: model.ids[index] }));
  new Tray(model, state, { open });
  carrySelection(model, state);
  watchSearch(state);
  watchTables(() => galleryTables(model, fields, sieve, grid.groups));
  window.addEventListener("hashchange", () => state.set(readGalleryAddress(model, fields)));
  watchTheme(() => state.set({ theme: currentTheme() }));

  if (state.get("query") !== "") await search(model, state);
  sift();
  arrange(false);
  if (state.get("at") !== null) grid.start(state.get("at"));
  document.documentElement.dataset.ready = "";
}

/** The shapes that the words of the search find; null without words. */
async function search(model, state) {
  const query = state.get("query");
  if (query === "") {
    state.set({ matches: null });
    return;
  }
  search.texts ??= searchTexts(model);
  const texts = await search.texts;
  if (state.get("query") === query) state.set({ matches: new Set(findWords(texts, query)) });
}

function watchSearch(state) {
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
    if (event.key === "Escape") escape(state);
    else if (event.key === "/" && !event.target.matches("input[type=search]")) {
      field.focus();
      event.preventDefault();
    }
  });
  show();
}

/** One press takes back the last thing: the search, then the selection. */
function escape(state) {
  if (state.get("query") !== "") state.set({ query: "" });
  else state.set({ selection: new Set() });
}

function delayed(work, wait) {
  let timer = null;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(work, wait);
  };
}

main();
