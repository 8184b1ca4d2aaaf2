// The Workbench (paper, 4.3 and Fig. 5): choose classes, features and bins, and see the maps they make.

import { BinCard } from "../bins-kit/bin-card.js";
import { BinChart } from "../workbench/bin-chart.js";
import { Bins } from "../database/bins.js";
import { Card } from "../map/card.js";
import { carrySelection } from "../tray/carry.js";
import { chunk } from "../base/chunks.js";
import { element } from "../base/dom.js";
import { Gestures } from "../map/gestures.js";
import { LiveScene } from "../map/live-scene.js";
import { MapView } from "../map/map.js";
import { Model } from "../database/model.js";
import { pushHash, replaceHash } from "../base/place.js";
import { State } from "../base/state.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, watchTheme } from "../base/theme.js";
import { Tray } from "../tray/tray.js";
import { count, grouped } from "../base/words.js";
import { readWorkAddress, workAddress } from "../addresses/workbench.js";
import { Answers } from "../workbench/answers.js";
import { Desk, FEWEST_SHAPES } from "../workbench/desk.js";
import { ClassTable } from "../workbench/class-table.js";
import { watchControls, watchKeys } from "../workbench/controls.js";
import { watchDownloads } from "../workbench/downloads.js";
import { FeatureList } from "../workbench/feature-list.js";
import { Guide } from "../workbench/guide.js";
import { HistoryStrip } from "../workbench/history-strip.js";
import { MapPanel } from "../workbench/map-panel.js";
import { MOST_SHAPES } from "../database/sample.js";
import { separationWords, sides } from "../workbench/separation.js";
import { StatusLine } from "../workbench/status-line.js";
import { workTables } from "../workbench/tables.js";

const WHICH = ["original", "refined"];
const BEST = 10;

async function main() {
  const [overview, data, bytes] = await Promise.all([chunk("overview"), chunk("workbench"), chunk("bins")]);
  const bins = new Bins(data, bytes);
  const model = new Model(overview, currentTheme);
  const content = document.getElementById("content");
  const live = document.getElementById("live");
  const announce = (text) => {
    live.textContent = text;
  };
  const state = new State({
    ...readWorkAddress(model, data),
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
    drag: window.matchMedia("(pointer: coarse)").matches ? "move" : "select",
    matches: null,
    opened: null,
    pointed: null,
    pointedFrom: null,
    pointedGroup: null,
    brushing: false,
    theme: currentTheme(),
  });
  const marks = () => data.marks[currentTheme()];
  const answers = new Answers(model, data, bins);

  // Each map has a model of its own: the same shapes, one layout.
  const models = WHICH.map(() => new Model({ ...overview, methods: overview.methods.slice(0, 1) }, currentTheme));
  const scenes = models.map((own, place) => new LiveScene(own, state, `${WHICH[place]}Camera`));
  const maps = scenes.map((scene, place) => {
    const view = new MapView(scene, document.querySelector(`figure[data-map="${WHICH[place]}"]`));
    view.name = state.get("color");
    scene.views = [view];
    return view;
  });
  const desk = new Desk(model, data, bins, state, answers, Object.fromEntries(WHICH.map((which, place) => [which, scenes[place]])), announce);

  const open = (opened) => state.set({ opened: opened === state.get("opened") ? null : opened });
  const announceShape = (index) => announce(`${model.names[index]}, ${model.className(model.groups[index])}`);
  const gestures = maps.map((map) => new Gestures(map, { open, promote: () => {}, announce: announceShape }));
  new Card(state);
  // A picture in the tray marks its shape on both maps.
  new Tray(model, state, { open });
  carrySelection(model, state);
  const panels = WHICH.map((which) => new MapPanel(which, model, state, bins, {
    other: which === "refined" ? "originalMap" : null,
    again: () => desk.ask([which]),
    stop: () => desk.stop(which),
    empty: () => emptyMap(which, state, answers, desk),
  }));
  if (model.labelled) new ClassTable(model, state, { change: (hidden) => desk.use({ hidden }), separate: (part, groups) => desk.separate(part, groups) });
  new FeatureList(bins, state, marks, (features) => desk.use({ features }));
  const strip = new HistoryStrip(model, state, desk.history, { go: (place) => desk.go(place) });
  const binCard = new BinCard(bins, model);
  const chart = new BinChart(document.getElementById("bin-chart"), bins, {
    onToggle: (column) => desk.toggle([column]),
    onRange: (columns) => desk.add(columns),
    onRemove: (columns) => desk.remove(columns),
    onPoint: (column, box) => (column === null ? binCard.hide() : binCard.show(column, box)),
    announce,
  });
  const status = new StatusLine(document.getElementById("scores-status"), { again: () => desk.ask(["scores"]), stop: () => desk.stop("scores") });
  const noScores = new Float64Array(bins.count).fill(NaN);
  const drawChart = () => {
    const scores = state.get("scores") ?? noScores;
    const groups = answers.groups(state.get("hidden"));
    const separation = state.get("separation");
    const { positive } = sides(separation, groups);
    binCard.know({
      scores,
      scorer: model.separable ? data.scorers.find(({ key }) => key === state.get("scorer")).title : "standard deviation",
      separated: positive,
      others: groups.filter((group) => !positive.includes(group)),
    });
    chart.draw({
      scores,
      chosen: state.get("bins"),
      busy: state.get("scoresStatus").kind === "working",
      separation: model.separable ? separationWords(separation, groups, model) : null,
    });
  };
  watchControls(model, data, state, desk);
  watchKeys(state, desk, new Map(maps.map((map, place) => [map.surface, gestures[place]])));
  watchTables(() => workTables(model, bins, state));
  watchDownloads(model, bins, () => desk.work());
  new Guide(model, data, bins, state, desk);

  state.listen((changed) => {
    if (["scores", "bins", "scoresStatus", "separation", "hidden", "scorer"].some((name) => changed.has(name))) drawChart();
    if (changed.has("scoresStatus")) status.show(state.get("scoresStatus"));
    if ([...changed].some((name) => name.endsWith("Status"))) content.setAttribute("aria-busy", String(desk.busy));
    if (changed.has("color")) {
      for (const map of maps) {
        map.name = state.get("color");
        map.start();
      }
    }
    if (["projection", "scorer", "separation", "sample", "color"].some((name) => changed.has(name)) && !desk.arriving) replaceHash(workAddress(model, data, state));
    if (changed.has("selection")) {
      clearTimeout(main.writing);
      main.writing = setTimeout(() => replaceHash(workAddress(model, data, state)), 250);
    }
    // Every step is a place that the browser's way back leads to, unless it has just led here.
    if (changed.has("step") && !desk.arriving) pushHash(workAddress(model, data, state));
  });
  window.addEventListener("hashchange", () => desk.arrive(readWorkAddress(model, data)));
  watchTheme(() => {
    for (const map of maps) map.start();
    chart.start();
    state.set({ theme: currentTheme() });
  });

  desk.ask();
  for (const panel of panels) panel.render();
  strip.render();
  for (const map of maps) await map.start();
  const observer = new ResizeObserver(() => {
    for (const map of maps) map.resize();
    chart.resize();
  });
  for (const node of [...maps.map(({ surface }) => surface), document.getElementById("bin-chart")]) observer.observe(node);
  document.documentElement.dataset.ready = "";
  answers.warm();
}

/** Why there is no map, and what to do next. */
function emptyMap(which, state, answers, desk) {
  const rows = answers.rows({ hidden: state.get("hidden"), sample: state.get("sample") }).length;
  if (rows < FEWEST_SHAPES) {
    const words = answers.model.count < FEWEST_SHAPES ? `This database has ${count(answers.model.count, "shape")}; a map needs ${FEWEST_SHAPES}.` : "A map needs three shapes: take more classes into use.";
    return [element("p", {}, words)];
  }
  if (rows > MOST_SHAPES && (which === "original" || state.get("bins").size > 0)) {
    return [
      element("p", {}, `A map of ${count(rows, "shape")} takes a browser long. A sample of ${grouped(MOST_SHAPES)}, each class in proportion, takes seconds; both maps are then of the sample, so that their NH can be compared.`),
      element("button", { type: "button", class: "plain strong", id: "use-sample", onclick: () => desk.ask({ sample: true }) }, "Use a sample"),
    ];
  }
  if (which === "original") return [];
  const scored = state.get("scores") !== null;
  return [
    element("p", {}, "No bins are chosen yet. The refined map shows the same shapes, compared by chosen bins alone."),
    element("button", { type: "button", class: "plain strong", id: "first-best", disabled: !scored, onclick: () => desk.takeBest(BEST) }, answers.model.separable ? `Take the best ${BEST}` : `Take the ${BEST} that vary most`),
  ];
}

main();
