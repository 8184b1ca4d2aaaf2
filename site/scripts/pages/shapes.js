// The Shapes page: all shapes as pictures, to search, filter, group, sort, and select.

import { readGalleryAddress, writeGalleryAddress } from "../addresses/shapes.js";
import { chunks } from "../base/chunks.js";
import { delayed, openPage } from "../base/page.js";
import { pageAddress } from "../base/place.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { count } from "../base/words.js";
import { Database } from "../database/database.js";
import { Fields } from "../database/fields.js";
import { watchActions } from "../shapes/actions.js";
import { Arrangement } from "../shapes/arrangement.js";
import { Cells } from "../shapes/cells.js";
import { Chips } from "../shapes/chips.js";
import { Controls } from "../shapes/controls.js";
import { Facets } from "../shapes/facets.js";
import { Grid } from "../shapes/grid.js";
import { Keys } from "../shapes/keys.js";
import { Panel } from "../shapes/panel.js";
import { search, watchSearch } from "../shapes/search.js";
import { Sieve } from "../shapes/sieve.js";
import { galleryTables } from "../shapes/tables.js";
import { carrySelection, follow } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";

const SAY_AFTER = 500;

async function main() {
  const [overview, described, hierarchy] = await chunks("overview", "fields", "hierarchy");
  const database = new Database(overview, currentTheme);
  const fields = new Fields(database, described, hierarchy);
  const { state, announce, ready } = await openPage({
    read: () => readGalleryAddress(database, fields),
    values: { matches: null, opened: null },
  });
  const sieve = new Sieve(database, fields);
  const arrangement = new Arrangement(database, fields);
  const grid = new Grid(database, state);
  const chips = new Chips(fields, sieve, state);
  const facets = new Facets(database, fields, sieve, state);
  const panel = new Panel(sieve, state);
  const showActions = watchActions(database, sieve, grid, state);
  new Controls(database, fields, state);

  let cells = null;
  const arrange = (fromTop) => {
    const how = { group: state.get("group"), sort: state.get("sort"), down: state.get("down") };
    if (cells === null || cells.how !== JSON.stringify([how, state.get("theme")])) {
      cells = new Cells(database, fields, how);
      cells.how = JSON.stringify([how, state.get("theme")]);
    }
    grid.show(
      arrangement.arrange((row) => sieve.passes(row), how),
      cells,
      fromTop,
    );
    grid.mark();
  };
  const sift = () => {
    sieve.sift(state.get("matches"), state.get("only") ? state.get("selection") : null, state.get("filters"));
    chips.show();
    facets.show();
    panel.show();
    showActions();
  };
  const write = () => writeGalleryAddress(database, fields, state);
  const later = delayed(write);
  const say = delayed(() => announce(`${count(sieve.size, "shape")} shown`), SAY_AFTER);

  state.listen((changed) => {
    const has = (...names) => names.some((name) => changed.has(name));
    if (has("query")) search(database, state);
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
  const open = (index) => follow(pageAddress("shape.html", { id: database.ids[index] }));
  new Tray(database, state, { open });
  carrySelection(database, state);
  watchSearch(state);
  watchTables(() => galleryTables(database, fields, sieve, grid.groups));

  if (state.get("query") !== "") await search(database, state);
  sift();
  arrange(false);
  if (state.get("at") !== null) grid.start(state.get("at"));
  ready();
}

main();
