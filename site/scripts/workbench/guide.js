// A short example on the reader's own data: two classes that mix, and the bins that tell them apart.

import { DEFAULT_SCORER, EVERY_CLASS } from "../addresses/workbench.js";
import { element, swatch } from "../base/dom.js";
import { change, difference } from "../base/figures.js";
import { readHash } from "../base/place.js";
import { count, figure, shortened, wholePercent } from "../base/words.js";
import { ranked } from "../bins-kit/bin-list.js";
import { inWords } from "../bins-kit/bin-name.js";
import { kinds } from "../database/kind.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Children } from "../base/dom.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Desk, Question } from "./desk.js" */

const KEY = "shapeviz-guide";

/** Letters of a name: with two of them, the sentence has two lines. */
const LONGEST = 32;

export class Guide {
  /** @type {number | null} */
  step = null;

  /**
   * `act` are the same actions that the controls of the page do.
   * @param {Database} database
   * @param {Chunk.Workbench} data
   * @param {Bins} bins
   * @param {WorkState} state
   * @param {Desk} act
   */
  constructor(database, data, bins, state, act) {
    this.database = database;
    this.data = data;
    this.bins = bins;
    this.state = state;
    this.act = act;
    this.node = document.getElementById("guide");
    this.opener = document.getElementById("open-guide");
    this.example = data.example;
    if (this.example === null) return;
    this.opener.addEventListener("click", () => this.#open(0));
    state.listen((changed) => {
      if (
        [
          "originalMap",
          "refinedMap",
          "refinedStatus",
          "originalStatus",
          "offerStatus",
          "scores",
          "scoresStatus",
          "bins",
          "hidden",
          "theme",
        ].some((name) => changed.has(name))
      )
        this.render();
    });
    // Who comes with a link has come for something else.
    if ([...readHash()].length > 0 || dismissed()) this.#close();
    else this.#open(0);
  }

  /** @param {number} step */
  #open(step) {
    this.step = step;
    this.node.hidden = false;
    this.opener.hidden = true;
    this.render();
  }

  #close() {
    this.step = null;
    this.node.hidden = true;
    this.opener.hidden = false;
  }

  #dismiss() {
    this.#close();
    dismiss();
    this.opener.focus();
  }

  render() {
    const { step, example } = this;
    if (step === null || example === null) return;
    const focused = this.node.contains(document.activeElement);
    const steps = this.#steps(example);
    const { words, action, todo } = steps[step]();
    const last = steps.length - 1;
    this.node.replaceChildren(
      element("b", { class: "which" }, step < last ? `Example, step ${step + 1} of ${last}` : "Example, the end"),
      element("p", { "aria-live": "polite" }, words),
      element(
        "button",
        {
          type: "button",
          class: "plain strong",
          id: "do-it",
          disabled: todo === null,
          onclick: () => this.#do(step === last ? null : todo),
        },
        action,
      ),
      element(
        "button",
        {
          type: "button",
          class: "plain",
          id: "close-guide",
          "aria-label": "Close the example",
          title: "Close the example",
          onclick: () => this.#dismiss(),
        },
        "×",
      ),
    );
    if (focused) this.node.querySelector("#do-it:not(:disabled)")?.focus();
  }

  /** @param {(() => void) | null} todo null at the end */
  #do(todo) {
    if (todo === null) {
      this.#dismiss();
      return;
    }
    this.step = (this.step ?? 0) + 1;
    todo();
    this.render();
  }

  /**
   * What each step says and does; the last one only says how it ended.
   * @param {Chunk.MixedClasses} example
   * @returns {(() => { words: Children, action: string, todo: (() => void) | null })[]}
   */
  #steps(example) {
    const { act, state } = this;
    const [one, other] = example.classes;
    const pair = [this.#name(one), " and ", this.#name(other)];
    const others = [...this.database.sizes.keys()].filter((group) => group !== one && group !== other);
    /** @param {Question} name */
    const kind = (name) => state.get(`${name}Status`).kind;
    /** @param {...Question} names */
    const settled = (...names) => names.every((name) => kind(name) === "answered");
    /**
     * @param {Question} name
     * @param {string} words
     */
    const waiting = (name, words) =>
      kind(name) === "working" ? words : "This was stopped or did not work; start it again where it says so.";
    /** @param {...Question} names */
    const working = (...names) => names.some((name) => kind(name) === "working");
    /**
     * What to say until bins that were looked for have their map.
     * @param {string} words
     */
    const finding = (words) => {
      if (working("offer", "refined")) return words;
      return ["stopped", "failed"].includes(kind("offer")) ? waiting("offer", words) : null;
    };
    return [
      () => ({
        words: [
          "Mixed on the map of all shapes: ",
          ...pair,
          `. Of their nearest neighbours, ${wholePercent(example.mixed)} are of the other of the two.`,
        ],
        action: "Show only these two",
        todo: () => act.use({ hidden: new Set(others) }),
      }),
      () => ({
        words: [
          "Each bar below is one bin: the share of a surface within a small range of a feature. Its height can say how well this share alone tells ",
          ...pair,
          " apart.",
        ],
        action: "Score the bins for that",
        todo: () =>
          act.use({
            scorer: DEFAULT_SCORER,
            separation: { from: new Set([one]), against: new Set([other]), each: true },
          }),
      }),
      () => ({
        words: settled("scores") ? this.#bestBin() : waiting("scores", "Scoring …"),
        action: "Find a few that do",
        todo: settled("scores") && act.canFind ? () => act.findBins() : null,
      }),
      () => ({
        words: finding("Looking for bins …") ?? this.#resultOfTwo(pair),
        action: `Bring all ${kinds(this.database)} back`,
        todo: working("offer", "refined") ? null : () => act.use({ hidden: new Set(), separation: EVERY_CLASS }),
      }),
      () => ({
        words: settled("refined", "original")
          ? this.#resultOfAll(` Other ${kinds(this.database)} need other bins.`)
          : waiting("refined", `Making the map of all ${kinds(this.database)} …`),
        action: `Find bins for all ${kinds(this.database)}`,
        todo: settled("scores") && act.canFind ? () => act.findBins() : null,
      }),
      () => ({
        words:
          finding("Looking for bins …") ??
          this.#resultOfAll(
            " Every step stands at the bottom: click one to go back. Undo, try other bins, or export these.",
          ),
        action: "Done",
        todo: () => {},
      }),
    ];
  }

  #bestBin() {
    const column = ranked(/** @type {Float64Array} */ (this.state.get("scores")))[0];
    return [
      "The best bin is ",
      element("b", {}, element("bdi", {}, this.bins.names[column])),
      inWords(this.bins, column),
      ".",
    ];
  }

  /**
   * What the data says, whichever way it went.
   * @param {(string | HTMLSpanElement)[]} pair
   */
  #resultOfTwo(pair) {
    const result = this.#result();
    if (result === null) return ["No few bins were found that keep ", ...pair, " apart better than all features do."];
    const { words, moved } = result;
    const verdict =
      moved > 0
        ? "these bins keep them apart better than all features do"
        : moved === 0
          ? "these bins keep them apart as well as all features do"
          : "these bins alone keep them apart less well than all features do: try more of them, or another scorer";
    return [
      "On the refined map of ",
      ...pair,
      ...words,
      `: ${verdict}. But what does it do to the other ${kinds(this.database)}?`,
    ];
  }

  /** @param {string} next */
  #resultOfAll(next) {
    const result = this.#result();
    if (result === null) return ["No bins are chosen.", next];
    return [
      `The map of all ${kinds(this.database)} by these ${count(this.state.get("bins").size, "bin")}: `,
      ...result.words,
      this.state.get("refused") === null ? "." : ". No few bins were found that make a better one.",
      next,
    ];
  }

  /** NH of the refined map in words, and its change against the original; null without a refined map. */
  #result() {
    const [before, after] = [this.state.get("originalMap"), this.state.get("refinedMap")].map(
      (map) => map?.hitOfAll ?? null,
    );
    if (before === null || after === null) return null;
    return {
      words: [" NH is ", element("b", {}, figure(after)), `, ${difference(before, after)} against the original`],
      moved: change(before, after),
    };
  }

  /** @param {number} group */
  #name(group) {
    const { database } = this;
    return element(
      "span",
      { class: "of-class" },
      swatch(database.symbol(group), database.color(group)),
      element("bdi", {}, shortened(database.className(group), LONGEST)),
    );
  }
}

// Pages opened by double-click may be refused storage; then the example is offered again.
function dismissed() {
  try {
    return window.localStorage.getItem(KEY) === "closed";
  } catch {
    return false;
  }
}

function dismiss() {
  try {
    window.localStorage.setItem(KEY, "closed");
  } catch {
    return;
  }
}
