// The two maps: of all bins of the features in use, and of the chosen bins. Each is made while one looks.

import { pause, watchSize } from "../base/dom.js";
import { currentTheme } from "../base/theme.js";
import { Database } from "../database/database.js";
import { TrueNeighbours } from "../database/true-neighbours.js";
import { Gestures } from "../map/gestures.js";
import { watchLines } from "../map/lines.js";
import { LiveScene } from "../map/live-scene.js";
import { MapView } from "../map/map.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Colors } from "../colors/colors.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Which } from "./desk.js" */

/** @type {Which[]} */
const WHICH = ["original", "refined"];

export class WorkMaps {
  /**
   * @param {Chunk.Overview} overview
   * @param {Database} database
   * @param {WorkState} state
   * @param {Bins} bins
   * @param {Colors} colors
   * @param {(text: string) => void} announce
   */
  constructor(overview, database, state, bins, colors, announce) {
    this.state = state;
    this.colors = colors;
    // Each map has a database of its own: the same shapes, one layout.
    const methods = overview.methods.slice(0, 1);
    const scenes = WHICH.map(
      (which) => new LiveScene(new Database({ ...overview, methods }, currentTheme), state, `${which}Camera`),
    );
    /** @type {Record<Which, LiveScene>} */
    this.scenes = { original: scenes[0], refined: scenes[1] };
    for (const scene of scenes)
      scene.alike = new TrueNeighbours(
        database,
        () => Promise.resolve(bins),
        () => state.set({ alike: {} }),
      );
    watchLines(state);
    this.views = scenes.map((scene, place) => {
      const figure = document.querySelector(`figure[data-map="${WHICH[place]}"]`);
      const covered = () =>
        state.get(`${WHICH[place]}Map`) === null && state.get(`${WHICH[place]}Status`).kind === "none";
      const view = new MapView(scene, figure, { charted: false, covered });
      scene.views = [view];
      return view;
    });
    /** @type {ConstructorParameters<typeof Gestures>[1]} */
    const does = {
      open: (shape) => this.toggle(shape),
      announce: (index) => announce(`${database.names.at(index)}, ${database.className(database.groups[index])}`),
    };
    this.gestures = new Map(this.views.map((view) => [view.surface, new Gestures(view, does)]));
    state.listen((changed) => {
      const made = ["originalMap", "refinedMap", "originalFaith", "refinedFaith"].some((name) => changed.has(name));
      if (changed.has("color") || (made && state.get("coloring")?.of)) this.redraw();
    });
  }

  /**
   * Mark a shape on both maps, or no longer.
   * @param {number} shape
   */
  toggle(shape) {
    this.state.set({ opened: shape === this.state.get("opened") ? null : shape });
  }

  zoomToSelection() {
    for (const gestures of this.gestures.values()) gestures.zoomToSelection();
  }

  async start() {
    await this.redraw();
    watchSize(
      this.views.map(({ surface }) => surface),
      () => {
        for (const view of this.views) view.resize();
      },
    );
  }

  /** Give the marks to charts, once the page is drawn: these need the largest script of all. */
  async chart() {
    for (const view of this.views) {
      await pause();
      view.charted = true;
      await view.start();
    }
  }

  /** Draw with the colours that are asked for, of the theme in use. */
  async redraw() {
    if (!(await this.colors.make())) return;
    for (const view of this.views) {
      await pause();
      if (this.state.get("coloring")?.of) await view.database.methods[0].know?.();
      view.colorBy(this.state.get("color"), this.state.get("coloring") ?? null);
      await view.start();
    }
  }
}
