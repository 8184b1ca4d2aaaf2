// The bins with their scores, as the chart, the card and the line of the work's status show them.

import { watchSize } from "../base/dom.js";
import { toldAs } from "../base/snapshot.js";
import { figure } from "../base/words.js";
import { BinCard } from "../bins-kit/bin-card.js";
import { BinChart } from "./bin-chart.js";
import { contests, separationWords, sides } from "./separation.js";
import { StatusLine } from "./status-line.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Answers } from "./answers.js" */
/** @import { Desk } from "./desk.js" */

export class BinSection {
  /**
   * @param {Database} database
   * @param {Chunk.Workbench} data
   * @param {Bins} bins
   * @param {WorkState} state
   * @param {Answers} answers
   * @param {Desk} desk
   * @param {(text: string) => void} announce
   */
  constructor(database, data, bins, state, answers, desk, announce) {
    this.database = database;
    this.data = data;
    this.state = state;
    this.answers = answers;
    this.desk = desk;
    this.noScores = new Float64Array(bins.count).fill(NaN);
    this.card = new BinCard(bins, database);
    this.chart = new BinChart(document.getElementById("bin-chart"), bins, {
      onToggle: (column) => desk.toggle([column]),
      onRange: (columns) => desk.add(columns),
      onRemove: (columns) => desk.remove(columns),
      onFind: database.separable ? () => desk.findBins() : null,
      onPoint: (column, box) => (column === null || box === null ? this.card.hide() : this.card.show(column, box)),
      announce,
    });
    toldAs(document.querySelector(".workbench .bins"), () => {
      const scorer = data.scorers.find(({ key }) => key === state.get("scorer"));
      return scorer && database.separable ? `Bins as ${scorer.title} scores them, the best first.` : "";
    });
    const status = document.getElementById("scores-status");
    // Over the bars, which are out of date meanwhile, and over no words.
    this.chart.plot.node.append(status);
    this.status = new StatusLine(status, {
      again: () => desk.ask(["scores"]),
      stop: () => desk.stop("scores"),
    });
    state.listen((changed) => {
      if (
        [
          "scores",
          "bins",
          "scoresStatus",
          "separation",
          "hidden",
          "scorer",
          "originalMap",
          "refinedMap",
          "originalStatus",
          "refinedStatus",
          "offerStatus",
          "refused",
        ].some((name) => changed.has(name))
      )
        this.#draw();
      if (changed.has("scoresStatus")) this.status.show(state.get("scoresStatus"));
      if (changed.has("scoresProgress")) this.status.move(state.get("scoresProgress"));
    });
  }

  /** Follow the room that there is. */
  start() {
    watchSize([this.chart.plot.surface], () => this.chart.resize());
  }

  /** Draw with the colours of the theme in use. */
  redraw() {
    this.chart.start();
  }

  #draw() {
    const { database, data, state } = this;
    const scores = state.get("scores") ?? this.noScores;
    const groups = this.answers.groups(state.get("hidden"));
    const separation = state.get("separation");
    const { positive } = sides(separation, groups);
    this.card.know({
      scores,
      scorer: database.separable
        ? (data.scorers.find(({ key }) => key === state.get("scorer"))?.title ?? "")
        : "standard deviation",
      separated: positive,
      others: groups.filter((group) => !positive.includes(group)),
    });
    this.chart.draw({
      scores,
      chosen: state.get("bins"),
      busy: state.get("scoresStatus").kind === "working",
      separation: contests(separation, groups).length > 0 ? separationWords(separation, groups, database) : null,
      outcome: this.#outcome(),
      canFind: this.desk.canFind,
    });
  }

  /** What the choice of bins did to the map; null as long as that is not known. */
  #outcome() {
    const { state } = this;
    const refused = state.get("refused");
    if (refused !== null) return `none found for an NH above ${figure(refused.before)}`;
    const [before, after] = [state.get("originalMap"), state.get("refinedMap")].map((map) => map?.hitOfAll ?? null);
    const known = before !== null && after !== null && state.get("refinedStatus").kind === "answered";
    return known ? `NH ${figure(before)} → ${figure(after)}` : null;
  }
}
