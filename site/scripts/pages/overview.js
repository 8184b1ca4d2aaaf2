// The Overview: three linked maps, the classes, the tray, the card and the panel of one shape.

import { readAddress, writeAddress } from "../addresses/overview.js";
import { chunk } from "../base/chunks.js";
import { element } from "../base/dom.js";
import { delayed, openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { Database } from "../database/database.js";
import { Search } from "../database/search.js";
import { Card } from "../map/card.js";
import { Gestures } from "../map/gestures.js";
import { MapView } from "../map/map.js";
import { dragging, NOTHING_POINTED, Scene } from "../map/scene.js";
import { mapTables } from "../map/tables.js";
import { arrange, swap, VIEWS } from "../overview/arrangement.js";
import { ClassList } from "../overview/classes.js";
import { trayHint, watchControls, watchKeys } from "../overview/controls.js";
import { Detail } from "../overview/detail.js";
import { FeatureChoice, subsetMethod } from "../overview/feature-choice.js";
import { watchIntroduction } from "../overview/introduction.js";
import { reading } from "../overview/readings.js";
import { carrySelection } from "../tray/carry.js";
import { Tray } from "../tray/tray.js";

async function main() {
  const database = new Database(await chunk("overview"), currentTheme);
  const { state, announce, ready } = await openPage({
    read: () => addressed(database),
    values: { ...NOTHING_POINTED, ...dragging(), matches: null },
  });
  const scene = new Scene(database, state);
  const figures = new Map([...document.querySelectorAll("figure.map")].map((node) => [node.dataset.view, node]));
  arrange(figures, state.get("view"));
  const views = new Map(VIEWS.map((name) => [name, new MapView(scene, figures.get(name))]));
  scene.views = [...views.values()];
  const open = (opened) => state.set({ opened });
  const promote = (name) => state.set({ view: name });
  const gestures = new Map();
  for (const [name, view] of views) {
    const announceShape = (index) =>
      announce(`${database.names[index]}, ${database.className(database.groups[index])}`);
    gestures.set(name, new Gestures(view, { open, promote, announce: announceShape }));
  }

  // Pictures beside the map point at their shape on it.
  const point = (pointed) => state.set({ pointed, pointedFrom: views.get(state.get("view")) });
  const classes = new ClassList(database, state);
  const detail = new Detail(database, state, { point });
  const search = new Search(database, state, announce);
  new Card(state);
  new Tray(database, state, { open, point, hint: trayHint(), cover: (height) => scene.cover(height) });
  carrySelection(database, state);
  watchTables(() => mapTables(database, state));
  if (database.data.subsets) new FeatureChoice(database, state);
  watchIntroduction();
  watchControls(database, state, gestures);
  watchKeys(state, gestures);

  const readings = () => {
    for (const [name, figure] of figures) {
      const notes = database.methods.map(({ note }) => element("span", {}, note));
      figure
        .querySelector(".reading")
        .replaceChildren(...notes, element("span", { class: "shown" }, reading(name, database, state)));
    }
  };
  const write = delayed(() => writeAddress(database, state));
  state.listen((changed) => {
    if (changed.has("view")) swap(figures, state.get("view"), scene);
    if (changed.has("method")) readings();
    if (["method", "view", "hidden", "selection", "opened", "query", "camera"].some((name) => changed.has(name)))
      write();
  });

  readings();
  // What is seen first is drawn first.
  await views.get(state.get("view")).start();
  await classes.start();
  for (const view of scene.views) if (!view.large) await view.start();
  const observer = new ResizeObserver(() => {
    for (const view of scene.views) view.resize();
    classes.resize();
  });
  for (const view of scene.views) observer.observe(view.surface);
  observer.observe(classes.node);
  if (state.get("query") !== "") await search.run();
  if (state.get("opened") !== null) await detail.show();
  ready({
    redraw() {
      for (const view of scene.views) view.start();
      classes.start();
      readings();
    },
  });
}

/** What the address says, with the map of its features loaded. */
async function addressed(database) {
  const { features, ...values } = readAddress(database);
  const method = features.length > 0 ? await subsetMethod(database, features) : null;
  return method === null ? values : { ...values, method };
}

main();
