// The shape itself: its picture, and in 3D where a reader asks for it, in its own colours, as clay or coloured by a bin.

import { chunk, modelBytes } from "../base/chunks.js";
import { calm, element } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { binName, exactly } from "../bins-kit/bin-name.js";
import { Legend } from "../bins-kit/legend.js";
import { UNPAINTED } from "../bins-kit/on-surface.js";
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
    this.looks = document.getElementById("looks");
    /** @param {number} shape */
    const load = async (shape) => modelBytes((await chunk("selection")).models?.[shape] ?? "");
    this.stage = new Stage(this.node, { database, load: models ? load : null, keys: "turn-keys" });
    state.listen((changed) => {
      if (["shape", "bin", "clay", "theme"].some((name) => changed.has(name))) this.render();
      if (changed.has("bin") && state.get("bin") !== null) this.#bringIntoSight();
    });
    this.looks.addEventListener("change", () => state.set({ clay: this.looks.querySelector("[value=clay]").checked }));
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

  /** The shape that was rendered last. @type {number | null} */
  #shown = null;

  render() {
    const { database, looks } = this;
    const bins = this.#known?.bins;
    const shape = this.state.get("shape");
    if (shape === null) return;
    const column = this.#column;
    if (this.#known) this.#tell(this.#known, shape, column);
    const dimension = column === null || !bins ? null : bins.dimensionOf(column);
    const clay = this.state.get("clay");
    // Who asks for a bin asks for its colours, and who asks for clay for the model that has it.
    if (dimension !== null || clay) this.stage.asked = true;
    // what a model is drawn in can be chosen where there is a choice; the choice stays in place while it is made
    if (shape !== this.#shown || dimension !== null) looks.hidden = true;
    this.#shown = shape;
    for (const input of looks.querySelectorAll("input")) input.checked = (input.value === "clay") === clay;
    this.stage.show(shape, {
      label: `${database.names.at(shape)} in 3D${dimension === null ? "" : `, values of ${this.state.get("bin")}`}`,
      paint: async (solid) => {
        this.#paint ??= new Paint(await chunk("selection"));
        return dimension === null ? this.#paint.plain(solid, { clay }) : this.#paint.values(solid, dimension);
      },
      shown: ({ colored }) => {
        looks.hidden = dimension !== null || !colored;
      },
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
    const dimension = bins.dimensionOf(column);
    words.append(
      element("p", {}, binName(bins, column)),
      dimension === null ? element("p", { class: "quiet" }, UNPAINTED) : "",
      exactly(bins, column),
      element(
        "p",
        { class: "actions" },
        action("Find shapes with as much of it", () => comparison.compareBins([column])),
        element(
          "a",
          { href: pageAddress("bins.html", { bin: bins.names[column], id: database.ids.at(shape) }) },
          "Open on the Bins page",
        ),
        action(dimension === null ? "Close" : "Plain again", () => state.set({ bin: null })),
      ),
    );
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
