// The Workbench (paper, 4.3 and Fig. 5): choose classes, features and bins, and see the maps they make.

import { workAddress } from "../addresses/workbench.js";
import { chunk } from "../base/chunks.js";
import { pause } from "../base/dom.js";
import { openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { chosenColors, knownColor } from "../colors/choice.js";
import { loadBins } from "../database/bins.js";
import { Database } from "../database/database.js";
import { Card } from "../map/card.js";
import { dragging, NOTHING_POINTED } from "../map/scene.js";
import { carryView } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";
import { Answers } from "../workbench/answers.js";
import { BinSection } from "../workbench/bin-section.js";
import { ClassTable } from "../workbench/class-table.js";
import { watchControls, watchKeys } from "../workbench/controls.js";
import { Desk, nothingMade } from "../workbench/desk.js";
import { watchDownloads } from "../workbench/downloads.js";
import { FeatureList } from "../workbench/feature-list.js";
import { Guide } from "../workbench/guide.js";
import { HistoryStrip } from "../workbench/history-strip.js";
import { mapPanels } from "../workbench/map-panel.js";
import { WorkMaps } from "../workbench/maps.js";
import { workTables } from "../workbench/tables.js";

async function main() {
  const [overview, data, bins] = await Promise.all([chunk("overview"), chunk("workbench"), loadBins()]);
  const database = new Database(overview, currentTheme);
  const { state, written, announce, ready } = await openPage({
    address: workAddress(database, data),
    settle: knownColor(database),
    values: { ...NOTHING_POINTED, ...dragging(), ...nothingMade(), coloring: null, alike: null },
  });
  const answers = new Answers(database, data, bins);
  const maps = new WorkMaps(overview, database, state, bins, chosenColors(database, state), announce);
  const desk = new Desk(database, data, bins, state, answers, maps.scenes, announce);
  await pause();
  new Card(state);
  // A picture in the tray marks its shape on both maps.
  new Tray(database, state, { open: (shape) => maps.toggle(shape), zoom: () => maps.zoomToSelection() });
  carryView(written);
  if (database.labelled)
    new ClassTable(database, state, {
      change: (hidden) => desk.use({ hidden }),
      separate: (part, groups) => desk.separate(part, groups),
    });
  const marks = () => data.marks[currentTheme()];
  new FeatureList(bins, state, marks, (features) => desk.use({ features }));
  await pause();
  const strip = new HistoryStrip(database, state, desk);
  const section = new BinSection(database, data, bins, state, answers, desk, announce);
  watchControls(database, data, state, desk);
  watchKeys(state, desk, maps.gestures);
  watchTables(() => workTables(database, bins, state));
  watchDownloads(database, bins, () => desk.work());
  new Guide(database, data, bins, state, desk);
  await pause();
  desk.ask();
  for (const panel of mapPanels(database, state, bins, answers, desk)) panel.render();
  strip.render();
  await pause();
  await maps.start();
  section.start();
  ready({
    arrive: (found) => desk.arrive(/** @type {any} */ (found)),
    redraw() {
      maps.redraw();
      section.redraw();
    },
  });
  answers.warm();
  await maps.chart();
}

main();
