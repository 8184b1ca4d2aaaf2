// The page of one shape: what it is, where it lies, and which shapes are most like it.

import { missFeatures, namesFeatures, shapePageAddress } from "../addresses/shape.js";
import { chunk } from "../base/chunks.js";
import { openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { Database } from "../database/database.js";
import { Pointing } from "../map/pointing.js";
import { showFeatures, whenSeen } from "../shape/by-features.js";
import { Facts } from "../shape/facts.js";
import { Heading } from "../shape/heading.js";
import { ShapeLinks } from "../shape/links.js";
import { Portrait } from "../shape/portrait.js";
import { Surroundings } from "../shape/surroundings.js";
import { shapeTables } from "../shape/tables.js";
import { carryView } from "../tray/carry.js";
import { clearOnEscape, Tray } from "../tray/tray.js";

async function main() {
  const database = new Database(await chunk("overview"), currentTheme);
  const page = document.getElementById("content");
  const { state, written, announce, ready } = await openPage({
    address: shapePageAddress(database),
    async check(found, miss) {
      if (namesFeatures(found)) missFeatures(found, (await chunk("workbench")).features, miss);
    },
  });
  carryView(written);
  let opened = false;
  const links = new ShapeLinks(database, state, { opened: () => (opened = true) });
  /** @param {number} shape */
  const go = (shape) => {
    opened = true;
    state.set({ shape, unknown: null });
  };
  const portrait = new Portrait(database, state, { models: page.dataset.models !== undefined });
  const facts = new Facts(database, state, { links });
  const views = [
    new Heading(database, state, { links, go, site: page.dataset.site }),
    portrait,
    facts,
    new Surroundings(database, state, { links, pointing: new Pointing(database), go }),
  ];
  const told = Promise.all(views.map((view) => view.render()));
  state.listen((changed) => {
    if (!changed.has("shape")) return;
    announce(state.get("shape") === null ? "No such shape" : database.names.at(state.get("shape")));
    // The browser's own way back also finds the place on the page again.
    if (opened) {
      window.scrollTo(0, 0);
      page.focus({ preventScroll: true });
    }
    opened = false;
  });
  clearOnEscape(state);
  new Tray(database, state, { open: go });
  /** @type {Partial<Awaited<ReturnType<typeof showFeatures>>>} */
  let byFeatures = {};
  watchTables(() => shapeTables(database, state, { facts, ...byFeatures }));
  const load = async () => {
    // The largest data of a site: what is known of the shape comes before them.
    await told;
    byFeatures = await showFeatures(database, state, { links, portrait });
  };
  // A bin or a shape beside it that the address names is to be seen at once.
  if (state.get("bin") !== null || state.get("beside") !== null) load();
  else whenSeen(document.getElementById("by-features"), load);
  ready();
}

main();
