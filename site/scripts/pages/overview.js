// The Overview: the map of all shapes, the linked maps, the classes, the tray, the card and the panel of one shape.

import { overviewAddress } from "../addresses/overview.js";
import { chunk } from "../base/chunks.js";
import { openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { firstKey } from "../colors/colors.js";
import { loadAllBins } from "../database/level-bins.js";
import { Database } from "../database/database.js";
import { TrueNeighbours } from "../database/true-neighbours.js";
import { Card } from "../map/card.js";
import { partedNeighbours, watchLines } from "../map/lines.js";
import { dragging, NOTHING_POINTED } from "../map/scene.js";
import { mapTables } from "../map/tables.js";
import { ClassList } from "../overview/classes.js";
import { trayHint, watchControls, watchKeys } from "../overview/controls.js";
import { Detail } from "../overview/detail.js";
import { addressedMap, FeatureChoice } from "../overview/feature-choice.js";
import { watchIntroduction } from "../overview/introduction.js";
import { OverviewMaps } from "../overview/maps.js";
import { Search } from "../overview/search.js";
import { knownView, viewColors } from "../overview/view-colors.js";
import { carryView } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";

async function main() {
  const database = new Database(await chunk("overview"), currentTheme);
  const { state, written, announce, ready } = await openPage({
    address: overviewAddress(database),
    settle: async (found, miss) => knownView(database, await addressedMap(database, found), miss),
    values: { ...NOTHING_POINTED, ...dragging(), matches: null, by: firstKey(), coloring: null, alike: null },
  });
  const maps = new OverviewMaps(database, state, viewColors(database, state), announce);
  // Pictures beside the map point at their shape on it.
  /** @param {number | null} pointed */
  const point = (pointed) => state.set({ pointed, pointedFrom: maps.large });
  const classes = new ClassList(database, state);
  const detail = new Detail(database, state, { point, parted: (index) => partedNeighbours(maps.large, index) });
  const search = new Search(database, state, {
    announce,
    open(index) {
      state.set({ opened: index });
      maps.gestures.get(maps.large)?.zoomTo([index]);
    },
  });
  new Card(state);
  new Tray(database, state, {
    open: (opened) => state.set({ opened }),
    point,
    hint: trayHint(),
    zoom: () => maps.gestures.get(maps.large)?.zoomToSelection(),
  });
  carryView(written);
  watchTables(() => mapTables(database, state, state.get("coloring") ?? null));
  if (database.data.subsets) new FeatureChoice(database, state);
  watchIntroduction();
  maps.scene.alike = new TrueNeighbours(database, loadAllBins, () => state.set({ alike: {} }));
  watchLines(state);
  watchControls(database, state, maps);
  watchKeys(state, maps);

  // What is seen first is drawn first.
  classes.render();
  await maps.open();
  await classes.start();
  if (state.get("query") !== "") await search.run();
  if (state.get("opened") !== null) await detail.show();
  ready({
    redraw() {
      maps.redraw();
      classes.start();
    },
  });
}

main();
