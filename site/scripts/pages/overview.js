// The Overview: three linked maps, the classes, the tray, the card and the panel of one shape.

import { readAddress, writeAddress } from "../addresses/overview.js";
import { Card } from "../map/card.js";
import { carrySelection } from "../tray/carry.js";
import { ClassList } from "../overview/classes.js";
import { chunk } from "../base/chunks.js";
import { Detail } from "../overview/detail.js";
import { calm, element } from "../base/dom.js";
import { FeatureChoice, subsetMethod } from "../overview/feature-choice.js";
import { Gestures } from "../map/gestures.js";
import { watchIntroduction } from "../overview/introduction.js";
import { MapView } from "../map/map.js";
import { mapTables } from "../map/tables.js";
import { Model } from "../database/model.js";
import { Scene } from "../map/scene.js";
import { Search } from "../database/search.js";
import { State } from "../base/state.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, watchTheme } from "../base/theme.js";
import { Tray } from "../tray/tray.js";

const VIEWS = ["class", "hit", "thumbnail"];

async function main() {
  const model = new Model(await chunk("overview"), currentTheme);
  const touch = window.matchMedia("(pointer: coarse)").matches;
  const state = new State({
    ...(await addressed(model)),
    drag: touch ? "move" : "select",
    matches: null,
    pointed: null,
    pointedFrom: null,
    pointedGroup: null,
    brushing: false,
    theme: currentTheme(),
  });
  const scene = new Scene(model, state);
  const live = document.getElementById("live");
  const announce = (text) => {
    live.textContent = text;
  };

  const figures = new Map([...document.querySelectorAll("figure.map")].map((node) => [node.dataset.view, node]));
  arrange(figures, state.get("view"));
  const views = new Map(VIEWS.map((name) => [name, new MapView(scene, figures.get(name))]));
  scene.views = [...views.values()];
  const open = (opened) => state.set({ opened });
  const promote = (name) => state.set({ view: name });
  const gestures = new Map();
  for (const [name, view] of views) {
    const announceShape = (index) => announce(`${model.names[index]}, ${model.className(model.groups[index])}`);
    gestures.set(name, new Gestures(view, { open, promote, announce: announceShape }));
  }

  // Pictures beside the map point at their shape on it.
  const point = (pointed) => state.set({ pointed, pointedFrom: views.get(state.get("view")) });
  const classes = new ClassList(model, state);
  const detail = new Detail(model, state, { point });
  const search = new Search(model, state, announce);
  new Card(state);
  new Tray(model, state, { open, point, hint: trayHint(touch), cover: (height) => scene.cover(height) });
  carrySelection(model, state);
  watchTables(() => mapTables(model, state));
  if (model.data.subsets) new FeatureChoice(model, state);
  watchIntroduction();
  watchControls(model, state, scene, gestures);
  watchKeys(state, gestures);

  const readings = () => {
    for (const [name, figure] of figures) {
      const notes = model.methods.map(({ note }) => element("span", {}, note));
      figure.querySelector(".reading").replaceChildren(...notes, element("span", { class: "shown" }, reading(name, model, state)));
    }
  };
  state.listen((changed) => {
    if (changed.has("view")) swap(figures, state.get("view"), scene);
    if (changed.has("method")) readings();
    if (["method", "view", "hidden", "selection", "opened", "query", "camera"].some((name) => changed.has(name))) {
      clearTimeout(main.writing);
      main.writing = setTimeout(() => writeAddress(model, state), 250);
    }
  });
  window.addEventListener("hashchange", async () => state.set(await addressed(model)));
  watchTheme(() => {
    for (const view of scene.views) view.start();
    classes.start();
    readings();
    state.set({ theme: currentTheme() });
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
  document.documentElement.dataset.ready = "";
}

function trayHint(touch) {
  return touch
    ? "Tap a shape to see what is known of it. With Select, drag a box to collect shapes here."
    : "Drag a box on a map to collect shapes here. Click a shape to see what is known of it.";
}

/** What the address says, with the map of its features loaded. */
async function addressed(model) {
  const { features, ...values } = readAddress(model);
  const method = features.length > 0 ? await subsetMethod(model, features) : null;
  return method === null ? values : { ...values, method };
}

/** Put one map in the large place; the other two keep their order. */
function arrange(figures, large) {
  const slots = ["left", "right"];
  for (const name of VIEWS) figures.get(name).dataset.slot = name === large ? "large" : slots.shift();
}

/** The same, with a short movement that shows which map went where. */
function swap(figures, large, scene) {
  const before = new Map([...figures].map(([name, node]) => [name, node.getBoundingClientRect()]));
  const focused = document.activeElement.classList.contains("surface");
  arrange(figures, large);
  for (const view of scene.views) view.resize();
  if (focused) figures.get(large).querySelector(".surface").focus({ preventScroll: true });
  if (calm()) return;
  for (const [name, node] of figures) {
    const [from, to] = [before.get(name), node.getBoundingClientRect()];
    if (from.width === to.width && from.left === to.left) continue;
    const start = `translate(${from.left - to.left}px, ${from.top - to.top}px) scale(${from.width / to.width}, ${from.height / to.height})`;
    node.animate([{ transform: start, opacity: 0.4 }, { transform: "none", opacity: 1 }], { duration: 220, easing: "ease-out" });
  }
}

/** How to read one map, beside its title. */
function reading(name, model, state) {
  const method = model.methods[state.get("method")];
  if (name === "class") return [method.note];
  if (name === "thumbnail") return ["Dots are shapes whose picture would cover another: zoom in to see them."];
  if (!model.labelled) return ["Without labels there is no neighbourhood hit."];
  const scale = element("span", { class: "ramp", role: "img", "aria-label": "from red to yellow" });
  scale.style.background = `linear-gradient(to right, ${model.marks.hit.join(", ")})`;
  return [`Of a shape’s ${method.neighbours} nearest neighbours, this share is of its ${model.data.standIn ? "cluster" : "class"}: 0 `, scale, " 1"];
}

function watchControls(model, state, scene, gestures) {
  const methods = document.getElementById("methods");
  const drag = document.getElementById("drag");
  const check = (group, value) => {
    for (const input of group.querySelectorAll("input")) input.checked = input.value === value;
  };
  const show = () => {
    check(methods, model.methods[model.methods[state.get("method")].base].key);
    check(drag, state.get("drag"));
    document.body.dataset.drag = state.get("drag");
    document.body.toggleAttribute("data-zoomed", state.get("camera") !== null);
  };
  methods.addEventListener("change", (event) => {
    state.set({ method: model.methods.findIndex(({ key }) => key === event.target.value) });
  });
  drag.addEventListener("change", (event) => state.set({ drag: event.target.value }));
  for (const button of document.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => zoom(button.dataset.zoom, state, gestures));
  }
  for (const button of document.querySelectorAll(".promote")) {
    button.addEventListener("click", () => state.set({ view: button.dataset.view }));
  }
  state.listen((changed) => {
    if (changed.has("method") || changed.has("drag") || changed.has("camera")) show();
  });
  show();
}

function zoom(how, state, gestures) {
  if (how === "fit") state.set({ camera: null });
  else gestures.get(state.get("view")).zoom(how === "in" ? 1.5 : 1 / 1.5);
}

function watchKeys(state, gestures) {
  const zooms = { "+": "in", "=": "in", "-": "out", 0: "fit" };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (document.querySelector("dialog[open]")) return;
    if (event.key === "Escape") {
      escape(state);
      return;
    }
    if (event.target instanceof HTMLInputElement && event.target.type === "search") return;
    if (["1", "2", "3"].includes(event.key)) state.set({ view: VIEWS[event.key - 1] });
    else if (event.key in zooms) zoom(zooms[event.key], state, gestures);
    else if (event.key === "/") document.getElementById("search").focus();
    else return;
    event.preventDefault();
  });
}

/** One press takes back the last thing that is open: the panel, then the search, then the selection. */
function escape(state) {
  if (state.get("opened") !== null) state.set({ opened: null });
  else if (state.get("query") !== "") state.set({ query: "" });
  else state.set({ selection: new Set() });
}

main();
