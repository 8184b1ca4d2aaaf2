// The Workbench (paper, 4.3 and Fig. 5): choose classes, features and bins, and see the maps they make.

import { readWorkAddress, workAddress } from "../addresses/workbench.js";
import { chunk } from "../base/chunks.js";
import { delayed, openPage } from "../base/page.js";
import { pushHash, replaceHash } from "../base/place.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { BinCard } from "../bins-kit/bin-card.js";
import { Bins } from "../database/bins.js";
import { Database } from "../database/database.js";
import { Card } from "../map/card.js";
import { Gestures } from "../map/gestures.js";
import { LiveScene } from "../map/live-scene.js";
import { MapView } from "../map/map.js";
import { dragging, NOTHING_POINTED } from "../map/scene.js";
import { carrySelection } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";
import { Answers } from "../workbench/answers.js";
import { BinChart } from "../workbench/bin-chart.js";
import { ClassTable } from "../workbench/class-table.js";
import { watchControls, watchKeys } from "../workbench/controls.js";
import { Desk } from "../workbench/desk.js";
import { watchDownloads } from "../workbench/downloads.js";
import { emptyMap } from "../workbench/empty-map.js";
import { FeatureList } from "../workbench/feature-list.js";
import { Guide } from "../workbench/guide.js";
import { HistoryStrip } from "../workbench/history-strip.js";
import { MapPanel } from "../workbench/map-panel.js";
import { separationWords, sides } from "../workbench/separation.js";
import { StatusLine } from "../workbench/status-line.js";
import { workTables } from "../workbench/tables.js";

const WHICH = ["original", "refined"];

async function main() {
  const [overview, data, bytes] = await Promise.all([chunk("overview"), chunk("workbench"), chunk("bins")]);
  const bins = new Bins(data, bytes);
  const database = new Database(overview, currentTheme);
  const content = document.getElementById("content");
  const { state, announce, ready } = await openPage({
    read: () => readWorkAddress(database, data),
    values: {
      ...NOTHING_POINTED,
      ...dragging(),
      step: 0,
      originalMap: null,
      originalStatus: { kind: "none" },
      originalCamera: null,
      refinedMap: null,
      refinedStatus: { kind: "none" },
      refinedCamera: null,
      scores: null,
      scoresStatus: { kind: "none" },
      method: 0,
      matches: null,
      opened: null,
    },
  });
  const marks = () => data.marks[currentTheme()];
  const answers = new Answers(database, data, bins);

  // Each map has a database of its own: the same shapes, one layout.
  const databases = WHICH.map(() => new Database({ ...overview, methods: overview.methods.slice(0, 1) }, currentTheme));
  const scenes = databases.map((own, place) => new LiveScene(own, state, `${WHICH[place]}Camera`));
  const maps = scenes.map((scene, place) => {
    const view = new MapView(scene, document.querySelector(`figure[data-map="${WHICH[place]}"]`));
    view.name = state.get("color");
    scene.views = [view];
    return view;
  });
  const desk = new Desk(
    database,
    data,
    bins,
    state,
    answers,
    Object.fromEntries(WHICH.map((which, place) => [which, scenes[place]])),
    announce,
  );

  const open = (opened) => state.set({ opened: opened === state.get("opened") ? null : opened });
  const announceShape = (index) => announce(`${database.names[index]}, ${database.className(database.groups[index])}`);
  const gestures = maps.map((map) => new Gestures(map, { open, promote: () => {}, announce: announceShape }));
  new Card(state);
  // A picture in the tray marks its shape on both maps.
  new Tray(database, state, { open });
  carrySelection(database, state);
  const panels = WHICH.map(
    (which) =>
      new MapPanel(which, database, state, bins, {
        other: which === "refined" ? "originalMap" : null,
        again: () => desk.ask([which]),
        stop: () => desk.stop(which),
        empty: () => emptyMap(which, state, answers, desk),
      }),
  );
  if (database.labelled)
    new ClassTable(database, state, {
      change: (hidden) => desk.use({ hidden }),
      separate: (part, groups) => desk.separate(part, groups),
    });
  new FeatureList(bins, state, marks, (features) => desk.use({ features }));
  const strip = new HistoryStrip(database, state, desk.history, { go: (place) => desk.go(place) });
  const binCard = new BinCard(bins, database);
  const chart = new BinChart(document.getElementById("bin-chart"), bins, {
    onToggle: (column) => desk.toggle([column]),
    onRange: (columns) => desk.add(columns),
    onRemove: (columns) => desk.remove(columns),
    onPoint: (column, box) => (column === null ? binCard.hide() : binCard.show(column, box)),
    announce,
  });
  const status = new StatusLine(document.getElementById("scores-status"), {
    again: () => desk.ask(["scores"]),
    stop: () => desk.stop("scores"),
  });
  const noScores = new Float64Array(bins.count).fill(NaN);
  const drawChart = () => {
    const scores = state.get("scores") ?? noScores;
    const groups = answers.groups(state.get("hidden"));
    const separation = state.get("separation");
    const { positive } = sides(separation, groups);
    binCard.know({
      scores,
      scorer: database.separable
        ? data.scorers.find(({ key }) => key === state.get("scorer")).title
        : "standard deviation",
      separated: positive,
      others: groups.filter((group) => !positive.includes(group)),
    });
    chart.draw({
      scores,
      chosen: state.get("bins"),
      busy: state.get("scoresStatus").kind === "working",
      separation: database.separable ? separationWords(separation, groups, database) : null,
    });
  };
  watchControls(database, data, state, desk);
  watchKeys(state, desk, new Map(maps.map((map, place) => [map.surface, gestures[place]])));
  watchTables(() => workTables(database, bins, state));
  watchDownloads(database, bins, () => desk.work());
  new Guide(database, data, bins, state, desk);

  const write = delayed(() => replaceHash(workAddress(database, data, state)));
  state.listen((changed) => {
    if (["scores", "bins", "scoresStatus", "separation", "hidden", "scorer"].some((name) => changed.has(name)))
      drawChart();
    if (changed.has("scoresStatus")) status.show(/** @type {any} */ (state.get("scoresStatus")));
    if ([...changed].some((name) => name.endsWith("Status"))) content.setAttribute("aria-busy", String(desk.busy));
    if (changed.has("color")) {
      for (const map of maps) {
        map.name = state.get("color");
        map.start();
      }
    }
    if (["projection", "scorer", "separation", "sample", "color"].some((name) => changed.has(name)) && !desk.arriving)
      replaceHash(workAddress(database, data, state));
    if (changed.has("selection")) write();
    // Every step is a place that the browser's way back leads to, unless it has just led here.
    if (changed.has("step") && !desk.arriving) pushHash(workAddress(database, data, state));
  });

  desk.ask();
  for (const panel of panels) panel.render();
  strip.render();
  for (const map of maps) await map.start();
  const observer = new ResizeObserver(() => {
    for (const map of maps) map.resize();
    chart.resize();
  });
  for (const node of [...maps.map(({ surface }) => surface), document.getElementById("bin-chart")])
    observer.observe(node);
  ready({
    arrive: (found) => desk.arrive(found),
    redraw() {
      for (const view of [...maps, chart]) view.start();
    },
  });
  answers.warm();
}

main();
