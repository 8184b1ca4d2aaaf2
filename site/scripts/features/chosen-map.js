// The map of the chosen subset: it follows the choice, and has the gestures of all maps.

import { watchSize } from "../base/dom.js";
import { chosenColors } from "../colors/choice.js";
import { loadAllBins } from "../database/level-bins.js";
import { TrueNeighbours } from "../database/true-neighbours.js";
import { Card } from "../map/card.js";
import { watchDragging } from "../map/dragging.js";
import { Gestures } from "../map/gestures.js";
import { watchLines } from "../map/lines.js";
import { MapView } from "../map/map.js";
import { dragging, NOTHING_POINTED, Scene } from "../map/scene.js";
import { watchMapKeys } from "./controls.js";
import { shown } from "./subset-map.js";

/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { State } from "../base/state.js" */
/** @import { Colors } from "../colors/colors.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Subsets } from "../database/subsets.js" */
/** @import { MapValues } from "../map/scene.js" */

/** What the state has of the map at first. */
export function nothingShown() {
  return {
    ...NOTHING_POINTED,
    ...dragging(),
    method: null,
    hidden: new Set(),
    matches: null,
    coloring: null,
    alike: null,
  };
}

export class ChosenMap {
  /** @type {MapView} */
  view;
  /** @type {Gestures} */
  gestures;
  /** @type {Colors} */
  colors;

  /**
   * @param {Database} database
   * @param {Subsets} subsets
   * @param {FeaturesState} state
   * @param {(text: string) => void} announce
   */
  constructor(database, subsets, state, announce) {
    this.database = database;
    this.subsets = subsets;
    this.state = state;
    this.announce = announce;
  }

  /**
   * Mark a shape, or no longer.
   * @param {number} shape
   */
  toggle(shape) {
    this.state.set({ opened: shape === this.state.get("opened") ? null : shape });
  }

  /** Fetch the map and draw it. */
  async open() {
    const { database, subsets, state, announce } = this;
    state.set({ method: await shown(database, subsets, state.get("chosen")) });
    const scene = new Scene(database, state);
    // Of a sample nobody can be shown who is most alike among all shapes.
    if (subsets.data.rows === null)
      scene.alike = new TrueNeighbours(database, loadAllBins, () => state.set({ alike: {} }));
    const figure = document.querySelector("figure.map");
    this.view = new MapView(scene, figure, { charted: false });
    scene.views = [this.view];
    watchDragging(state);
    watchLines(state);
    this.gestures = new Gestures(this.view, {
      open: (shape) => this.toggle(shape),
      announce: (index) => announce(`${database.names.at(index)}, ${database.className(database.groups[index])}`),
    });
    watchMapKeys(this.view.surface, state, this.gestures);
    this.colors = chosenColors(database, state);
    state.listen((changed) => changed.has("color") && this.start());
    new Card(/** @type {State<MapValues & Shared>} */ (/** @type {State} */ (state)));
    state.listen((changed) => changed.has("chosen") && this.#follow(changed.has("camera")));
    await this.start();
    watchSize([this.view.surface], () => this.view.resize());
  }

  /** Give the marks to a chart, once the page is drawn. */
  async chart() {
    this.view.charted = true;
    await this.start();
  }

  /** Draw with the colours that are asked for, of the theme in use. */
  async start() {
    if (!(await this.colors.make())) return;
    this.view.colorBy(this.state.get("color"), this.state.get("coloring") ?? null);
    await this.view.start();
  }

  /** @param {boolean} aimed whether the part in view was said with the choice */
  async #follow(aimed) {
    const chosen = this.state.get("chosen");
    const method = await shown(this.database, this.subsets, chosen);
    // Another may have been chosen while this one was fetched.
    if (this.state.get("chosen") !== chosen) return;
    const camera = this.state.get("camera");
    this.state.set(aimed && camera ? { method, camera: { ...camera } } : { method });
    if (this.state.get("coloring")?.of) await this.start();
  }
}
