// Two shapes in 3D, coloured where they differ, with what the colours say.

import { modelBytes } from "../base/chunks.js";
import { element } from "../base/dom.js";
import { percent } from "../base/words.js";
import { unpackModel } from "../viewer/model.js";
import { Paint } from "../viewer/paint.js";
import { densities } from "./difference.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Model } from "../viewer/model.js" */
/** @import { Part } from "./difference.js" */
/** @import { Stage } from "./stage.js" */

const SWATCHES = 10;

/**
 * The models of a site, by their shapes; null where it has none.
 * @param {Chunk.Selection} selection
 * @returns {((shape: number) => Promise<ArrayBuffer>) | null}
 */
export function modelsOf({ models }) {
  return models && ((shape) => modelBytes(models[shape]));
}

export class TwoSurfaces {
  /**
   * @param {Database} database
   * @param {Bins} bins
   * @param {Chunk.Selection} selection
   * @param {{ stages: [Stage, Stage], legend: Found }} places
   */
  constructor(database, bins, selection, { stages, legend }) {
    this.database = database;
    this.bins = bins;
    this.load = modelsOf(selection);
    this.paint = new Paint(selection);
    this.stages = stages;
    this.legend = legend;
  }

  /** @type {symbol | null} what was asked for last */
  latest = null;

  /** What was asked for is no longer wanted. */
  leave() {
    this.latest = null;
    this.legend.hidden = true;
  }

  /**
   * @param {[number, number]} pair
   * @param {Part[]} parts those of their squared distance that are painted
   * @param {number} total the squared distance
   */
  async show(pair, parts, total) {
    const latest = (this.latest = Symbol("shown"));
    const { database, paint } = this;
    this.legend.hidden = true;
    const solids = await this.#solids(pair);
    if (latest !== this.latest) return;
    const found = parts.length > 0 && solids && densities(parts, this.bins, pair, solids, total);
    const shown = await Promise.all(
      this.stages.map((stage, side) => {
        // Who asks where two shapes differ asks for their surfaces.
        stage.asked = true;
        return stage.show(pair[side], {
          label: `${database.names.at(pair[side])} in 3D, coloured where it differs from ${database.names.at(pair[1 - side])}`,
          paint: (solid) => (found ? paint.density(solid, found.densities[side], found.strongest) : paint.plain(solid)),
        });
      }),
    );
    if (latest !== this.latest || !found || !shown.every(Boolean) || found.strongest === 0) return;
    this.legend.hidden = false;
    this.legend.replaceChildren(
      element("div", { class: "ten", "aria-hidden": "true" }, this.#swatches()),
      element(
        "p",
        { class: "ends" },
        element("span", {}, "as much of it on both"),
        element("span", {}, `1\u00a0% of a surface bears ${percent(found.strongest / 100)} of the difference`),
      ),
      element("p", { class: "quiet" }, `Half of what is coloured lies on ${percent(found.half)} of the two surfaces.`),
    );
  }

  #swatches() {
    return this.paint.scale(SWATCHES).map((color) => {
      const node = element("i", {});
      node.style.background = color;
      return node;
    });
  }

  /**
   * The models of both; null where one cannot be had, which its stage then says.
   * @param {[number, number]} pair
   */
  async #solids(pair) {
    if (this.load === null) return null;
    try {
      return /** @type {[Model, Model]} */ ((await Promise.all(pair.map(this.load))).map(unpackModel));
    } catch {
      return null;
    }
  }
}
