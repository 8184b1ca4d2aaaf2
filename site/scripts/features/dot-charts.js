// Two plots of dots: what each feature adds or spoils, and what the seeds of the best subsets differ by.

import { drawChart } from "../base/chart.js";

/** @import { Subsets } from "../database/subsets.js" */
/** @import { Marks } from "./ranking.js" */

const ROW = 24;

/**
 * The two plots of dots, with as many rows as there is data.
 * @param {Subsets} subsets
 * @param {Marks} marks
 */
export function dotCharts(subsets, marks) {
  const { data } = subsets;
  const effects = data.order
    .flatMap((feature) => data.effects.filter((effect) => effect.feature === feature))
    .map((effect) => ({ ...effect, name: subsets.features[effect.feature], feature: data.hues[effect.feature] }));
  const best = Math.max(...data.spread.map(({ mean }) => mean));
  const seeds = data.spread.flatMap(({ place, hits, mean, margin, apart }) =>
    hits.map((hit) => ({
      name: subsets.names(place).join(" "),
      hit,
      mean,
      low: mean - margin,
      high: mean + margin,
      best,
      apart,
    })),
  );
  return [
    new DotChart("effect-dots", data.charts.effects, "effects", effects, effects.length, marks),
    new DotChart("seed-dots", data.charts.seeds, "seeds", seeds, data.spread.length, marks),
  ].filter(({ node }) => node !== null);
}

class DotChart {
  /**
   * @param {string} id
   * @param {Record<string, any>} spec
   * @param {string} name
   * @param {object[]} rows
   * @param {number} count
   * @param {Marks} marks
   */
  constructor(id, spec, name, rows, count, marks) {
    this.node = document.getElementById(id);
    this.spec = spec;
    this.name = name;
    this.rows = rows;
    this.count = count;
    this.marks = marks;
    /** @type {any} Vega's view, once it is drawn */
    this.vega = null;
    this.node?.closest("details")?.addEventListener("toggle", () => this.resize());
  }

  async start() {
    this.vega?.finalize();
    this.vega = null;
    // What is folded is drawn when it is opened.
    if (this.node.closest("details:not([open])")) return;
    const { config, ink, bar, accent, ground } = this.marks();
    this.vega = await drawChart(this.node, this.spec, config, "svg");
    const values = { ink, bar, accent, ground };
    const known = new Set(this.spec.params.map((/** @type {{ name: string }} */ { name }) => name));
    for (const [name, value] of Object.entries(values)) if (known.has(name)) this.vega.signal(name, value);
    this.vega.data(this.name, this.rows);
    await this.#fit();
  }

  async resize() {
    if (this.vega) await this.#fit();
    else await this.start();
  }

  async #fit() {
    const width = this.node.clientWidth;
    if (this.spec.params.some((/** @type {{ name: string }} */ { name }) => name === "label_limit"))
      this.vega.signal("label_limit", width * 0.42);
    await this.vega
      .width(width)
      .height(this.count * ROW + 44)
      .runAsync();
  }
}
