// The shape itself: its picture, and in 3D where a reader asks for it, as plain clay or coloured by a bin.

import { chunk, modelBytes } from "../base/chunks.js";
import { calm, element } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { Legend } from "../bins-kit/legend.js";
import { dimensionOf } from "../bins-kit/look.js";
import { Stage } from "../bins-kit/stage.js";
import { Paint } from "../viewer/paint.js";
import { hue } from "./hue.js";

export class Portrait {
  #paint = null;

  /** `models` is whether the site has 3D data. */
  constructor(database, state, { models }) {
    this.database = database;
    this.state = state;
    this.node = document.getElementById("stage");
    this.words = document.getElementById("painted");
    const load = models ? async (shape) => modelBytes((await chunk("selection")).models[shape]) : null;
    this.stage = new Stage(this.node, { database, load, keys: "turn-keys" });
    state.listen((changed) => {
      if (["shape", "bin", "theme"].some((name) => changed.has(name))) this.render();
      if (changed.has("bin") && state.get("bin") !== null) this.#bringIntoSight();
    });
  }

  /** Bins can be shown from now on. */
  know(bins, selection, comparison) {
    this.bins = bins;
    this.comparison = comparison;
    this.legend = new Legend(selection);
    if (this.state.get("bin") !== null) this.render();
  }

  /** The column of the bin that is painted; null for none. */
  get #column() {
    const column = this.bins ? this.bins.names.indexOf(this.state.get("bin")) : -1;
    return column < 0 ? null : column;
  }

  render() {
    const { database, bins } = this;
    const shape = this.state.get("shape");
    if (shape === null) return;
    const column = this.#column;
    if (bins) this.#tell(shape, column);
    // Who asks for a bin asks for 3D.
    if (column !== null) this.stage.asked = true;
    this.stage.show(shape, {
      label: `${database.names[shape]} in 3D${column === null ? "" : `, values of ${bins.names[column]}`}`,
      paint: async (solid) => {
        this.#paint ??= new Paint(await chunk("selection"));
        return column === null ? this.#paint.plain(solid) : this.#paint.values(solid, dimensionOf(column, bins));
      },
      reason: column === null || bins.isShare(column) ? null : "This feature has no values on the surface.",
    });
  }

  #tell(shape, column) {
    const { bins, legend, database, state, words } = this;
    words.replaceChildren();
    if (column === null) {
      legend.clear();
      return;
    }
    /** @param {string} text */
    const action = (text, onclick) => element("button", { type: "button", class: "plain", onclick }, text);
    words.append(
      element(
        "p",
        {},
        hue(bins.color(column)),
        element("b", {}, element("bdi", {}, bins.names[column])),
        " ",
        bins.sentence(column),
      ),
      element(
        "p",
        { class: "actions" },
        action("Find shapes with as much of it", () => this.comparison.compareBins([column])),
        element(
          "a",
          { href: pageAddress("bins.html", { bin: bins.names[column], id: database.ids[shape] }) },
          "Open on the Bins page",
        ),
        action("Plain again", () => state.set({ bin: null })),
      ),
    );
    const dimension = dimensionOf(column, bins);
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
