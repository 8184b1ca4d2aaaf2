// The Features page: all subsets of the features, the chosen one's map, and what is known of the features.

import { featuresAddress } from "../addresses/features.js";
import { subsetAddress } from "../addresses/overview.js";
import { chunk } from "../base/chunks.js";
import { pause, watchSize } from "../base/dom.js";
import { openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { knownColor } from "../colors/choice.js";
import { Database } from "../database/database.js";
import { Subsets } from "../database/subsets.js";
import { Boxes } from "../features/boxes.js";
import { ChosenMap, nothingShown } from "../features/chosen-map.js";
import { foldParts } from "../features/controls.js";
import { dotCharts } from "../features/dot-charts.js";
import { hues, paintHues } from "../features/hues.js";
import { Panel } from "../features/panel.js";
import { Ranking } from "../features/ranking.js";
import { openRetrieval } from "../features/retrieval.js";
import { subsetTables } from "../features/tables.js";
import { carryView } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";

async function main() {
  foldParts();
  const [overview, search] = await Promise.all([chunk("overview"), chunk("search")]);
  const [subsets, database] = [new Subsets(search), new Database(overview, currentTheme)];
  const { state, written, announce, ready } = await openPage({
    address: featuresAddress(subsets, database),
    settle: knownColor(database),
    values: { ...nothingShown(), pointedPlace: null },
  });
  const marks = hues(search, database);
  const ranking = new Ranking(subsets, state, marks, announce);
  const onOverview = overview.subsets !== null;
  new Panel(database, subsets, state, marks, onOverview ? (place) => subsetAddress(subsets.names(place)) : null);
  const retrieval = await openRetrieval(overview, state, {
    chosen: () => subsets.names(state.get("chosen")),
    choose: (names) => state.set({ chosen: subsets.find(names) }),
  });
  watchTables(() => subsetTables(database, subsets, state, retrieval));
  paintHues(marks());
  await ranking.start();
  // The map comes with the largest chunk of the page, so it waits for what is above it.
  const map = new ChosenMap(database, subsets, state, announce);
  new Tray(database, state, { open: (shape) => map.toggle(shape), zoom: () => map.gestures.zoomToSelection() });
  carryView(written);
  await map.open();
  const charts = subsets.labelled ? [new Boxes(database, subsets, state, marks), ...dotCharts(subsets, marks)] : [];
  ready({
    redraw() {
      paintHues(marks());
      for (const chart of [ranking, map, ...charts]) chart.start();
    },
  });
  for (const chart of charts) {
    await pause();
    await chart.start();
  }
  watchSize([ranking.scroll, ...charts.map(({ node }) => node)], () => {
    for (const chart of [ranking, ...charts]) chart.resize();
  });
  await pause();
  await map.chart();
}

/** A site without a search: nothing can be chosen. */
async function withoutSearch() {
  const { state, written, ready } = await openPage();
  const retrieval = await openRetrieval(await chunk("overview"), state);
  if (retrieval !== null) watchTables(() => ({ title: "Retrieval in figures", tables: retrieval.tables() }));
  carryView(written);
  ready();
}

if (document.getElementById("ranking")) main();
else withoutSearch();
