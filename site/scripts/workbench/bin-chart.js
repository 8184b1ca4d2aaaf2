// Fig. 5, view 3: a bar a bin, the chosen ones first with a blue border; find bins by name, choose them one by one,
// by range, or the best ones.

import { element } from "../base/dom.js";
import { count, figure, grouped } from "../base/words.js";
import { ranked } from "../bins-kit/bin-list.js";
import { BinGestures } from "./bin-gestures.js";
import { BinPlot } from "./bin-plot.js";

/** @import { Children } from "../base/dom.js" */
/** @import { Bins } from "../database/bins.js" */

/**
 * What the chart asks for, and says: it keeps no choice of its own, and is told by `draw`.
 * @typedef {object} Ways
 * @property {(column: number) => void} onToggle
 * @property {(columns: number[]) => void} onRange to add several
 * @property {(columns: number[]) => void} onRemove
 * @property {(() => void) | null} onFind to look for a few bins that make a better map, where there is one to look for
 * @property {(column: number | null, box: (Box & { free: number }) | null) => void} onPoint which bar is pointed at, and where it
 *   stands in the window, for the card
 * @property {(text: string) => void} announce
 *
 * @typedef {{ left: number, top: number, width: number, height: number }} Box
 * @typedef {"chosen" | "score" | "feature"} Order
 *
 * @typedef {object} Shown
 * @property {Float64Array} scores relative, a column; NaN for columns that are not in use
 * @property {Set<number>} chosen
 * @property {boolean} [busy]
 * @property {Set<number> | null} [matched] columns that something else on the page points at
 * @property {string | null} [separation] in words, what the scores separate
 * @property {string | null} [outcome] in words, what the chosen bins do
 * @property {boolean} [canFind] whether one may look for bins now
 */

const ORDERS = {
  chosen: ["Chosen first", "The chosen bins, then the others, each by score"],
  score: ["By score", "The best bins first, chosen or not"],
  feature: ["By feature", "The bins of each feature together: its chosen ones, then the others, each by score"],
};

export class BinChart {
  // The parts that a choice is made with.
  /** @type {HTMLInputElement} */
  field;
  /** @type {HTMLElement} */
  finding;
  /** @type {HTMLElement} */
  hint;
  /** @type {HTMLButtonElement} */
  take;
  /** @type {HTMLInputElement} */
  number;
  /** @type {HTMLButtonElement} */
  add;
  /** @type {HTMLButtonElement} */
  remove;
  /** @type {HTMLButtonElement} */
  clear;
  /** @type {HTMLButtonElement} */
  finder;
  /** @type {HTMLButtonElement} */
  closer;
  /** @type {HTMLElement} */
  reading;
  /** @type {HTMLElement} */
  key;

  /**
   * @param {HTMLElement} node
   * @param {Bins} bins
   * @param {Ways} ways
   */
  constructor(node, bins, { onToggle, onRange, onRemove, onFind, onPoint, announce }) {
    this.node = node;
    this.bins = bins;
    this.onToggle = onToggle;
    this.onRange = onRange;
    this.onRemove = onRemove;
    this.onFind = onFind;
    this.onPoint = onPoint;
    this.announce = announce;
    this.plot = new BinPlot(bins);
    /** @type {Float64Array} */
    this.scores = new Float64Array(0);
    /** @type {Set<number>} */
    this.chosen = new Set();
    /** @type {Set<number> | null} */
    this.emphasised = null;
    /** @type {Set<number> | null} */
    this.found = null;
    /** @type {string | null} */
    this.separation = null;
    /** @type {string | null} */
    this.outcome = null;
    /** @type {Order} */
    this.order = "chosen";
    this.busy = false;
    this.ranking = new Int32Array();
    this.rankOf = new Int32Array(bins.count);
    /** @type {number | null} */
    this.pointed = null;
    /** @type {[number, number] | null} */
    this.range = null;
    this.#build();
    this.gestures = new BinGestures(this.plot, this);
    this.plot.start();
  }

  // Where the arrow keys go on from a bin that has just moved away.
  /** @type {{ before: number | undefined, after: number | undefined } | null} */
  #beside = null;

  #build() {
    const { plot } = this;
    /**
     * @param {string} words
     * @param {string} title
     * @param {() => void} onclick
     */
    const button = (words, title, onclick) =>
      element("button", { type: "button", class: "plain", title, onclick }, words);
    this.closer = button("", "Show the first bars with their names", () => plot.lookClose());
    this.reading = element("p", { class: "reading" });
    this.key = element("p", { class: "key" });
    this.node.classList.add("bin-chart");
    const search = this.#searchTools();
    this.node.replaceChildren(
      element(
        "div",
        { class: "bin-tools" },
        search,
        radios("Order of the bars", "bin-order", ORDERS, this.order, (order) => {
          this.order = order;
          this.#arrange();
        }),
        element(
          "div",
          { class: "bin-zoom", role: "group", "aria-label": "Zoom" },
          button("−", "Zoom out (−)", () => plot.zoom(1 / 2)),
          button("+", "Zoom in (+)", () => plot.zoom(2)),
          this.closer,
          button("All", "Show all bars (0)", () => plot.lookAtAll()),
        ),
      ),
      this.hint,
      element("div", { class: "bin-tools" }, this.reading, this.#choiceTools()),
      plot.node,
      this.key,
      element(
        "p",
        { id: "bin-keys", class: "unseen" },
        "Arrow keys go from bar to bar, Page Up and Page Down further, Home and End to the first and the last. Space or Enter chooses a bin, or gives it up. Shift with arrow keys marks a range, which Enter adds and Delete removes. Plus and minus zoom, zero shows all, Escape lets go.",
      ),
    );
  }

  #searchTools() {
    const { bins } = this;
    this.field = element("input", {
      type: "search",
      id: "bin-search",
      placeholder: `Find bins: thick, handle, ${bins.shortName(bins.count - 1, 16)}`,
      title: "Enter goes from match to match",
      "aria-label": "Find bins by a word or by name",
      autocomplete: "off",
      spellcheck: "false",
      onfocus: () => bins.prepareToFind(),
      oninput: () => this.#search(),
      onkeydown: (event) => this.#searchKey(event),
      onblur: () => this.point(null),
    });
    this.finding = element("span", { class: "finding" });
    this.hint = element("p", { class: "quiet", hidden: true });
    this.take = element("button", {
      type: "button",
      class: "plain",
      id: "bin-take",
      hidden: true,
      onclick: () => this.apply(this.#matches()),
    });
    return element("div", { class: "search", role: "search" }, this.field, this.finding, this.take);
  }

  #choiceTools() {
    /**
     * @param {string} id
     * @param {string} words
     * @param {() => void} onclick
     */
    const action = (id, words, onclick) => element("button", { type: "button", class: "plain", id, onclick }, words);
    this.number = element("input", {
      type: "number",
      id: "bin-number",
      min: 1,
      max: this.bins.count,
      value: 10,
      "aria-label": "How many bins to add or remove",
      oninput: () => this.#offer(),
      onchange: () => (this.number.value = String(this.#wanted)),
    });
    this.add = action("bin-add", "Add the best", () => this.#add(this.#best()));
    this.remove = action("bin-remove", "Remove the weakest", () => this.giveUp(this.#weakest()));
    this.clear = action("bin-clear", "Clear", () => this.giveUp([...this.chosen]));
    this.finder = action("bin-find", "Find a set", () => this.onFind?.());
    this.finder.title = "Look for a few bins whose map keeps what is in use apart better; a worse one is not taken";
    this.finder.hidden = this.onFind === null;
    return element(
      "div",
      { class: "bin-best", role: "group", "aria-label": "Choose bins by score" },
      element("div", { class: "so-many" }, this.number, this.add, this.remove),
      this.clear,
      this.finder,
    );
  }

  /**
   * Show scores and a choice.
   * @param {Shown} shown
   */
  draw({ scores, chosen, busy = false, matched = null, separation = null, outcome = null, canFind = false }) {
    const scored = scores !== this.scores;
    const arranged = scored || chosen !== this.chosen;
    if (scored) {
      this.ranking = ranked(scores);
      this.rankOf.fill(0);
      this.ranking.forEach((column, place) => (this.rankOf[column] = place + 1));
    }
    this.scores = scores;
    this.chosen = chosen;
    this.emphasised = matched;
    this.separation = separation;
    this.outcome = outcome;
    this.finder.disabled = !canFind;
    this.busy = busy;
    this.plot.surface.setAttribute("aria-busy", String(busy));
    this.node.classList.toggle("busy", busy);
    this.#explain();
    if (arranged) this.#arrange(this.#held && !scored);
    else {
      this.#match();
      this.#read();
    }
  }

  /** Take the colours of the theme in use. */
  start() {
    this.plot.start();
    this.#read();
  }

  resize() {
    this.plot.resize();
    this.#offer();
  }

  /** Whether a pointer is over the bars. */
  #held = false;

  /** Whether bars stand where they did before the last choice. */
  #due = false;

  /**
   * Under a pointer a choice moves no bar: the next click would meet another one. They move when it has left.
   * @param {boolean} held
   */
  hold(held) {
    this.#held = held;
    if (!held && this.#due) this.#arrange();
  }

  /** All columns in the order of their bars. */
  #ordered() {
    const { chosen, order, ranking } = this;
    if (order === "score") return ranking;
    /** @type {number[][]} */
    const groups = Array.from({ length: 2 * this.bins.features.length }, () => []);
    for (const column of ranking)
      groups[(order === "feature" ? 2 * this.bins.featureOf(column) : 0) + (chosen.has(column) ? 0 : 1)].push(column);
    return Int32Array.from(groups.flat());
  }

  /**
   * Show the bars in their order, or, `still`, where they stand.
   * @param {boolean} [still]
   */
  #arrange(still = false) {
    const { scores, chosen } = this;
    this.#due = still;
    this.mark(null);
    this.plot.show({ scores, chosen, places: still ? this.plot.places : this.#ordered() });
    if (this.pointed !== null && this.rankOf[this.pointed] === 0) this.point(null);
    this.#search();
    this.#offer();
    this.#read();
  }

  // Choosing

  /**
   * Choose a bin or give it up. It may move away, but the arrow keys go on from where it was.
   * @param {number} column
   */
  toggle(column) {
    const { places, placeOf } = this.plot;
    const place = placeOf[column];
    this.#beside = { before: places[place - 1], after: places[place + 1] };
    const before = this.chosen;
    this.onToggle(column);
    const [words, size] = before.has(column) ? ["removed", before.size - 1] : ["chosen", before.size + 1];
    this.announce(`${this.bins.names[column]} ${words}, ${count(size, "bin")} chosen`);
  }

  /**
   * Add what of some columns is not chosen yet; where all are chosen, remove them.
   * @param {number[]} columns
   */
  apply(columns) {
    if (columns.length === 0) return;
    const fresh = columns.filter((column) => !this.chosen.has(column));
    if (fresh.length > 0) this.#add(fresh);
    else this.giveUp(columns);
  }

  /**
   * Remove those of some columns that are chosen.
   * @param {number[]} columns
   */
  giveUp(columns) {
    const kept = columns.filter((column) => this.chosen.has(column));
    this.#change(
      this.onRemove,
      kept,
      `${count(kept.length, "bin")} removed, ${count(this.chosen.size - kept.length, "bin")} chosen`,
    );
  }

  /** @param {number[]} columns */
  #add(columns) {
    this.#change(
      this.onRange,
      columns,
      `${count(columns.length, "bin")} added, ${count(this.chosen.size + columns.length, "bin")} chosen`,
    );
  }

  /**
   * @param {(columns: number[]) => void} ask
   * @param {number[]} columns
   * @param {string} words
   */
  #change(ask, columns, words) {
    this.mark(null);
    if (columns.length === 0) return;
    ask(columns);
    this.announce(words);
  }

  get #wanted() {
    return Math.min(Math.max(Math.floor(Number(this.number.value)) || 1, 1), this.bins.count);
  }

  /** The best bins that are not chosen yet; those with a score of 0 separate nothing. */
  #best() {
    return this.#first(this.ranking, (column) => !this.chosen.has(column) && this.scores[column] > 0);
  }

  #weakest() {
    return this.#first(this.ranking.toReversed(), (column) => this.chosen.has(column));
  }

  /**
   * As many columns as are wanted for which something holds.
   * @param {Iterable<number>} columns
   * @param {(column: number) => boolean} holds
   */
  #first(columns, holds) {
    const wanted = this.#wanted;
    /** @type {number[]} */
    const found = [];
    for (const column of columns) {
      if (found.length === wanted) break;
      if (holds(column)) found.push(column);
    }
    return found;
  }

  /** Which of the buttons have something to do, and with how many bins. */
  #offer() {
    const [best, weakest] = [this.#best().length, this.#weakest().length];
    this.closer.textContent = `First ${this.plot.close}`;
    this.closer.hidden = this.plot.close >= this.ranking.length;
    this.add.disabled = best === 0;
    this.add.title =
      best === 0
        ? "No bin with a score is left to add"
        : `${count(best, "bin")} with the highest scores, of those not chosen yet`;
    this.remove.disabled = weakest === 0;
    this.remove.title =
      weakest === 0
        ? "No bin with a score is chosen"
        : `${count(weakest, "bin")} with the lowest scores, of those chosen`;
    this.clear.disabled = this.chosen.size === 0;
  }

  // Finding

  #search() {
    const text = this.field.value.trim();
    this.found = text === "" ? null : new Set(this.bins.find(text));
    this.#match();
    const matches = this.#matches();
    this.take.hidden = matches.length === 0;
    this.take.textContent = `${matches.every((column) => this.chosen.has(column)) ? "Remove" : "Add"} ${grouped(matches.length)}`;
    this.finding.textContent = this.#finding(matches);
    const none = this.found?.size === 0;
    this.hint.hidden = !none;
    if (none) this.hint.textContent = this.bins.searchHint;
  }

  /** @param {number[]} matches */
  #finding(matches) {
    if (this.found === null) return "";
    if (matches.length === 0) return this.found.size > 0 ? "not in use" : "none found";
    const place = matches.indexOf(this.pointed ?? -1);
    return place < 0 ? `${grouped(matches.length)} found` : `${grouped(place + 1)} of ${grouped(matches.length)}`;
  }

  #match() {
    const matched = this.found ?? this.emphasised;
    if (matched !== this.plot.matched) this.plot.match(matched);
  }

  /** The columns found, in the order of their bars. */
  #matches() {
    const { placeOf } = this.plot;
    return [...(this.found ?? [])].filter((column) => placeOf[column] >= 0).sort((a, b) => placeOf[a] - placeOf[b]);
  }

  /** @param {KeyboardEvent} event */
  #searchKey(event) {
    if (event.key === "Enter" || event.key === "ArrowDown" || event.key === "ArrowUp") {
      this.#visit(event.key === "ArrowUp" || event.shiftKey ? -1 : 1);
    } else if (event.key === "Escape" && this.field.value !== "") {
      this.field.value = "";
      this.#search();
      this.point(null);
    } else return;
    event.preventDefault();
  }

  /**
   * Point at the next match, or the one before.
   * @param {1 | -1} direction
   */
  #visit(direction) {
    const matches = this.#matches();
    if (matches.length === 0) {
      this.announce(this.#finding(matches));
      return;
    }
    const from = matches.indexOf(this.pointed ?? -1);
    const next = from < 0 && direction < 0 ? matches.length - 1 : (from + direction + matches.length) % matches.length;
    this.visit(matches[next]);
    this.finding.textContent = this.#finding(matches);
  }

  // Pointing

  /**
   * Point at a column, or at none with null.
   * @param {number | null} column
   */
  point(column) {
    if (column === this.pointed) return;
    this.pointed = column;
    this.#beside = null;
    this.#show();
    this.onPoint(
      column,
      column === null
        ? null
        : { ...this.plot.box(this.plot.placeOf[column]), free: this.node.getBoundingClientRect().top },
    );
  }

  /**
   * Point at a column wherever it stands, and say which it is.
   * @param {number} column
   */
  visit(column) {
    this.plot.reveal(this.plot.placeOf[column]);
    this.point(column);
    this.announce(
      `${this.bins.names[column]}, rank ${grouped(this.rankOf[column])} of ${grouped(this.ranking.length)}, score ${figure(this.scores[column])}${this.chosen.has(column) ? ", chosen" : ""}`,
    );
  }

  /**
   * Point at the bar some places further; beside the old place of one that has just been chosen.
   * @param {number} number
   */
  step(number) {
    const { places, placeOf } = this.plot;
    if (places.length === 0) return;
    const beside = number === 1 ? this.#beside?.after : number === -1 ? this.#beside?.before : undefined;
    const from = this.pointed === null ? Math.floor(this.plot.scale.left) - Math.sign(number) : placeOf[this.pointed];
    this.visit(beside ?? places[Math.min(Math.max(from + number, 0), places.length - 1)]);
  }

  /**
   * Mark a range of places, from one to another in any order.
   * @param {[number, number] | null} range
   */
  mark(range) {
    this.range = range;
    this.#show();
  }

  /** The columns of the range. */
  get marked() {
    if (this.range === null) return [];
    return [...this.plot.places.subarray(Math.min(...this.range), Math.max(...this.range) + 1)];
  }

  #show() {
    this.plot.mark(this.pointed, this.range);
    this.#read();
  }

  #read() {
    const { bins, pointed } = this;
    /** @type {(Children | false)[]} */
    let parts;
    if (this.range !== null) {
      const columns = this.marked;
      const kept = columns.every((column) => this.chosen.has(column));
      parts = [
        element("b", {}, count(columns.length, "bin")),
        `${bins.names[columns[0]]} to ${bins.names[columns.at(-1)]}`,
        kept ? "all chosen: to be removed" : "to be added",
      ];
    } else if (pointed !== null) {
      parts = [
        element("b", {}, this.#hued(bins.featureOf(pointed)), element("bdi", {}, bins.names[pointed])),
        ["rank ", element("b", {}, grouped(this.rankOf[pointed])), ` of ${grouped(this.ranking.length)}`],
        ["score ", element("b", {}, figure(this.scores[pointed]))],
        this.chosen.has(pointed) ? "chosen" : null,
      ];
    } else {
      parts = [
        [
          element("b", {}, grouped(this.chosen.size)),
          this.ranking.length > 0
            ? ` of ${count(this.ranking.length, "bin")} chosen`
            : ` ${this.chosen.size === 1 ? "bin" : "bins"} chosen`,
        ],
        this.outcome,
        ...this.#census(),
      ];
    }
    this.reading.replaceChildren(...parts.filter(Boolean).map((part) => element("span", {}, part)));
  }

  /** @param {number} feature */
  #hued(feature) {
    const mark = element("i", { class: "hued" });
    mark.style.background = this.bins.colorOf(feature);
    return mark;
  }

  /** How many of the chosen bins each feature has. */
  #census() {
    /** @type {Map<number, number>} */
    const counts = new Map();
    for (const column of this.chosen)
      counts.set(this.bins.featureOf(column), (counts.get(this.bins.featureOf(column)) ?? 0) + 1);
    return [...counts]
      .sort(([a, some], [b, others]) => others - some || a - b)
      .map(([feature, number]) => [
        this.#hued(feature),
        element("bdi", {}, this.bins.features[feature].name),
        ` ${number}`,
      ]);
  }

  #explain() {
    if (this.ranking.length === 0 && !this.busy) {
      this.key.textContent = "No bars: there is nothing to tell apart. What is missing stands after “Separate”.";
      return;
    }
    const touched = window.matchMedia("(pointer: coarse)").matches;
    const sentences = [
      "A bar a bin: a share of the surface in a small range of a feature, or a value of the whole shape",
      ...(this.separation === null
        ? []
        : ["; the higher, the better it alone separates ", element("b", {}, this.separation)]),
      ".",
      element(
        "span",
        { class: "on-screen" },
        touched ? " Tap one to read it, again to choose it." : " Click or drag to choose.",
      ),
    ];
    this.key.replaceChildren(...sentences);
  }
}

/**
 * @template {string} Value
 * @param {string} label
 * @param {string} name
 * @param {Record<Value, string[]>} options words and a title by value
 * @param {Value} checked
 * @param {(value: Value) => void} changed
 */
function radios(label, name, options, checked, changed) {
  return element(
    "div",
    { class: "choice", role: "radiogroup", "aria-label": label, id: name },
    /** @type {[Value, string[]][]} */ (Object.entries(options)).map(([value, [words, title]]) =>
      element(
        "label",
        { title },
        element("input", { type: "radio", name, value, checked: value === checked, onchange: () => changed(value) }),
        element("span", {}, words),
      ),
    ),
  );
}
