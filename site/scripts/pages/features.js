// The Features page: all subsets of the features, the chosen one's map, and what is known of the features.

import { readFeaturesAddress, writeFeaturesAddress } from "../addresses/features.js";
import { overviewAddress } from "../addresses/overview.js";
import { chunk } from "../base/chunks.js";
import { delayed, openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, styleColor, watchTheme } from "../base/theme.js";
import { figure } from "../base/words.js";
import { Database } from "../database/database.js";
import { Subsets } from "../database/subsets.js";
import { Boxes } from "../features/boxes.js";
import { watchColors, watchDrag, watchMapKeys } from "../features/controls.js";
import { dotCharts } from "../features/dot-charts.js";
import { Panel } from "../features/panel.js";
import { Ranking } from "../features/ranking.js";
import { RetrievalSection } from "../features/retrieval.js";
import { shown } from "../features/subset-map.js";
import { subsetTables } from "../features/tables.js";
import { Card } from "../map/card.js";
import { Gestures } from "../map/gestures.js";
import { MapView } from "../map/map.js";
import { dragging, NOTHING_POINTED, Scene } from "../map/scene.js";
import { carryAddress, carrySelection } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";

async function main() {
  const [overview, search] = await Promise.all([chunk("overview"), chunk("search")]);
  const subsets = new Subsets(search);
  const database = new Database(overview, currentTheme);
  const { state, announce, ready } = await openPage({
    read: () => readFeaturesAddress(subsets, database),
    values: {
      ...NOTHING_POINTED,
      ...dragging(),
      pointedPlace: null,
      method: null,
      hidden: new Set(),
      matches: null,
      opened: null,
      camera: null,
    },
  });
  const marks = () => ({
    ...search.marks[currentTheme()],
    config: database.marks.config,
    ink: styleColor("ink"),
    accent: styleColor("accent"),
    ground: styleColor("paper"),
  });
  const ranking = new Ranking(subsets, state, marks, announce);
  const link = overview.subsets && ((place) => overviewAddress(subsets.names(place)));
  new Panel(subsets, state, marks, link);
  const retrieval = await retrievalSection(
    overview,
    () => subsets.names(state.get("chosen")),
    (names) => state.set({ chosen: subsets.find(names) }),
  );
  watchTables(() => {
    const { title, tables } = subsetTables(database, subsets, state);
    return { title, tables: [...tables, ...(retrieval?.tables() ?? [])] };
  });
  const paint = () => {
    for (const mark of document.querySelectorAll("[data-hue]"))
      mark.style.background = marks().features[mark.dataset.hue];
  };
  paint();
  for (const [id, value] of Object.entries({ chance: search.chance, "chance-best": search.chanceBest })) {
    if (subsets.labelled) document.getElementById(id).textContent = figure(value);
  }
  await ranking.start();

  // The map comes with the largest chunk of the page, so it waits for what is above it.
  state.set({ method: await shown(database, subsets, state.get("chosen")) });
  const scene = new Scene(database, state);
  const surface = document.querySelector("figure.map");
  surface.dataset.view = state.get("color");
  const map = new MapView(scene, surface);
  scene.views = [map];
  watchDrag(state);
  const open = (opened) => state.set({ opened: opened === state.get("opened") ? null : opened });
  const gestures = new Gestures(map, {
    open,
    promote: () => {},
    announce: (index) => announce(`${database.names[index]}, ${database.className(database.groups[index])}`),
  });
  watchMapKeys(map.surface, state, gestures);
  new Card(state);
  new Tray(database, state, { open });
  carrySelection(database, state);
  await map.start();
  const boxes = subsets.labelled ? new Boxes(database, subsets, state, marks) : null;
  await boxes?.start();
  const dots = subsets.labelled ? dotCharts(subsets, marks) : [];
  for (const chart of dots) await chart.start();

  watchColors(state, map);
  const write = delayed(() => writeFeaturesAddress(subsets, database, state));
  state.listen(async (changed) => {
    if (changed.has("chosen") || changed.has("theme")) retrieval?.render();
    if (changed.has("chosen")) {
      const chosen = state.get("chosen");
      const method = await shown(database, subsets, chosen);
      // Another may have been chosen while this one was fetched.
      if (state.get("chosen") === chosen) state.set({ method });
    }
    if (["chosen", "s", "color", "selection"].some((name) => changed.has(name))) write();
  });
  const observer = new ResizeObserver(() => {
    ranking.resize();
    map.resize();
    boxes?.render();
    for (const chart of dots) chart.resize();
  });
  for (const node of [ranking.scroll, map.surface, ...dots.map(({ node }) => node)]) observer.observe(node);
  ready({
    redraw() {
      paint();
      for (const chart of [ranking, map, boxes, ...dots]) chart?.start();
    },
  });
}

/** How well similar shapes are found; null where no class has two shapes. */
async function retrievalSection(overview, chosen, choose) {
  if (!document.getElementById("retrieval")) return null;
  return new RetrievalSection(await chunk("retrieval"), overview.classes, chosen, choose);
}

/** A site without a search: nothing can be chosen. */
async function withoutSearch() {
  const section = await retrievalSection(await chunk("overview"), null, null);
  if (section !== null) watchTables(() => ({ title: "Retrieval in figures", tables: section.tables() }));
  watchTheme(() => section?.render());
  carryAddress();
  document.documentElement.dataset.ready = "";
}

if (document.getElementById("ranking")) main();
else withoutSearch();
