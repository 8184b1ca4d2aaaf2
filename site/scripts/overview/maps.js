// The three linked maps: one in the large place, the other two beside it.

import { watchSize } from "../base/dom.js";
import { Gestures } from "../map/gestures.js";
import { MapView } from "../map/map.js";
import { Scene } from "../map/scene.js";
import { arrange, swap, VIEWS } from "./arrangement.js";
import { tellReading } from "./readings.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */

export class LinkedMaps {
  /**
   * @param {Database} database
   * @param {OverviewState} state
   * @param {(text: string) => void} announce
   */
  constructor(database, state, announce) {
    this.database = database;
    this.state = state;
    this.scene = new Scene(database, state);
    this.figures = new Map([...document.querySelectorAll("figure.map")].map((node) => [node.dataset.view ?? "", node]));
    arrange(this.figures, state.get("view"));
    /** @param {string} name */
    const viewOf = (name) => new MapView(this.scene, /** @type {Found} */ (this.figures.get(name)));
    this.views = new Map(VIEWS.map((name) => [name, viewOf(name)]));
    this.scene.views = [...this.views.values()];
    /** @type {ConstructorParameters<typeof Gestures>[1]} */
    const does = {
      open: (opened) => state.set({ opened }),
      promote: (view) => state.set({ view }),
      /** @param {number} index */
      announce: (index) => announce(`${database.names[index]}, ${database.className(database.groups[index])}`),
    };
    this.gestures = new Map([...this.views].map(([name, view]) => [name, new Gestures(view, does)]));
    state.listen((changed) => {
      if (changed.has("view")) swap(this.figures, state.get("view"), this.scene);
      if (changed.has("method")) this.#tellReadings();
    });
    this.#tellReadings();
  }

  /**
   * The map in the large place.
   * @returns {MapView}
   */
  get large() {
    return /** @type {MapView} */ (this.views.get(this.state.get("view")));
  }

  async start() {
    for (const view of this.scene.views) if (!view.large) await view.start();
    watchSize(
      this.scene.views.map(({ surface }) => surface),
      () => {
        for (const view of this.scene.views) view.resize();
      },
    );
  }

  /** Draw all in the colours of the theme in use. */
  redraw() {
    for (const view of this.scene.views) view.start();
    this.#tellReadings();
  }

  #tellReadings() {
    for (const figure of this.figures.values()) tellReading(figure, this.database, this.state);
  }
}
