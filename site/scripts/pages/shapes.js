// The Shapes page: all shapes as pictures, to search, filter, group, sort, and select.

import { galleryAddress } from "../addresses/shapes.js";
import { chunks } from "../base/chunks.js";
import { openPage } from "../base/page.js";
import { pageAddress } from "../base/place.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { Database } from "../database/database.js";
import { Fields } from "../database/fields.js";
import { Gallery } from "../shapes/gallery.js";
import { galleryTables } from "../shapes/tables.js";
import { carryView, follow } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";

async function main() {
  const [overview, described, hierarchy] = await chunks("overview", "fields", "hierarchy");
  const database = new Database(overview, currentTheme);
  const fields = new Fields(database, described, hierarchy);
  const { state, written, announce, ready } = await openPage({
    address: galleryAddress(database, fields),
    values: { matches: null, opened: null },
  });
  const gallery = new Gallery(database, fields, state, announce);
  /** @param {number} index */
  const open = (index) => follow(pageAddress("shape.html", { id: database.ids.at(index) }));
  new Tray(database, state, { open });
  carryView(written);
  watchTables(() => galleryTables(database, fields, gallery.sieve, gallery.grid.groups));
  await gallery.start();
  ready();
}

main();
