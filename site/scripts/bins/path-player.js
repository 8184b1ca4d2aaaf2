// The way from no bins to those that separate all classes (paper, Fig. 7): a strip of maps that plays.

import { calm, element, svg } from "../base/dom.js";
import { difference, symbol } from "../base/figures.js";
import { toldAs } from "../base/snapshot.js";
import { count, figure } from "../base/words.js";
import { classNaming } from "../map/coloring.js";
import { Labels } from "../map/labels.js";
import { FULL } from "../map/marks.js";
import { mapOf, pictureOfMap, Plot } from "../map/plot.js";

/** @import { BinsState } from "../addresses/bins.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Pointing } from "../map/pointing.js" */
/** @import { BinChips } from "./bin-chip.js" */

const PACE = 900;
const THUMBNAIL = 64;

export class PathPlayer {
  /**
   * @param {Database} database
   * @param {Chunk.Selection} selection
   * @param {Bins} bins
   * @param {BinChips} chips
   * @param {BinsState} state
   * @param {object} ways
   * @param {(columns: number[]) => string} ways.open the address of bins in the Workbench
   * @param {Pointing} ways.pointing
   * @param {(shape: number) => void} ways.choose
   * @param {(text: string) => void} ways.announce
   */
  constructor(database, selection, bins, state, chips, { open, pointing, choose, announce }) {
    this.database = database;
    this.selection = selection;
    this.bins = bins;
    this.state = state;
    this.chips = chips;
    this.open = open;
    this.announce = announce;
    this.steps = selection.path;
    this.maps = this.steps.map((step) => mapOf(step, selection));
    this.list = document.getElementById("path-steps");
    this.button = document.getElementById("play");
    this.button.addEventListener("click", () => (this.timer ? this.pause() : this.play()));
    for (const [id, by] of Object.entries({ "step-back": -1, "step-on": 1 })) {
      document.getElementById(id).addEventListener("click", () => this.go(state.get("step") + by));
    }
    document.querySelector(".player").addEventListener("keydown", (event) => this.#key(event));
    // Escape stops what moves, before it drops anything else.
    document.addEventListener(
      "keydown",
      (event) => {
        if (event.key !== "Escape" || !this.timer || document.querySelector("dialog[open]")) return;
        this.pause();
        event.preventDefault();
      },
      { capture: true },
    );
    // Nothing plays where nobody looks.
    document.addEventListener("visibilitychange", () => document.hidden && this.pause());
    this.#makeMap(pointing, choose);
    state.listen((changed) => {
      if (changed.has("theme")) this.start();
      else if (changed.has("step")) this.#render({ travel: true });
    });
  }

  start() {
    const thumbnails = this.steps.map((step, place) => this.#thumbnail(step, place));
    this.list.replaceChildren(...thumbnails);
    this.#render({ travel: false });
    this.#say();
  }

  /** @param {number} place */
  go(place, { playing = false } = {}) {
    if (!playing) this.pause();
    this.state.set({ step: Math.min(Math.max(place, 0), this.steps.length - 1) });
  }

  play() {
    const last = this.steps.length - 1;
    this.go(this.state.get("step") === last ? 0 : this.state.get("step") + 1, { playing: true });
    this.timer = setInterval(() => {
      if (this.state.get("step") === last) this.pause();
      else this.go(this.state.get("step") + 1, { playing: true });
    }, PACE);
    this.#say();
  }

  pause() {
    if (!this.timer) return;
    clearInterval(this.timer);
    this.timer = null;
    this.#say();
  }

  /** @type {number | null} */
  timer = null;

  /** @type {Plot} */
  plot;

  #say() {
    this.button.textContent = this.timer ? "Pause" : "Play";
    // For who asks for less movement, a step is one press; nothing moves by itself.
    this.button.hidden = calm() || this.steps.length < 2;
    document.getElementById("space-plays").hidden = this.button.hidden;
  }

  /**
   * @param {Pointing} pointing
   * @param {(shape: number) => void} choose
   */
  #makeMap(pointing, choose) {
    const { database } = this;
    const surface = document.getElementById("step-surface");
    const overlay = svg("svg", { class: "overlay", "aria-hidden": "true" });
    const labels = new Labels(classNaming(database), overlay);
    this.plot = new Plot(database, {
      label: "Map of the step",
      margin: 30,
      selection: () => this.state.get("selection"),
      /** @param {number} index */
      mark: (index) => {
        const group = database.groups[index];
        return { path: database.symbol(group), color: database.color(group), radius: this.#radius, alpha: FULL };
      },
      drawn: () => {
        const { width, height } = this.plot.view;
        overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
        // Names come when the shapes have arrived.
        const map = this.maps.find((own) => own === this.plot.map);
        if (map === undefined) {
          labels.clear();
          return;
        }
        const points = this.plot.placed().map((shape) => ({ ...shape, group: database.groups[shape.index] }));
        labels.place(points, { width, height }, this.#radius);
        labels.follow((index) => this.plot.screen(index));
      },
    });
    surface.append(this.plot.node, overlay);
    toldAs(document.querySelector(".step-map"), () => {
      const compared = this.steps[this.state.get("step")].bins.map((column) => this.bins.names[column]);
      const shapes = this.selection.rows?.length ?? database.count;
      const words = `Map of ${count(shapes, "shape")}, compared by ${count(compared.length, "bin")}: ${compared.join(", ")}. Colour and mark: ${database.data.standIn ? "cluster" : "class"}.`;
      return { title: `Map of ${count(compared.length, "bin")}`, words, onPaper: true };
    });
    pointing.watch(surface, this.plot, choose, this.state);
  }

  get #radius() {
    return (
      Math.min(Math.max(92 / Math.sqrt(this.maps[0].x.length), 2.4), 5.5) *
      (this.plot.node.clientWidth < 420 ? 0.75 : 1)
    );
  }

  /**
   * @param {Chunk.PathStep} step
   * @param {number} place
   */
  #thumbnail(step, place) {
    const picture = pictureOfMap(this.database, this.maps[place], THUMBNAIL);
    picture.style.width = picture.style.height = `${THUMBNAIL}px`;
    return element(
      "li",
      {},
      element(
        "button",
        {
          type: "button",
          class: "path-step",
          "data-step": place,
          title: this.#words(place),
          "aria-label": this.#words(place),
          onclick: () => this.go(place),
        },
        picture,
        element("b", {}, figure(step.nh)),
      ),
    );
  }

  /**
   * "Step 3 of 26, 3 bins, NH 0.412: adds Agd:6".
   * @param {number} place
   */
  #words(place) {
    const { bins, added, removed, nh } = this.steps[place];
    /** @param {number[]} columns */
    const names = (columns) => columns.map((column) => this.bins.names[column]).join(", ");
    const changes = [
      added.length > 0 && `adds ${names(added)}`,
      removed.length > 0 && `removes ${names(removed)}`,
    ].filter(Boolean);
    return `Step ${place + 1} of ${this.steps.length}, ${count(bins.length, "bin")}, NH ${figure(nh)}: ${changes.join(", ")}`;
  }

  /** @param {{ travel: boolean }} parts */
  #render({ travel }) {
    const place = this.state.get("step");
    const step = this.steps[place];
    const before = this.steps[place - 1];
    this.plot.show(this.maps[place], { travel });
    document.getElementById("step-title").textContent = `Step ${place + 1} of ${this.steps.length}`;
    const change = before ? difference(before.nh, step.nh) : null;
    document.getElementById("step-nh").replaceChildren(
      symbol(),
      element("output", { class: "value" }, figure(step.nh)),
      ...(change === null
        ? []
        : [
            element(
              "span",
              {
                class: `change ${{ "+": "better", "−": "worse" }[change[0]] ?? ""}`,
                title: "Against the step before",
              },
              change,
            ),
          ]),
    );
    document.getElementById("step-change").replaceChildren(...this.#changes(step));
    document.getElementById("step-bins-title").textContent = `${count(step.bins.length, "bin")} in use`;
    document
      .getElementById("step-bins")
      .replaceChildren(
        ...step.bins.map((column) =>
          element("li", {}, this.chips.chip(column, { added: step.added.includes(column) })),
        ),
      );
    document.getElementById("step-open").href = this.open(step.bins);
    for (const button of this.list.querySelectorAll("button")) {
      const current = Number(button.dataset.step) === place;
      button.setAttribute("aria-current", current ? "step" : "false");
      button.tabIndex = current ? 0 : -1;
      // Only the strip moves, never the page.
      if (current)
        this.list.scrollTo({
          left: button.offsetLeft - this.list.offsetLeft - (this.list.clientWidth - button.offsetWidth) / 2,
          behavior: travel && !calm() ? "smooth" : "instant",
        });
    }
    document.getElementById("step-back").disabled = place === 0;
    document.getElementById("step-on").disabled = place === this.steps.length - 1;
    if (travel && !this.timer) this.announce(this.#words(place));
  }

  /**
   * What a step did: every bin that came or went.
   * @param {Chunk.PathStep} pathStep
   */
  #changes({ added, removed }) {
    /**
     * @param {number} column
     * @param {string} word
     */
    const line = (column, word) =>
      element(
        "p",
        {},
        element("b", { class: word === "added" ? "better" : "worse" }, word === "added" ? "+ " : "− "),
        this.chips.chip(column),
      );
    return [...added.map((column) => line(column, "added")), ...removed.map((column) => line(column, "removed"))];
  }

  /** @param {KeyboardEvent & Targeted} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const at = this.state.get("step");
    /** @type {Record<string, number>} */
    const steps = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: this.steps.length - 1 };
    if (event.key in steps) {
      this.go(steps[event.key]);
      const held = event.target.closest(".path-step");
      if (held) this.list.querySelector(`[data-step="${this.state.get("step")}"]`).focus({ preventScroll: true });
    } else if (event.key === " " && !event.target.closest("#play, #step-back, #step-on") && !this.button.hidden) {
      if (this.timer) this.pause();
      else this.play();
    } else return;
    event.preventDefault();
  }
}
