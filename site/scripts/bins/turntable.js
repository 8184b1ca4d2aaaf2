// Any bin on any shape, to be turned.

import { modelBytes } from "../base/chunks.js";
import { element } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { styleColor } from "../base/theme.js";
import { pictured, shapeLine } from "../bins-kit/look.js";
import { showingBin } from "../bins-kit/on-surface.js";
import { Stage } from "../bins-kit/stage.js";
import { loadAllBins } from "../database/level-bins.js";
import { findShapes } from "../database/shape-finder.js";
import { Plot } from "../map/plot.js";
import { Paint } from "../viewer/paint.js";

/** @import { BinsState } from "../addresses/bins.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Pointing } from "../map/pointing.js" */

/** Of the most that any shape has of a bin, the part with which one still shows it. */
const SHOWS = 0.5;

export class Turntable {
  /**
   * @param {Database} database
   * @param {Bins} bins
   * @param {Chunk.Selection} selection
   * @param {BinsState} state
   * @param {{ pointing: Pointing, announce: (text: string) => void }} parts
   */
  constructor(database, bins, selection, state, { pointing, announce }) {
    this.database = database;
    this.bins = bins;
    this.selection = selection;
    this.state = state;
    this.announce = announce;
    const { models } = selection;
    const load = models && ((/** @type {number} */ index) => modelBytes(models[index]));
    this.stage = new Stage(document.getElementById("stage"), { database, load, keys: "turn-keys" });
    this.paint = new Paint(selection);
    this.name = document.getElementById("turn-name");
    this.#watchReadings();
    this.#watchShapes();
    this.#makePick(pointing);
    state.listen((changed) => {
      if (["bin", "group", "shape", "reading"].some((name) => changed.has(name))) this.render();
      if (!changed.has("theme")) return;
      this.#tellName();
      this.pick.draw();
    });
  }

  /** The shape that is shown: the one that was chosen, or what shows the bin best. */
  get shape() {
    const [shape, bin] = [this.state.get("shape"), this.state.get("bin")];
    if (shape === "least") return this.#extreme(bin, -1);
    if (shape === "most") return this.#extreme(bin, 1);
    if (shape !== null) return shape;
    const most = this.#extreme(bin, 1);
    const [first] = pictured(this.selection, this.database, bin, this.state.get("group"));
    return first && this.#part(first.share) >= SHOWS ? first.shape : most;
  }

  /** @type {Plot} */
  pick;
  /** @type {{ column: number, least: number, most: number } | null} */
  #extremes = null;

  /**
   * The first shape with the most (1) or the least (-1) of a bin among those that are known; kept, since every mark of the
   * map asks for it.
   * @param {number} column
   * @param {number} sign
   */
  #extreme(column, sign) {
    let known = this.#extremes;
    if (known?.column !== column) {
      const own = this.bins.column(column);
      const [least, most] = own.reduce(
        ([low, high], value, row) => [value < own[low] ? row : low, value > own[high] ? row : high],
        [0, 0],
      );
      known = { column, least: this.bins.shapeOf(least), most: this.bins.shapeOf(most) };
      this.#extremes = known;
    }
    return sign > 0 ? known.most : known.least;
  }

  start() {
    this.render();
  }

  /** The map of all shapes, or of those whose values are known and the one that is shown. */
  #shown() {
    const [map] = this.database.methods;
    const { sample } = this.bins;
    if (sample === null) return map;
    const rows = this.bins.rowOf(this.shape) < 0 ? [...sample, this.shape] : sample;
    /** @param {ArrayLike<number>} values */
    const of = (values) => Float64Array.from(rows, (shape) => values[shape]);
    return { x: of(map.x), y: of(map.y), rows };
  }

  async #tellName() {
    const { database, bins, state, shape } = this;
    const bin = state.get("bin");
    const page = element(
      "a",
      {
        class: "which",
        href: pageAddress("shape.html", { id: database.ids.at(shape) }),
        title: "All about this shape",
      },
      element("bdi", {}, database.labelled ? database.names.at(shape) : "its page"),
    );
    /** @param {number} share */
    const tell = (share) => this.name.replaceChildren(...shapeLine(database, bins, bin, shape, share), page);
    const share = bins.share(bin, shape);
    tell(share);
    if (!Number.isNaN(share)) return;
    // Of a shape that is not of the sample, its own values are read.
    const all = await loadAllBins();
    await all.know([shape]);
    if (shape === this.shape && bin === state.get("bin")) tell(all.share(bin, shape));
  }

  async render() {
    const { database, bins, state, shape } = this;
    const bin = state.get("bin");
    this.#tellName();
    for (const end of ["most", "least"])
      document.getElementById(`${end}-of-it`).setAttribute("aria-pressed", String(state.get("shape") === end));
    this.pick.show(this.#shown());
    document.getElementById("readings").hidden = !bins.isShare(bin);
    const inside = state.get("reading") === "inside";
    const shown = await this.stage.show(shape, showingBin(shape, bin, { database, bins, paint: this.paint, inside }));
    if (shown) this.announce(`${database.names.at(shape)}, ${bins.names[bin]}`);
  }

  #watchReadings() {
    const { state } = this;
    const inputs = document.querySelectorAll("#readings input");
    const check = () => {
      for (const input of inputs) input.checked = input.value === state.get("reading");
    };
    for (const input of inputs) input.addEventListener("change", () => state.set({ reading: input.value }));
    state.listen((changed) => changed.has("reading") && check());
    check();
  }

  #watchShapes() {
    const { database, state } = this;
    for (const end of /** @type {const} */ (["most", "least"])) {
      document.getElementById(`${end}-of-it`).addEventListener("click", () => state.set({ shape: end }));
    }
    findShapes(database, (shape) => state.set({ shape }));
  }

  /**
   * The map of all shapes, on which one can be pointed at; large marks have much of the bin.
   * @param {Pointing} pointing
   */
  #makePick(pointing) {
    const { database } = this;
    this.pick = new Plot(database, {
      margin: 14,
      first: (index) => index !== this.shape,
      selection: () => this.state.get("selection"),
      /** @param {number} index */
      mark: (index) => {
        const group = database.groups[index];
        const share = this.#part(this.bins.share(this.state.get("bin"), index)) || 0;
        return {
          path: database.symbol(group),
          color: database.color(group),
          radius: 1.4 + 5 * Math.sqrt(share),
          alpha: 0.35 + 0.6 * Math.sqrt(share),
        };
      },
      drawn: (over) => over.ring(this.pick.screen(this.shape), 9, styleColor("accent")),
    });
    const surface = document.getElementById("pick-surface");
    surface.append(this.pick.node);
    pointing.watch(surface, this.pick, (shape) => this.state.set({ shape }), this.state);
  }

  /**
   * A share of the bin, from 0 for that of the shape with the least to 1 for that with the most of it.
   * @param {number} share
   */
  #part(share) {
    const bin = this.state.get("bin");
    const [low, high] = [this.#extreme(bin, -1), this.#extreme(bin, 1)].map((shape) => this.bins.share(bin, shape));
    return high > low ? (share - low) / (high - low) : 0;
  }
}
