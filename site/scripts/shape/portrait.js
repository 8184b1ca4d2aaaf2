// The shape itself: its picture, and in 3D where a reader asks for it, as plain clay or coloured by a bin.

import { chunk, modelBytes } from "../base/chunks.js";
import { calm, element } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { binName, exactly } from "../bins-kit/bin-name.js";
import { Legend } from "../bins-kit/legend.js";
import { Stage } from "../bins-kit/stage.js";
import { Paint } from "../viewer/paint.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Comparison } from "./comparison.js" */

export class Portrait {
  /** @type {Paint | null} */
  #paint = null;
  /** @type {{ bins: Bins, comparison: Comparison, legend: Legend } | null} what bins need, once they are loaded */
  #known = null;

  /**
   * @param {Database} database
   * @param {ShapeState} state
   * @param {{ models: boolean }} site whether it has 3D data
   */
  constructor(database, state, { models }) {
    this.database = database;
    this.state = state;
    this.node = document.getElementById("stage");
    this.words = document.getElementById("painted");
    /** @param {number} shape */
    const load = async (shape) => modelBytes((await chunk("selection")).models?.[shape] ?? "");
    this.stage = new Stage(this.node, { database, load: models ? load : null, keys: "turn-keys" });
    state.listen((changed) => {
      if (["shape", "bin", "theme"].some((name) => changed.has(name))) this.render();
      if (changed.has("bin") && state.get("bin") !== null) this.#bringIntoSight();
    });
  }

  /**
   * Bins can be shown from now on.
   * @param {Bins} bins
   * @param {Chunk.Selection} selection
   * @param {Comparison} comparison
   */
  know(bins, selection, comparison) {
    this.#known = { bins, comparison, legend: new Legend(selection) };
    if (this.state.get("bin") !== null) this.render();
  }

  /** The column of the bin that is painted; null for none. */
  get #column() {
    const column = this.#known?.bins.names.indexOf(this.state.get("bin") ?? "") ?? -1;
    return column < 0 ? null : column;
  }

  render() {
    const { database } = this;
    const bins = this.#known?.bins;
    const shape = this.state.get("shape");
    if (shape === null) return;
    const column = this.#column;
    if (this.#known) this.#tell(this.#known, shape, column);
    // Who asks for a bin asks for 3D.
    if (column !== null) this.stage.asked = true;
    this.stage.show(shape, {
      label: `${database.names[shape]} in 3D${column === null || !bins ? "" : `, values of ${bins.names[column]}`}`,
      paint: async (solid) => {
        this.#paint ??= new Paint(await chunk("selection"));
        const dimension = column === null || !bins ? null : bins.dimensionOf(column);
        return dimension === null ? this.#paint.plain(solid) : this.#paint.values(solid, dimension);
      },
      reason: column === null || !bins || bins.isShare(column) ? null : "This feature has no values on the surface.",
    });
  }

  /**
   * @param {{ bins: Bins, comparison: Comparison, legend: Legend }} known
   * @param {number} shape
   * @param {number | null} column
   */
  #tell({ bins, comparison, legend }, shape, column) {
    const { database, state, words } = this;
    words.replaceChildren();
    if (column === null) {
      legend.clear();
      return;
    }
    /**
     * @param {string} text
     * @param {() => void} onclick
     */
    const action = (text, onclick) => element("button", { type: "button", class: "plain", onclick }, text);
    words.append(
      element("p", {}, binName(bins, column)),
      exactly(bins, column),
      element(
        "p",
        { class: "actions" },
        action("Find shapes with as much of it", () => comparison.compareBins([column])),
        element(
          "a",
          { href: pageAddress("bins.html", { bin: bins.names[column], id: database.ids[shape] }) },
          "Open on the Bins page",
        ),
        action("Plain again", () => state.set({ bin: null })),
      ),
    );
    const dimension = bins.dimensionOf(column);
    if (dimension === null) legend.clear();
    else legend.show(legend.selection.dimensions[dimension], bins.binOf(column));
  }

  /** On a narrow window the histograms stand far below the shape that they colour. */
  #bringIntoSight() {
    const { top, bottom } = this.node.getBoundingClientRect();
    if (bottom < 80 || top > window.innerHeight - 80)
      this.node.scrollIntoView({ behavior: calm() ? "instant" : "smooth", block: "start" });
  }
}
