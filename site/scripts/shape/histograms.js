// The histograms of a shape, one a feature, against those of its class and of all shapes.

import { joinNames } from "../addresses/names.js";
import { element, focused } from "../base/dom.js";
import { toldAs } from "../base/snapshot.js";
import { capitalised, count, isolated, measured, percent, shortened, wholePercent } from "../base/words.js";
import { axisEnd } from "../bins-kit/bin-bars.js";
import { quantityInWords } from "../bins-kit/legend.js";
import { hue } from "./hue.js";
import { kind } from "../database/kind.js";

/** @import { Child } from "../base/dom.js" */
/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { LevelSpread } from "./level-spread.js" */
/** @import { Spread } from "./spread.js" */
/** @import { ValueCard } from "./value-card.js" */

/**
 * What a column is of a shape and of those it is compared with, in words.
 * @typedef {{ own: string, fellows: string | null, all: string | null, rank: string | null }} Told
 */

const LONGEST = 90;
/** Below so much of the axis, half a class or database is a line. */
const FLAT = 0.02;

export class Histograms {
  /**
   * `dimensions` are those of the chunk "selection": what each measures, and where its bins end.
   * @param {Database} database
   * @param {Bins} bins
   * @param {ShapeState} state
   * @param {{ spread: Spread | LevelSpread, dimensions: Chunk.Dimension[], card: ValueCard }} parts
   */
  constructor(database, bins, state, { spread, dimensions, card }) {
    this.database = database;
    this.bins = bins;
    this.state = state;
    this.spread = spread;
    this.dimensions = dimensions;
    this.card = card;
    this.section = document.getElementById("histograms");
    this.grid = document.getElementById("histogram-grid");
    toldAs(this.section, () => {
      const name = isolated(database.names.at(state.get("shape") ?? 0));
      return {
        title: `The features of ${name}`,
        words: `${count(bins.features.length, "feature")} of ${name}, one of ${count(database.count, "shape")}: how much of the surface has values from low (left) to high (right); of features of the whole shape, where its value lies between the least and the most of all. Of many parts, the one in which it stands out most.`,
      };
    });
    this.panels = bins.features.map((_, feature) => {
      const panel = element("figure", { class: "histogram" });
      this.grid.append(panel);
      return { feature, panel };
    });
    state.listen((changed) => {
      if (["shape", "parts", "theme"].some((name) => changed.has(name))) this.render();
      else if (changed.has("bin")) this.#mark();
    });
  }

  async render() {
    const shape = this.state.get("shape");
    if (shape === null) return;
    await this.spread.know(shape);
    if (this.state.get("shape") !== shape) return;
    document.getElementById("histogram-key").replaceChildren(...this.#key(shape));
    for (const { feature, panel } of this.panels) this.#fill(panel, feature, shape);
    this.#mark();
  }

  /**
   * The dimension of a feature that is shown: the one that was chosen, else the one in which the shape stands out most.
   * @param {number} feature
   * @param {number} shape
   */
  partOf(feature, shape) {
    const { dimensions, name } = this.bins.features[feature];
    if (dimensions === 1) return 0;
    const start = `${joinNames([name])}[`;
    const word = this.state
      .get("parts")
      .split(" ")
      .findLast((/** @type {string} */ part) => part.startsWith(start));
    const chosen = word === undefined ? NaN : Number(word.slice(start.length, -1));
    return Number.isInteger(chosen) && chosen >= 0 && chosen < dimensions
      ? chosen
      : this.spread.mostUnusual(feature, shape);
  }

  /**
   * What a column is of one shape and of those it is compared with, in words.
   * @param {number} column
   * @param {number} shape
   */
  tell(column, shape) {
    const told = this.bins.telling(column);
    const fellows = this.spread.fellows(column, shape);
    const all = this.spread.all(column);
    /** @param {{ low: number, high: number }} band */
    const half = ({ low, high }) => (told(low) === told(high) ? told(low) : `${told(low)} to ${told(high)}`);
    return {
      own: told(this.bins.share(column, shape)),
      fellows: fellows && half(fellows),
      all: this.database.count > 1 ? half(all) : null,
      rank: this.database.count > 1 ? `${wholePercent(this.spread.rank(column, shape))} of all` : null,
    };
  }

  /** What is in sight, bin by bin, for the tables: `[name, own, fellows, all]` each. */
  rows() {
    const shape = this.state.get("shape");
    if (shape === null) return [];
    return this.bins.features.flatMap(({ start, bins: width }, feature) => {
      const first = start + this.partOf(feature, shape) * width;
      return Array.from({ length: width }, (_, place) => {
        const { own, fellows, all } = this.tell(first + place, shape);
        return [this.bins.names[first + place], own, fellows ?? "–", all ?? "–"];
      });
    });
  }

  /** @param {number} shape */
  #key(shape) {
    const { database } = this;
    const group = database.groups[shape];
    /**
     * @param {string} name
     * @param {string} [color]
     */
    const mark = (name, color) => {
      const node = element("i", { class: `mark ${name}` });
      if (color) node.style.borderColor = color;
      return node;
    };
    return [
      element("span", {}, mark("own"), "this shape"),
      this.spread.fellows(0, shape) &&
        element(
          "span",
          {},
          mark("fellows", database.color(group)),
          "the middle half of the others in ",
          element("bdi", {}, shortened(database.className(group), 40)),
        ),
      database.count > 1 && element("span", {}, mark("all"), "the middle half of all shapes"),
    ].filter(Boolean);
  }

  /**
   * @param {HTMLElement} panel
   * @param {number} feature
   * @param {number} shape
   */
  #fill(panel, feature, shape) {
    const { bins } = this;
    const { start, dimensions, bins: width, title, name } = bins.features[feature];
    const part = this.partOf(feature, shape);
    const columns = Array.from({ length: width }, (_, place) => start + part * width + place);
    const kept = panel.contains(focused()) ? focused().dataset : null;
    panel.replaceChildren(
      element(
        "figcaption",
        {},
        element(
          "h3",
          {},
          hue(bins.colorOf(feature)),
          element("bdi", {}, shortened(title, 60)),
          title !== name && element("span", { class: "quiet" }, ` ${shortened(name, 16)}`),
        ),
        dimensions > 1 && this.#parts(feature, part),
      ),
      ...(width > 1 ? this.#bars(columns, shape) : this.#strip(columns[0], shape)),
    );
    if (kept?.column)
      panel
        .querySelector(`[data-column="${start + part * width + ((Number(kept.column) - start) % width)}"]`)
        ?.focus({ preventScroll: true });
    else if (kept?.part !== undefined) panel.querySelector("select").focus({ preventScroll: true });
  }

  /**
   * A choice among the dimensions of a feature.
   * @param {number} feature
   * @param {number} part
   */
  #parts(feature, part) {
    const { dimensions, name } = this.bins.features[feature];
    /** @type {HTMLSelectElement} */
    const choice = element(
      "select",
      { "data-part": "", "aria-label": `Part of ${name}`, onchange: () => this.#choose(feature, Number(choice.value)) },
      Array.from({ length: dimensions }, (_, dimension) => {
        const quantity = this.#quantity(feature, dimension);
        return element("option", { value: dimension }, `[${dimension}] ${shortened(quantity, LONGEST)}`);
      }),
    );
    choice.value = String(part);
    return choice;
  }

  /**
   * @param {number} feature
   * @param {number} part
   */
  #choose(feature, part) {
    const name = joinNames([this.bins.features[feature].name]);
    const others = this.state
      .get("parts")
      .split(" ")
      .filter((/** @type {string} */ word) => word !== "" && !word.startsWith(`${name}[`));
    this.state.set({ parts: [...others, `${name}[${part}]`].join(" ") });
  }

  /**
   * @param {number} feature
   * @param {number} dimension
   */
  #quantity(feature, dimension) {
    const { start, bins: width } = this.bins.features[feature];
    const place = this.bins.dimensionOf(start + dimension * width);
    return place === null
      ? this.bins.called[start + dimension * width] || "a value that was brought along"
      : this.dimensions[place].quantity;
  }

  /**
   * @param {number[]} columns
   * @param {number} shape
   */
  #bars(columns, shape) {
    const { bins, spread, database } = this;
    const group = database.groups[shape];
    const own = columns.map((column) => bins.share(column, shape));
    const fellows = columns.map((column) => spread.fellows(column, shape));
    const all = columns.map((column) => spread.all(column));
    const end = Math.min(
      axisEnd(Math.max(...own, ...fellows.map((band) => band?.high ?? 0), ...all.map(({ high }) => high))),
      1,
    );
    /** @param {number} value */
    const height = (value) => `${Math.min((100 * value) / end, 100)}%`;
    /**
     * @param {string} name
     * @param {{ low: number, high: number }} half
     * @param {string} [color]
     */
    const band = (name, { low, high }, color) => {
      const node = element("i", { class: high - low < FLAT * end ? `${name} flat` : name });
      node.style.bottom = height(low);
      node.style.height = `max(${height(high - low)}, 2px)`;
      if (color) node.style.borderColor = color;
      return node;
    };
    const { quantity, unit, edges } = this.dimensions[/** @type {number} */ (bins.dimensionOf(columns[0]))];
    return [
      element(
        "div",
        {
          class: "bars",
          role: "group",
          "aria-label": `${bins.names[columns[0]].split(":")[0]}: arrow keys go through its bins`,
          onkeydown: (event) => this.#walk(event),
        },
        element("span", { class: "end", "aria-hidden": "true" }, percent(end)),
        columns.map((column, place) => {
          const bar = element("i", { class: "own" });
          bar.style.height = height(own[place]);
          bar.style.background = bins.color(column);
          return this.#button(column, place === 0, shape, [
            database.count > 1 && band("all", all[place]),
            bar,
            fellows[place] && band("fellows", fellows[place], database.color(group)),
          ]);
        }),
      ),
      element(
        "div",
        { class: "ticks", "aria-hidden": "true" },
        edges.slice(1, -1).map((edge) => element("span", {}, measured(edge))),
      ),
      element("p", { class: "quantity" }, quantityInWords(quantity, unit)),
    ];
  }

  /**
   * A value of the whole shape, on the range that all shapes have.
   * @param {number} column
   * @param {number} shape
   */
  #strip(column, shape) {
    const { bins, spread, database } = this;
    const all = spread.all(column);
    const fellows = spread.fellows(column, shape);
    /** @param {number} value */
    const across = (value) => `${all.most > all.least ? (100 * (value - all.least)) / (all.most - all.least) : 50}%`;
    /**
     * @param {string} name
     * @param {{ low: number, high: number }} half
     * @param {string} [color]
     */
    const band = (name, { low, high }, color) => {
      const node = element("i", { class: name });
      node.style.left = across(low);
      node.style.width = `max(calc(${across(high)} - ${across(low)}), 2px)`;
      if (color) node.style.borderColor = color;
      return node;
    };
    const own = element("i", { class: "own" });
    own.style.left = across(bins.share(column, shape));
    own.style.background = bins.color(column);
    return [
      element(
        "div",
        { class: "value-strip" },
        this.#button(column, true, shape, [
          database.count > 1 && band("all", all),
          fellows && band("fellows", fellows, database.color(database.groups[shape])),
          own,
        ]),
      ),
      element(
        "div",
        { class: "strip-ends", "aria-hidden": "true" },
        [all.least, all.most].map((value) => element("span", {}, bins.telling(column)(value))),
      ),
      element(
        "p",
        { class: "quantity" },
        bins.called[column] ? capitalised(bins.called[column]) : "A feature that was brought along",
        ": its value, from the least to the most of all shapes",
      ),
    ];
  }

  /**
   * @param {number} column
   * @param {boolean} first
   * @param {number} shape
   * @param {Child[]} content
   */
  #button(column, first, shape, content) {
    const { bins } = this;
    /** @param {PointerEvent & Targeted | FocusEvent & Targeted} event */
    const show = (event) => this.card.show(column, this.tell(column, shape), event.currentTarget);
    const { own, fellows, all } = this.tell(column, shape);
    const said = [
      `${bins.names[column]}: this shape ${own}`,
      fellows && `others of its ${kind(this.database)} ${fellows}`,
      all && `all shapes ${all}`,
    ]
      .filter(Boolean)
      .join(", ");
    return element(
      "button",
      {
        type: "button",
        class: "of-bin-button",
        tabindex: first ? "0" : "-1",
        "data-column": column,
        "aria-label": said,
        onclick: () =>
          this.state.set({ bin: this.state.get("bin") === bins.names[column] ? null : bins.names[column] }),
        onpointerenter: (event) => event.pointerType === "mouse" && show(event),
        onpointerleave: () => this.card.hide(),
        onfocus: (event) => {
          this.#makeStop(event.currentTarget);
          if (event.currentTarget.matches(":focus-visible")) show(event);
        },
        onblur: () => this.card.hide(),
      },
      content,
    );
  }

  /** @param {Found} button */
  #makeStop(button) {
    for (const other of button.parentElement.querySelectorAll("button")) other.tabIndex = other === button ? 0 : -1;
  }

  /** @param {KeyboardEvent & Targeted} event */
  #walk(event) {
    /** @type {Record<string, number>} */
    const steps = { ArrowRight: 1, ArrowLeft: -1, Home: -Infinity, End: Infinity };
    if (!(event.key in steps)) return;
    event.preventDefault();
    const buttons = [...event.currentTarget.querySelectorAll("button")];
    const next = buttons.indexOf(focused()) + steps[event.key];
    buttons[Math.min(Math.max(next, 0), buttons.length - 1)].focus();
  }

  #mark() {
    const column = this.bins.names.indexOf(this.state.get("bin") ?? "");
    for (const button of this.grid.querySelectorAll("button"))
      button.setAttribute("aria-pressed", String(Number(button.dataset.column) === column));
  }
}
