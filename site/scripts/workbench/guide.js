// A short example on the reader's own data: two classes that mix, and the bins that tell them apart.

import { ranked } from "../bin-list.js";
import { element, swatch } from "../dom.js";
import { figure } from "../words.js";
import { difference } from "./figures.js";

const KEY = "shapeviz-guide";
const BEST = 10;

export class Guide {
  /** `act` are the same actions that the controls of the page do. */
  constructor(model, data, bins, state, act) {
    Object.assign(this, { model, data, bins, state, act });
    this.node = document.getElementById("guide");
    this.opener = document.getElementById("open-guide");
    this.example = data.example;
    if (this.example === null) return;
    this.opener.addEventListener("click", () => this.#open(0));
    state.listen((changed) => {
      if (["originalMap", "refinedMap", "refinedStatus", "originalStatus", "scores", "scoresStatus", "bins", "hidden", "theme"].some((name) => changed.has(name))) this.render();
    });
    // Who comes with a link has come for something else.
    if (window.location.hash.length > 1 || dismissed()) this.#close();
    else this.#open(0);
  }

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
    if (this.step === null || this.example === null) return;
    const focused = this.node.contains(document.activeElement);
    const steps = this.#steps();
    const { words, action, todo } = steps[this.step]();
    this.node.replaceChildren(
      element("b", { class: "which" }, `Example, step ${this.step + 1} of ${steps.length}`),
      element("p", { "aria-live": "polite" }, words),
      element("button", { type: "button", class: "plain strong", id: "do-it", disabled: todo === null, onclick: () => this.#do(todo) }, action),
      element("button", { type: "button", class: "plain", id: "close-guide", "aria-label": "Close the example", title: "Close the example", onclick: () => this.#dismiss() }, "×"),
    );
    if (focused) this.node.querySelector("#do-it:not(:disabled)")?.focus();
  }

  #do(todo) {
    if (this.step === this.#steps().length - 1) this.#close();
    else this.step += 1;
    todo();
    this.render();
  }

  #steps() {
    const { act, state } = this;
    const [one, other] = this.example.classes;
    const pair = [this.#name(one), " and ", this.#name(other)];
    const others = [...this.model.sizes.keys()].filter((group) => group !== one && group !== other);
    const settled = (name) => state.get(`${name}Status`).kind === "answered";
    const waiting = (name, words) => (state.get(`${name}Status`).kind === "working" ? words : "This was stopped or did not work; start it again where it says so.");
    return [
      () => ({
        words: [...pair, ` are mixed: of their nearest neighbours on the map of all shapes, ${Math.round(this.example.mixed * 100)} % are of the other of the two.`],
        action: "Show only these two",
        todo: () => act.use({ hidden: new Set(others) }),
      }),
      () => ({
        words: ["Each bar below is one bin: the share of a surface within a small range of a feature. Its height can say how well this share alone tells ", ...pair, " apart."],
        action: "Score the bins for that",
        todo: () => act.ask({ separation: { from: new Set([one]), against: new Set([other]), each: true } }),
      }),
      () => ({
        words: settled("scores") ? this.#bestBin() : waiting("scores", "Scoring …"),
        action: `Take the best ${BEST}`,
        todo: settled("scores") ? () => act.takeBest(BEST) : null,
      }),
      () => ({
        words: settled("refined") && settled("original") ? this.#result(pair) : waiting("refined", "Making the map of these bins …"),
        action: "Bring all classes back",
        todo: state.get("refinedStatus").kind === "working" ? null : () => act.use({ hidden: new Set() }),
      }),
    ];
  }

  #bestBin() {
    const column = ranked(this.state.get("scores"))[0];
    return ["The best bin is ", element("b", {}, element("bdi", {}, this.bins.names[column])), ". ", this.bins.sentence(column)];
  }

  /** What the data says, whichever way it went. */
  #result(pair) {
    const before = this.state.get("originalMap").hitOfAll;
    const after = this.state.get("refinedMap")?.hitOfAll ?? null;
    if (after === null) return "No bins are chosen: take the best to see their map.";
    const moved = difference(after - before);
    const verdict = after - before >= 0.0005
      ? "these bins keep them apart better than all features do"
      : after - before > -0.0005
        ? "these bins keep them apart as well as all features do"
        : "these bins alone keep them apart less well than all features do: try more of them, or another scorer";
    return ["On the refined map of ", ...pair, " NH is ", element("b", {}, figure(after)), ` (${moved} against the original): ${verdict}. Every step is kept at the bottom; the classes left out may mix by these bins.`];
  }

  #name(group) {
    const { model } = this;
    return element("span", { class: "of-class" }, swatch(model.symbol(group), model.color(group)), element("bdi", {}, model.className(group)));
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
