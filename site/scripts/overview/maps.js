// The maps of the Overview: one that is seen first, and drawn at once; and the three of the paper (Fig. 2), in charts, two of
// them beside it where the window is wide, or all of them in its place.

import { watchSize } from "../base/dom.js";
import { currentTheme } from "../base/theme.js";
import { Gestures } from "../map/gestures.js";
import { MapView } from "../map/map.js";
import { Scene } from "../map/scene.js";
import { tellReading } from "./readings.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Colors } from "../colors/colors.js" */
/** @import { MapName } from "../map/map.js" */

/** In the order in which they stand beside another. */
const LINKED = ["class", "hit", "thumbnail"];

/** Where there is room for two maps beside the one, as styles/tokens.css has it. */
const wide = window.matchMedia("(width >= 1600px) and (height >= 560px)");

export class OverviewMaps {
  /** @type {Map<string, MapView>} those of the paper that were shown */
  #linked = new Map();

  /**
   * @param {Database} database
   * @param {OverviewState} state
   * @param {Colors} colors
   * @param {(text: string) => void} announce
   */
  constructor(database, state, colors, announce) {
    this.database = database;
    this.state = state;
    this.colors = colors;
    this.announce = announce;
    this.scene = new Scene(database, state);
    const figures = [...document.querySelectorAll("figure.linked")];
    this.figures = new Map(figures.map((figure) => [figure.dataset.view ?? "", figure]));
    this.figure = document.querySelector("figure[data-slot=large]");
    this.figure.dataset.view = this.#name;
    this.main = new MapView(this.scene, this.figure, { charted: false, settled: () => this.#tellReadings() });
    /** @type {Map<MapView, Gestures>} */
    this.gestures = new Map();
    this.#watch(this.main);
    this.#arrange();
    state.listen((changed) => {
      const other = changed.has("method") && state.get("coloring")?.of !== undefined;
      if (other || ["view", "by", "pictures"].some((name) => changed.has(name))) this.#show();
      if (changed.has("method")) this.#tellReadings();
    });
    wide.addEventListener("change", () => this.start());
  }

  /** What the one map shows; it keeps to pictures while the three stand in its place. */
  get #name() {
    const view = this.state.get("view");
    const pictures = view === "three" || (view === "color" && this.state.get("pictures"));
    return /** @type {MapName} */ (pictures ? "thumbnail" : view);
  }

  /** The names of those of the paper that are shown. */
  get #beside() {
    const view = this.state.get("view");
    if (view === "three") return LINKED;
    return wide.matches && this.database.labelled ? LINKED.filter((name) => name !== view).slice(0, 2) : [];
  }

  /**
   * The map that has the room.
   * @returns {MapView}
   */
  get large() {
    return this.scene.views[0];
  }

  /** Draw the map that is seen first, and then the others. */
  async open() {
    await this.#show();
  }

  /** Draw what is not drawn yet. */
  async start() {
    this.#arrange();
    for (const view of this.scene.views) {
      view.measure();
      if (view.started && view.theme === currentTheme()) view.settle();
      else await view.start();
    }
  }

  /** Draw all in the colours of the theme in use. */
  redraw() {
    this.#tellReadings();
    this.#show();
  }

  async #show() {
    if (!(await this.colors.make())) return;
    this.main.name = this.#name;
    this.main.chosenColoring = this.state.get("coloring") ?? null;
    this.figure.dataset.view = this.#name;
    await this.start();
  }

  /** Which figures are there, and how the page is laid out for them. */
  #arrange() {
    const beside = this.#beside;
    const view = this.state.get("view");
    const three = view === "three";
    const page = document.getElementById("content");
    page.toggleAttribute("data-three", three);
    page.toggleAttribute("data-colored", view === "color");
    page.toggleAttribute("data-beside", !three && beside.length > 0);
    this.figure.hidden = three;
    for (const [name, figure] of this.figures) figure.hidden = !beside.includes(name);
    const views = beside.map((name) => this.#view(name));
    this.scene.views = three ? views : [this.main, ...views];
    this.#tellReadings();
  }

  /** @param {string} name */
  #view(name) {
    const known = this.#linked.get(name);
    if (known) return known;
    const view = new MapView(this.scene, /** @type {Found} */ (this.figures.get(name)), {
      settled: () => this.#tellReadings(),
    });
    this.#linked.set(name, view);
    this.#watch(view);
    return view;
  }

  /** @param {MapView} view */
  #watch(view) {
    const { database, state, announce } = this;
    const gestures = new Gestures(view, {
      open: (opened) => state.set({ opened }),
      announce: (index) => announce(`${database.names.at(index)}, ${database.className(database.groups[index])}`),
    });
    this.gestures.set(view, gestures);
    watchSize([view.surface], () => {
      if (this.scene.views.includes(view)) view.resize();
    });
  }

  #tellReadings() {
    for (const view of this.scene.views) tellReading(view, this.database, this.state);
  }
}
