// The Compare page: what sets two groups apart, what they share, outliers, and classes that are alike.

import { Bins } from "../database/bins.js";
import { carrySelection, follow } from "../tray/carry.js";
import { chunk } from "../base/chunks.js";
import { readView, writeView } from "../addresses/compare.js";
import { compareTables } from "../compare/tables.js";
import { GroupsView } from "../compare/groups-view.js";
import { Matrix } from "../compare/matrix.js";
import { Neighbours } from "../compare/neighbours.js";
import { Outliers } from "../compare/outliers.js";
import { Tabs } from "../compare/tabs.js";
import { Model } from "../database/model.js";
import { pageAddress } from "../base/place.js";
import { State } from "../base/state.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, watchTheme } from "../base/theme.js";
import { Tray } from "../tray/tray.js";

async function main() {
  const [overview, data, bytes, clusters] = await Promise.all(["overview", "compare", "neighbours", "clusters"].map(chunk));
  const model = new Model(overview, currentTheme);
  const neighbours = new Neighbours(model, data, bytes);
  const live = document.getElementById("live");
  const announce = (text) => {
    live.textContent = text;
  };
  // The values of all bins are large where shapes are many: they come when they are first needed.
  let loaded = null;
  const bins = () => (loaded ??= Promise.all([chunk("workbench"), chunk("bins")]).then(([work, values]) => new Bins(work, values)));
  const read = () => readView(model, data, neighbours);
  const state = new State({ ...read(), theme: currentTheme() });
  const groups = new GroupsView(model, data, clusters, neighbours, state, { bins, announce });
  const outliers = new Outliers(model, data, neighbours, state, { bins, announce });
  const matrix = new Matrix(model, data, neighbours, state, { announce });
  new Tabs(state);
  const open = (index) => follow(pageAddress("shape.html", { id: model.ids[index] }));
  new Tray(model, state, { open });
  carrySelection(model, state);
  groups.compare();
  outliers.render();
  matrix.render();
  watchTables(() => compareTables(model, data, state, { groups, outliers, matrix }));
  state.listen((changed) => {
    if (changed.has("theme") && changed.size === 1) return;
    writeView(model, state);
  });
  window.addEventListener("hashchange", () => state.set(read()));
  watchTheme(() => state.set({ theme: currentTheme() }));
  document.documentElement.dataset.ready = "";
}

main();
