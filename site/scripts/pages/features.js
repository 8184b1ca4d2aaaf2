// The Features page: all subsets of the features, the chosen one's map, and what is known of the features.

import { readFeaturesAddress, writeFeaturesAddress } from "../addresses/features.js";
import { overviewAddress } from "../addresses/overview.js";
import { Boxes } from "../features/boxes.js";
import { Card } from "../map/card.js";
import { carryAddress, carrySelection } from "../tray/carry.js";
import { drawChart } from "../base/chart.js";
import { chunk } from "../base/chunks.js";
import { Gestures } from "../map/gestures.js";
import { MapView } from "../map/map.js";
import { Model } from "../database/model.js";
import { Panel } from "../features/panel.js";
import { Ranking } from "../features/ranking.js";
import { RetrievalSection } from "../features/retrieval.js";
import { Scene } from "../map/scene.js";
import { State } from "../base/state.js";
import { subsetTables } from "../features/tables.js";
import { Subsets } from "../database/subsets.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, styleColor, watchTheme } from "../base/theme.js";
import { Tray } from "../tray/tray.js";
import { figure } from "../base/words.js";

const ROW = 24;

async function main() {
  const [overview, search] = await Promise.all([chunk("overview"), chunk("search")]);
  const subsets = new Subsets(search);
  const model = new Model(overview, currentTheme);
  const state = new State({
    ...readFeaturesAddress(subsets, model),
    pointedPlace: null,
    method: null,
    drag: window.matchMedia("(pointer: coarse)").matches ? "move" : "select",
    hidden: new Set(),
    matches: null,
    opened: null,
    pointed: null,
    pointedFrom: null,
    pointedGroup: null,
    brushing: false,
    camera: null,
    theme: currentTheme(),
  });
  const marks = () => ({
    ...search.marks[currentTheme()],
    config: model.marks.config,
    ink: styleColor("ink"),
    accent: styleColor("accent"),
    ground: styleColor("paper"),
  });
  const live = document.getElementById("live");
  const announce = (text) => {
    live.textContent = text;
  };

  const ranking = new Ranking(subsets, state, marks, announce);
  const link = overview.subsets && ((place) => overviewAddress(subsets.names(place)));
  new Panel(subsets, state, marks, link);
  const retrieval = await retrievalSection(
    overview,
    () => subsets.names(state.get("chosen")),
    (names) => state.set({ chosen: subsets.find(names) }),
  );
  watchTables(() => {
    const { title, tables } = subsetTables(model, subsets, state);
    return { title, tables: [...tables, ...(retrieval?.tables() ?? [])] };
  });
  const paint = () => {
    for (const mark of document.querySelectorAll("[data-hue]")) mark.style.background = marks().features[mark.dataset.hue];
  };
  paint();
  for (const [id, value] of [["chance", search.chance], ["chance-best", search.chanceBest]]) {
    if (subsets.labelled) document.getElementById(id).textContent = figure(value);
  }
  await ranking.start();

  // The map comes with the largest chunk of the page, so it waits for what is above it.
  state.set({ method: await shown(model, subsets, state.get("chosen")) });
  const scene = new Scene(model, state);
  const surface = document.querySelector("figure.map");
  surface.dataset.view = state.get("color");
  const map = new MapView(scene, surface);
  scene.views = [map];
  watchDrag(state);
  const open = (opened) => state.set({ opened: opened === state.get("opened") ? null : opened });
  const gestures = new Gestures(map, {
    open,
    promote: () => {},
    announce: (index) => announce(`${model.names[index]}, ${model.className(model.groups[index])}`),
  });
  watchMapKeys(map.surface, state, gestures);
  new Card(state);
  new Tray(model, state, { open });
  carrySelection(model, state);
  await map.start();
  const boxes = subsets.labelled ? new Boxes(model, subsets, state, marks) : null;
  await boxes?.start();
  const dots = subsets.labelled ? dotCharts(subsets, marks) : [];
  for (const chart of dots) await chart.start();

  watchColors(state, map);
  state.listen(async (changed) => {
    if (changed.has("chosen") || changed.has("theme")) retrieval?.render();
    if (changed.has("chosen")) {
      const chosen = state.get("chosen");
      const method = await shown(model, subsets, chosen);
      // Another may have been chosen while this one was fetched.
      if (state.get("chosen") === chosen) state.set({ method });
    }
    if (["chosen", "s", "color", "selection"].some((name) => changed.has(name))) {
      clearTimeout(main.writing);
      main.writing = setTimeout(() => writeFeaturesAddress(subsets, model, state), 250);
    }
  });
  window.addEventListener("hashchange", () => state.set(readFeaturesAddress(subsets, model)));
  watchTheme(() => {
    paint();
    ranking.start();
    map.start();
    boxes?.start();
    for (const chart of dots) chart.start();
    state.set({ theme: currentTheme() });
  });
  const observer = new ResizeObserver(() => {
    ranking.resize();
    map.resize();
    boxes?.render();
    for (const chart of dots) chart.resize();
  });
  for (const node of [ranking.scroll, map.surface, ...dots.map(({ node }) => node)]) observer.observe(node);
  document.documentElement.dataset.ready = "";
}

/** The index of a subset's map in the model. Shapes that the search left out have no place on it. */
async function shown(model, subsets, place) {
  const { rows } = subsets.data;
  const map = await subsets.map(place, model.classes.length);
  const spread = (values, none) => {
    const all = new Array(model.count).fill(none);
    for (const [index, row] of rows.entries()) all[row] = values[index];
    return all;
  };
  return model.add(rows === null ? map : { ...map, x: spread(map.x, NaN), y: spread(map.y, NaN), hit: spread(map.hit, null) }, null);
}

function watchMapKeys(surface, state, gestures) {
  surface.addEventListener("keydown", (event) => {
    if (event.key === "+" || event.key === "=") gestures.zoom(1.5);
    else if (event.key === "-") gestures.zoom(1 / 1.5);
    else if (event.key === "0") state.set({ camera: null });
    else if (event.key === "Escape") state.set({ opened: null, selection: new Set() });
    else return;
    event.preventDefault();
  });
}

/** What dragging on the map does. */
function watchDrag(state) {
  const inputs = document.querySelectorAll("#drag input");
  for (const input of inputs) {
    input.checked = input.value === state.get("drag");
    input.addEventListener("change", () => {
      state.set({ drag: input.value });
      document.body.dataset.drag = input.value;
    });
  }
  document.body.dataset.drag = state.get("drag");
}

/** Colours of the map: by class or by neighbourhood hit. */
function watchColors(state, map) {
  const inputs = document.querySelectorAll("#colors input");
  const check = () => {
    for (const input of inputs) input.checked = input.value === state.get("color");
  };
  for (const input of inputs) input.addEventListener("change", () => state.set({ color: input.value }));
  state.listen((changed) => {
    if (!changed.has("color")) return;
    check();
    map.name = state.get("color");
    map.start();
  });
  check();
}

/** The two plots of dots, with as many rows as there is data. */
function dotCharts(subsets, marks) {
  const { data } = subsets;
  const effects = data.order
    .map((feature) => data.effects.find((effect) => effect.feature === feature))
    .map((effect) => ({ ...effect, name: subsets.features[effect.feature], feature: data.hues[effect.feature] }));
  const best = Math.max(...data.spread.map(({ mean }) => mean));
  const seeds = data.spread.flatMap(({ place, hits, mean, margin, apart }) =>
    hits.map((hit) => ({ name: subsets.names(place).join(" "), hit, mean, low: mean - margin, high: mean + margin, best, apart })),
  );
  return [
    new DotChart("effect-dots", data.charts.effects, "effects", effects, effects.length, marks),
    new DotChart("seed-dots", data.charts.seeds, "seeds", seeds, data.spread.length, marks),
  ].filter(({ node }) => node !== null);
}

class DotChart {
  constructor(id, spec, name, rows, count, marks) {
    Object.assign(this, { node: document.getElementById(id), spec, name, rows, count, marks });
  }

  async start() {
    this.vega?.finalize();
    const { config, ink, bar, accent, ground } = this.marks();
    this.vega = await drawChart(this.node, this.spec, config, "svg");
    const values = { ink, bar, accent, ground };
    const known = new Set(this.spec.params.map(({ name }) => name));
    for (const [name, value] of Object.entries(values)) if (known.has(name)) this.vega.signal(name, value);
    this.vega.data(this.name, this.rows);
    await this.resize();
  }

  async resize() {
    if (!this.vega) return;
    const width = this.node.clientWidth;
    if (this.spec.params.some(({ name }) => name === "label_limit")) this.vega.signal("label_limit", width * 0.42);
    await this.vega.width(width).height(this.count * ROW + 44).runAsync();
  }
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
