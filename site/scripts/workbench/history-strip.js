// The steps as small maps, each with its NH and what it added or removed (paper, Fig. 7). Click one to go back to it.

import { element, focused } from "../base/dom.js";
import { walk } from "../base/place.js";
import { count, figure, percent } from "../base/words.js";
import { pictureOfMap } from "../map/plot.js";
import { changes, turns } from "./history.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Database, ShapeMap } from "../database/database.js" */
/** @import { Desk } from "./desk.js" */
/** @import { Step } from "./history.js" */

const SIZE = 56;

export class HistoryStrip {
  /**
   * @param {Database} database
   * @param {WorkState} state
   * @param {Desk} desk goes to a step
   */
  constructor(database, state, desk) {
    this.database = database;
    this.state = state;
    this.history = desk.history;
    this.go = (/** @type {number} */ place) => desk.go(place);
    this.list = document.getElementById("steps");
    this.list.addEventListener("keydown", (event) => this.#key(event));
    this.undo = document.getElementById("undo");
    this.redo = document.getElementById("redo");
    this.undo.addEventListener("click", () => walk(-1));
    this.redo.addEventListener("click", () => walk(1));
    state.listen((changed) => {
      if (changed.has("theme")) this.#pictures = new WeakMap();
      if (changed.has("whereabouts")) this.#showWays();
      if (
        ["step", "originalMap", "refinedMap", "originalFaith", "refinedFaith", "theme"].some((name) =>
          changed.has(name),
        )
      )
        this.render();
    });
  }

  // By step: a strip is made anew with every step, its pictures only with every map.
  /** @type {WeakMap<Step, { map: ShapeMap, canvas: HTMLCanvasElement }>} */
  #pictures = new WeakMap();

  render() {
    const { history } = this;
    const kept = focused()?.dataset.step;
    this.list.replaceChildren(...history.steps.map((_, place) => element("li", {}, this.#step(place))));
    this.#showWays();
    const current = this.list.children[history.at].firstElementChild;
    if (history.steps.length > 1) this.#reveal(current);
    if (kept !== undefined)
      (this.list.querySelector(`[data-step="${kept}"]`) ?? current).focus({ preventScroll: true });
  }

  #showWays() {
    const { steps, last } = this.state.get("whereabouts");
    this.undo.disabled = steps === 0;
    this.redo.disabled = steps === last;
  }

  /**
   * Scroll the strip to a step, and nothing but the strip: on a phone it lies far below what one looks at.
   * @param {Element} step
   */
  #reveal(step) {
    const [strip, box] = [this.list.getBoundingClientRect(), step.getBoundingClientRect()];
    if (box.left < strip.left) this.list.scrollLeft -= strip.left - box.left;
    else if (box.right > strip.right) this.list.scrollLeft += box.right - strip.right;
  }

  /** @param {number} place */
  #step(place) {
    const { history } = this;
    const step = history.steps[place];
    const map = mapOf(step);
    // Where steps were made by different projections, each says by which.
    const mixed = new Set(history.steps.map((one) => mapOf(one)?.title).filter(Boolean)).size > 1;
    const kept = map?.faith ? percent(map.faith.mean) : "";
    const changed = place === 0 ? [] : changes(history.steps[place - 1], step);
    const turned = place === 0 ? [] : turns(history.steps[place - 1], step);
    const words =
      place === 0 ? "start" : [...changed.map(([number, word]) => changeOf(number, word)), ...turned].join(", ");
    const parts =
      place === 0
        ? [element("span", {}, "start")]
        : [
            ...changed.map(([number, word]) =>
              element(
                "span",
                { class: number < 0 ? "removed" : "added" },
                `${number < 0 ? "−" : "+"}${count(Math.abs(number), word, many(word))}`,
              ),
            ),
            ...turned.map((word) => element("span", {}, word)),
          ];
    return element(
      "button",
      {
        type: "button",
        class: "step-of-work",
        "data-step": place,
        tabindex: place === history.at ? "0" : "-1",
        "aria-current": place === history.at ? "step" : null,
        "aria-label": `Step ${place + 1}: ${words}${map?.hitOfAll ? `, NH ${figure(map.hitOfAll)}` : ""}${kept && `, ${kept} of the neighbours kept`}`,
        title: `Step ${place + 1}: ${words}. ${step.bins.size > 0 ? `The map of ${count(step.bins.size, "bin")}.` : "The original map; no bins were chosen."}${kept && ` It keeps ${kept} of the neighbours.`}`,
        onclick: () => this.go(place),
      },
      map ? this.#pictureOf(step, map) : element("span", { class: "no-map" }),
      element(
        "span",
        { class: "told" },
        // Without labels there is no NH.
        (map?.hitOfAll ?? kept) !== "" &&
          element("b", {}, map ? hitOrKept(map, kept) : "…", mixed && map && element("i", {}, map.title)),
        element("span", { class: "changed" }, parts),
      ),
    );
  }

  /**
   * @param {Step} step
   * @param {ShapeMap} map
   */
  #pictureOf(step, map) {
    const known = this.#pictures.get(step);
    if (known?.map === map) return known.canvas;
    const canvas = pictureOfMap(this.database, map, SIZE, step.hidden);
    this.#pictures.set(step, { map, canvas });
    return canvas;
  }

  /** @param {KeyboardEvent & Targeted} event */
  #key(event) {
    /** @type {Record<string, number>} */
    const steps = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity };
    if (!(event.key in steps)) return;
    event.preventDefault();
    const place = Number(focused().dataset.step ?? this.history.at) + steps[event.key];
    const last = this.list.children.length - 1;
    this.list.children[Math.min(Math.max(place, 0), last)].firstElementChild.focus();
  }
}

/**
 * The map that a step stands for.
 * @param {Step} step
 */
function mapOf(step) {
  return step.bins.size > 0 ? step.refinedMap : step.originalMap;
}

/**
 * @param {ShapeMap} map
 * @param {string} kept
 */
function hitOrKept({ hitOfAll }, kept) {
  return hitOfAll === null ? `${kept} kept` : figure(hitOfAll);
}

/** @param {string} word */
function many(word) {
  return word === "class" ? "classes" : `${word}s`;
}

/**
 * "10 bins added", "1 class removed".
 * @param {number} number
 * @param {string} word
 */
function changeOf(number, word) {
  return `${count(Math.abs(number), word, many(word))} ${number < 0 ? "removed" : "added"}`;
}
