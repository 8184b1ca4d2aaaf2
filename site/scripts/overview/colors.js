// What the reader colours the map by: any field of the database, a neighbourhood hit, or a bin; and what its colours are.

import { chunk, chunks } from "../base/chunks.js";
import { element, swatch } from "../base/dom.js";
import { Finder } from "../base/finder.js";
import { binName } from "../bins-kit/bin-name.js";
import { Bins } from "../database/bins.js";
import { Fields } from "../database/fields.js";
import { binColoring, fieldColoring } from "../map/coloring.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Coloring, Legend, Line } from "../map/coloring.js" */

const BIN = "bin:";

export class Colors {
  /** @type {Coloring | null} what the map is coloured by now, if the reader chose it */
  coloring = null;

  /** @type {Promise<Bins> | null} */
  #bins = null;
  /** @type {Promise<Fields> | null} */
  #fields = null;

  /**
   * @param {Database} database
   * @param {OverviewState} state
   */
  constructor(database, state) {
    this.database = database;
    this.state = state;
    this.choice = document.getElementById("color-by");
    this.finder = /** @type {Found} */ (document.querySelector("[data-finder=color]"));
    this.legend = document.getElementById("color-legend");
    this.keys = [...this.choice.options].map(({ value }) => value);
    this.choice.addEventListener("change", () => {
      state.set({ view: "color", by: this.choice.value });
      if (this.choice.value === BIN) document.getElementById("color-search").focus();
    });
  }

  /** Whether the reader's own choice colours the map. */
  get chosen() {
    return this.state.get("view") === "color";
  }

  /** What is chosen, or the first there is: an address may name what is not there. */
  get by() {
    const by = this.state.get("by");
    return this.keys.includes(by) || by.startsWith(BIN) ? by : this.keys[0];
  }

  /** Make what the state asks for; the answer is whether it is still asked for. */
  async choose() {
    const { by, chosen } = this;
    this.#showControls();
    const coloring = chosen ? await this.#make(by) : null;
    if (by !== this.by || chosen !== this.chosen) return false;
    this.coloring = coloring;
    this.#showLegend();
    return true;
  }

  #showControls() {
    const { by, chosen } = this;
    const bin = by.startsWith(BIN);
    this.choice.value = bin ? BIN : by;
    this.choice.parentElement.hidden = !chosen;
    this.finder.hidden = !(chosen && bin);
    if (chosen && bin) this.#loadBins();
  }

  /**
   * @param {string} by
   * @returns {Promise<Coloring | null>}
   */
  async #make(by) {
    const { database } = this;
    if (by.startsWith(BIN)) {
      const bins = await this.#loadBins();
      const column = bins.names.indexOf(by.slice(BIN.length));
      return column < 0 ? null : binColoring(database, bins, column);
    }
    this.#fields ??= chunks("fields", "hierarchy").then((loaded) => new Fields(database, ...loaded));
    const field = (await this.#fields).byKey.get(by);
    return field ? fieldColoring(database, field) : null;
  }

  #loadBins() {
    this.#bins ??= Promise.all([chunk("workbench"), chunk("bins")]).then(([work, values]) => {
      const bins = new Bins(work, values);
      new Finder("color-search", "color-found", {
        find: (text) => bins.find(text),
        label: (column) => binName(bins, column),
        choose: (column) => this.state.set({ view: "color", by: `${BIN}${bins.names[column]}` }),
      });
      return bins;
    });
    return this.#bins;
  }

  #showLegend() {
    const { coloring, legend } = this;
    legend.hidden = !coloring?.legend;
    if (!coloring?.legend) {
      legend.replaceChildren();
      return;
    }
    legend.replaceChildren(
      element("h2", { dir: "auto" }, coloring.title),
      coloring.note ? element("p", { class: "note" }, coloring.note) : "",
      ...rampOf(coloring.legend),
      element(
        "ul",
        {},
        coloring.legend.lines.map((line) => element("li", {}, this.#line(line))),
      ),
    );
  }

  /** @param {Line} line */
  #line({ name, look, shapes }) {
    /** @param {number[] | null} pointedShapes */
    const point = (pointedShapes) => () => this.state.set({ pointedShapes });
    return element(
      "button",
      {
        type: "button",
        title: `Select ${name}`,
        onclick: () => this.state.set({ selection: new Set(shapes), pointedShapes: null }),
        onpointerenter: point(shapes),
        onpointerleave: point(null),
      },
      swatch(look.symbol, look.color),
      element("span", { class: "name", dir: "auto" }, name),
      element("span", { class: "size" }, String(shapes.length)),
    );
  }
}

/** @param {Legend} legend */
function rampOf({ ramp }) {
  if (ramp === null || ramp.texts.length === 0) return [];
  const scale = element("span", { class: "ramp", role: "img", "aria-label": "from low to high" });
  scale.style.background = `linear-gradient(to right, ${ramp.colors.join(", ")})`;
  return [
    scale,
    element(
      "p",
      { class: "ramp-texts" },
      ramp.texts.map((text) => element("span", {}, text)),
    ),
  ];
}
