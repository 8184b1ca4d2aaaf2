// The Compare page: what sets two groups apart, what they share, outliers, and classes that are alike.

import { comparePageAddress } from "../addresses/compare.js";
import { chunk, chunks, part } from "../base/chunks.js";
import { pause } from "../base/dom.js";
import { openPage } from "../base/page.js";
import { pageAddress, readHash } from "../base/place.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { GroupsView } from "../compare/groups-view.js";
import { Matrix } from "../compare/matrix.js";
import { Neighbours } from "../compare/neighbours.js";
import { Outliers } from "../compare/outliers.js";
import { compareTables } from "../compare/tables.js";
import { Tabs } from "../compare/tabs.js";
import { binNames } from "../database/bins.js";
import { Database } from "../database/database.js";
import { loadAllBins } from "../database/level-bins.js";
import { carryView, follow } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";

async function main() {
  // Two groups are what most come for, and their values what takes longest.
  if (!readHash().has("view")) loadAllBins().catch(() => {});
  const [[overview, data, clusters]] = await Promise.all([
    chunks("overview", "compare", "clusters"),
    // Those in the space of all features.
    part("neighbours", 0),
  ]);
  const database = new Database(overview, currentTheme);
  const neighbours = new Neighbours(database, data);
  await neighbours.know();
  const { state, written, announce, ready } = await openPage({
    address: comparePageAddress(
      database,
      data,
      neighbours,
      (clusters?.clusters ?? []).map(({ name }) => name),
    ),
    async check({ bin }, miss) {
      if (bin !== null && !binNames((await chunk("workbench")).features).includes(bin)) miss("bin", bin);
    },
  });
  const groups = new GroupsView(database, data, clusters, neighbours, state, { bins: loadAllBins, announce });
  groups.compare();
  // What it asks for comes while the rest is made.
  await pause();
  const outliers = new Outliers(database, data, neighbours, state, { bins: loadAllBins, announce });
  const matrix = new Matrix(database, data, neighbours, state, { announce });
  new Tabs(state);
  /** @param {number} index */
  const open = (index) => follow(pageAddress("shape.html", { id: database.ids.at(index) }));
  new Tray(database, state, { open, take: (side, group) => groups.chooser.choose(side, group) });
  carryView(written);
  outliers.render();
  matrix.render();
  watchTables(() => compareTables(database, data, state, { groups, outliers, matrix }));
  ready();
}

main();
