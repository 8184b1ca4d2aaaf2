// NH of every class: on the chosen map, and over all subsets (Fig. 3).

import { drawChart } from "../base/chart.js";
import { element } from "../base/dom.js";
import { grouped } from "../base/words.js";
import { classMark } from "../colors/legend.js";
import { hitRange } from "../database/hit-range.js";

/** @import { FeaturesState } from "../addresses/features.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Subsets } from "../database/subsets.js" */
/** @import { Marks } from "./ranking.js" */

export class Boxes {
  /** @type {[string, any][]} the element and Vega's view of each chart */
  vegas = [];

  /**
   * @param {Database} database
   * @param {Subsets} subsets
   * @param {FeaturesState} state
   * @param {Marks} marks
   */
  constructor(database, subsets, state, marks) {
    this.database = database;
    this.subsets = subsets;
    this.state = state;
    this.marks = marks;
    this.node = document.getElementById("legend");
    // Columns of the subsets' classes, the highest median first.
    const { boxes, classes } = subsets.data;
    this.order = boxes
      .map((_, column) => column)
      .sort((a, b) => (boxes[b].median ?? 0) - (boxes[a].median ?? 0) || classes[a] - classes[b]);
    state.listen((changed) => {
      if (changed.has("chosen") || changed.has("among")) this.render();
      if (changed.has("coloring")) this.#list();
    });
  }

  async start() {
    for (const [, vega] of this.vegas) vega.finalize();
    this.vegas = [];
    this.#list();
    const { database, subsets } = this;
    const bars = await drawChart(
      document.getElementById("bars"),
      database.data.charts.bars,
      database.marks.config,
      "svg",
    );
    const boxes = await drawChart(
      document.getElementById("boxes"),
      subsets.data.charts.boxes,
      database.marks.config,
      "svg",
    );
    const { ink, bar, accent, ground } = this.marks();
    bars.signal("ink", ink).signal("chance", subsets.data.chance ?? -1);
    boxes.signal("ink", ink).signal("bar", bar).signal("accent", accent).signal("ground", ground);
    this.vegas = [
      ["bars", bars],
      ["boxes", boxes],
    ];
    this.render();
  }

  #list() {
    const { database, subsets } = this;
    /** @param {number | null} pointedGroup */
    const point = (pointedGroup) => () => this.state.set({ pointedGroup });
    this.node.replaceChildren(
      ...this.order.map((column) => {
        const group = subsets.data.classes[column];
        return element(
          "li",
          { title: database.className(group), onpointerenter: point(group), onpointerleave: point(null) },
          classMark(database, this.state.get("coloring") ?? null, group),
          element("span", { class: "name", dir: "auto" }, database.className(group)),
        );
      }),
    );
  }

  resize() {
    this.render();
  }

  render() {
    const { subsets } = this;
    const among = this.state.get("among");
    const boxes = subsets.boxes(among);
    document.getElementById("maps-count").textContent = grouped(subsets.ranked(undefined, among).length);
    const hits = subsets.data.hitOfClass[this.state.get("chosen")];
    const { highestOfClass } = hitRange(
      subsets.data.rows === null ? this.database.groups : subsets.data.rows.map((row) => this.database.groups[row]),
      subsets.data.neighbours,
    );
    /** @param {number} column */
    const most = (column) => highestOfClass.get(subsets.data.classes[column]) ?? null;
    const rows = this.order.map((column, row) => ({
      row,
      ...boxes[column],
      hit: hits[column],
      highest: most(column),
      present: true,
    }));
    const height = this.node.firstElementChild.getBoundingClientRect().height * rows.length;
    for (const [id, vega] of this.vegas) {
      vega.width(document.getElementById(id).clientWidth).height(height);
      vega.data("classes", rows).runAsync();
    }
  }
}
