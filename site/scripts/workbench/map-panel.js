// What stands around a map: what it is made from, what it reaches, and how its work stands.

import { element } from "../base/dom.js";
import { difference, symbol } from "../base/figures.js";
import { count, figure, lowered } from "../base/words.js";
import { isBelowOne, nothingTold, rangeOf } from "../database/hit-range.js";
import { MEASURES, measureOf } from "../map/measures.js";
import { emptyMap } from "./empty-map.js";
import { StatusLine } from "./status-line.js";
import { kinds } from "../database/kind.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database, Faith, ShapeMap } from "../database/database.js" */
/** @import { MeasureName } from "../map/measures.js" */
/** @import { Answers } from "./answers.js" */
/** @import { Desk, Question, Which } from "./desk.js" */

/**
 * What stands around the two maps; the refined one is compared with the original one.
 * @param {Database} database
 * @param {WorkState} state
 * @param {Bins} bins
 * @param {Answers} answers
 * @param {Desk} desk
 */
export function mapPanels(database, state, bins, answers, desk) {
  return /** @type {[Which, "originalMap" | null][]} */ (
    Object.entries({ original: null, refined: "originalMap" })
  ).map(
    ([which, other]) =>
      new MapPanel(which, database, state, bins, {
        other,
        also: which === "refined" ? "offer" : null,
        again: (question) => desk.ask([question]),
        stop: (question) => desk.stop(question),
        empty: () => emptyMap(which, state, answers, desk),
      }),
  );
}

class MapPanel {
  /**
   * @param {Which} which
   * @param {Database} database
   * @param {Bins} bins
   * @param {WorkState} state
   * @param {object} options
   * @param {"originalMap" | null} options.other names the state's map that this one is compared with
   * @param {Question | null} options.also another question whose work ends in this map
   * @param {(question: Question) => void} options.again restarts work that was stopped
   * @param {(question: Question) => void} options.stop
   * @param {() => Node[]} options.empty what to show where there is no map and none is being made
   */
  constructor(which, database, state, bins, { other, also, again, stop, empty }) {
    this.which = which;
    this.database = database;
    this.state = state;
    this.bins = bins;
    this.other = other;
    this.empty = empty;
    this.figure = document.querySelector(`figure[data-map="${which}"]`);
    this.madeFrom = this.figure.querySelector(".made-from");
    this.nh = this.figure.querySelector(".nh");
    this.faith = this.figure.querySelector(".faith");
    this.blank = this.figure.querySelector(".empty");
    this.also = also;
    this.status = new StatusLine(this.figure.querySelector(".status"), {
      again: () => again(this.#asked),
      stop: () => stop(this.#asked),
    });
    const names = [
      `${which}Map`,
      `${which}Faith`,
      `${which}Status`,
      other,
      "bins",
      "features",
      "hidden",
      ...(also === null ? [] : [`${also}Status`, "originalStatus", "scores", "refused"]),
    ].filter(Boolean);
    state.listen((changed) => {
      if (names.some((name) => changed.has(name))) this.render();
      else if (changed.has(`${this.#asked}Progress`)) this.status.move(state.get(`${this.#asked}Progress`));
    });
  }

  /** The question whose work is shown: of two, the one that waits for an answer. */
  get #asked() {
    const { also, state, which } = this;
    return also !== null && !["none", "answered"].includes(state.get(`${also}Status`).kind) ? also : which;
  }

  render() {
    const map = this.state.get(`${this.which}Map`);
    const status = this.state.get(`${this.which}Status`);
    const before = this.other && this.state.get(this.other);
    const most = map && rangeOf(this.database, map).highest;
    const nothing = map && nothingTold(this.database, map);
    this.status.show(this.state.get(`${this.#asked}Status`));
    this.status.move(this.state.get(`${this.#asked}Progress`));
    this.madeFrom.textContent =
      this.which === "original"
        ? featureWords(this.state.get("features"), this.bins.features)
        : chosenWords(this.state.get("bins"));
    this.#showEmpty(map);
    this.faith.replaceChildren(...(map?.faith && map.faith.chance !== 1 ? faithParts(map.faith, map.neighbours) : []));
    this.figure.classList.toggle("stale", status.kind !== "answered" && map !== null);
    this.figure.classList.toggle("without", map === null);
    this.nh.classList.toggle("says-nothing", nothing !== null);
    this.nh.replaceChildren(
      ...(map?.hitOfAll === null || map === null
        ? []
        : nothing !== null
          ? [symbol(), ` says nothing here: ${lowered(nothing)}`]
          : [
              symbol(),
              element(
                "output",
                {
                  class: "value",
                  title: map.chance === null ? null : `Labels dealt at random reach ${figure(map.chance)} on average`,
                },
                figure(map.hitOfAll),
              ),
              ...(before && before.hitOfAll !== null
                ? [
                    element(
                      "span",
                      { class: `change ${map.hitOfAll < before.hitOfAll ? "worse" : "better"}` },
                      difference(before.hitOfAll, map.hitOfAll),
                    ),
                  ]
                : []),
              ...(map.chance !== null
                ? [
                    element(
                      "span",
                      { class: "chance", title: "What labels dealt at random reach on average" },
                      `random ${figure(map.chance)}`,
                    ),
                  ]
                : []),
              ...(isBelowOne(most)
                ? [
                    element(
                      "span",
                      {
                        class: "chance",
                        title: `A map whose ${kinds(this.database)} never mix: some of the ${kinds(this.database)} have too few shapes here to fill all places around one`,
                      },
                      `at most ${figure(most)}`,
                    ),
                  ]
                : []),
            ]),
    );
  }

  /** @param {ShapeMap | null} map */
  #showEmpty(map) {
    this.blank.hidden = map !== null || this.state.get(`${this.which}Status`).kind !== "none";
    if (!this.blank.hidden) this.blank.replaceChildren(...this.empty());
  }
}

/**
 * How far a map shows who is like whom by what it is made from: another map is made from something else, so that there is
 * nothing to compare with but chance.
 * @param {Faith} faith
 * @param {number} neighbours
 */
function faithParts(faith, neighbours) {
  /** @param {number} share */
  const many = (share) => (share * neighbours).toFixed(1);
  /**
   * @param {MeasureName} name
   * @param {string} short
   */
  const part = (name, short) => {
    const { value, chance } = measureOf(faith, name);
    if (value === null) return "";
    const title = `${MEASURES[name].meaning}; ${figure(chance)} on a map at random`;
    return element("span", { class: "more", title }, `${short} `, element("b", {}, figure(value)));
  };
  return [
    element(
      "span",
      {
        title: `Of the ${neighbours} most alike by what this map is made from, so many are among the ${neighbours} nearest on it`,
      },
      "kept ",
      element("b", {}, `${many(faith.mean)} of ${neighbours}`),
      ` (random ${many(faith.chance)})`,
    ),
    part("trustworthiness", "trust"),
    part("continuity", "continuity"),
    part("stress", "stress"),
  ];
}

/** @param {Set<number>} bins */
function chosenWords({ size }) {
  return size === 0 ? "" : count(size, "bin");
}

/**
 * "all 8 features", "Agd, Sc".
 * @param {Set<number>} features
 * @param {Chunk.Feature[]} all
 */
function featureWords(features, all) {
  if (features.size === all.length) return all.length === 1 ? all[0].name : `all ${all.length} features`;
  if (features.size <= 3)
    return [...features]
      .sort((a, b) => a - b)
      .map((feature) => all[feature].name)
      .join(", ");
  return count(features.size, "feature");
}
