// Which classes are alike: of the nearest neighbours of each class, how many belong to each other class.

import { compareAddress } from "../addresses/compare.js";
import { galleryOf } from "../addresses/shapes.js";
import { element, picture, swatch } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { toldAs } from "../base/snapshot.js";
import { count, grouped, isolated, shortened, wholePercent } from "../base/words.js";
import { kind } from "../database/kind.js";
import { writeSelection } from "../database/selection.js";

/** @import { CompareState } from "../addresses/compare.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Neighbours } from "./neighbours.js" */

const PAIRS = 8;
const MOST_BEHIND = 24;
const NEAR = 3;

/** From so many classes on, cells are too small for figures. */
const MOST_FIGURES = 20;

export class Matrix {
  /** @type {number[][]} */
  counts = [];
  /** @type {Found} */
  words;

  /**
   * @param {Database} database
   * @param {Chunk.Comparison} data
   * @param {Neighbours} neighbours
   * @param {CompareState} state
   * @param {{ announce: (text: string) => void }} parts
   */
  constructor(database, data, neighbours, state, { announce }) {
    this.database = database;
    this.data = data;
    this.neighbours = neighbours;
    this.state = state;
    this.announce = announce;
    this.node = document.getElementById("matrix");
    if (this.node === null) return;
    this.words = document.getElementById("cell-words");
    toldAs(this.node.closest("[data-figure]"), () => ({
      words: `Of the ${count(neighbours.k, "nearest neighbour")} of the shapes of each ${kind(this.database)} (row), how many in a hundred are of each ${kind(this.database)} (column), ${this.#where()}; ${count(database.count, "shape")}. The diagonal is a ${kind(this.database)}’s own share.`,
    }));
    this.node.addEventListener("keydown", (event) => this.#key(event));
    this.node.addEventListener("pointerover", (event) => this.#point(event.target.closest("[data-row]")));
    this.node.addEventListener("pointerleave", () => this.#point(null));
    this.node.addEventListener("focusin", (event) => this.#point(event.target.closest("[data-row]")));
    this.node.addEventListener("click", (event) => {
      const cell = event.target.closest("[data-row]");
      if (cell) this.#open(Number(cell.dataset.row), Number(cell.dataset.column));
    });
    const inputs = document.querySelectorAll("#spaces input");
    for (const input of inputs) input.addEventListener("change", () => state.set({ space: input.value }));
    state.listen((changed) => {
      if (["view", "space", "theme"].some((name) => changed.has(name))) this.render();
      else if (changed.has("row") || changed.has("column")) this.#behind();
    });
  }

  /** Where neighbours are looked for, in words. */
  #where() {
    const checked = document.querySelector("#spaces input:checked");
    const title = checked?.parentElement?.textContent?.trim() ?? "";
    return checked?.value === this.neighbours.spaces[0] ? `compared by ${title}` : `on the map by ${title}`;
  }

  async render() {
    const { state, node } = this;
    if (state.get("view") !== "classes" || node === null) return;
    const space = state.get("space");
    await this.neighbours.know(space);
    if (state.get("space") !== space) return;
    for (const input of document.querySelectorAll("#spaces input")) input.checked = input.value === state.get("space");
    this.counts = this.neighbours.matrix(state.get("space"));
    this.#likest();
    this.#draw();
    this.#behind();
  }

  /**
   * Of the neighbours of a class, the share that belongs to another.
   * @param {number} row
   * @param {number} column
   */
  share(row, column) {
    return this.counts[row][column] / ((this.database.sizes.get(row) ?? 0) * this.neighbours.k);
  }

  #likest() {
    const { database, state } = this;
    const pairs = this.neighbours.likest(state.get("space")).slice(0, PAIRS);
    document.getElementById("likest").replaceChildren(
      ...pairs.map(({ group, other, there, back }) => {
        const [from, to, most, least] = there >= back ? [group, other, there, back] : [other, group, back, there];
        return element(
          "li",
          {},
          element(
            "button",
            { type: "button", class: "plain pair-of", onclick: () => this.#open(from, to) },
            this.#name(from),
            " → ",
            this.#name(to),
          ),
          element("span", { class: "quiet" }, `${wholePercent(most)}, back ${wholePercent(least)}`),
        );
      }),
    );
    document.getElementById("likest-none").hidden = pairs.length > 0;
    document.getElementById("likest-none").textContent =
      database.classes.length > 1 ? `No shape has a neighbour of another ${kind(database)}: they are all apart.` : "";
  }

  #draw() {
    const { database, data, node, state } = this;
    const order = data.order;
    const figures = order.length <= MOST_FIGURES;
    const highest = Math.max(
      ...order.flatMap((row) => order.filter((column) => column !== row).map((column) => this.share(row, column))),
      1e-9,
    );
    const at =
      state.get("row") !== null && state.get("column") !== null
        ? [state.get("row"), state.get("column")]
        : [order[0], order[0]];
    const head = element(
      "tr",
      {},
      element("td", { class: "corner" }, element("span", { class: "quiet" }, "neighbours →")),
      order.map((column) =>
        element(
          "th",
          { scope: "col", title: database.className(column) },
          element(
            "span",
            {},
            swatch(database.symbol(column), database.color(column)),
            element("bdi", {}, shortened(database.className(column), 24)),
          ),
        ),
      ),
    );
    const rows = order.map((row) =>
      element(
        "tr",
        {},
        element(
          "th",
          { scope: "row", title: database.className(row) },
          element("bdi", {}, shortened(database.className(row), 24)),
          swatch(database.symbol(row), database.color(row)),
        ),
        order.map((column) => {
          const share = this.share(row, column);
          const cell = element(
            "td",
            {
              "data-row": row,
              "data-column": column,
              tabindex: at[0] === row && at[1] === column ? "0" : "-1",
              class: row === column ? "own" : null,
              "aria-label": this.#sentence(row, column),
            },
            figures && share > 0 ? Math.round(100 * share) || "<1" : "",
          );
          const much = row === column ? share * 0.35 : share > 0 ? 0.12 + 0.88 * Math.sqrt(share / highest) : 0;
          cell.style.setProperty("--much", String(much));
          return cell;
        }),
      ),
    );
    node.style.setProperty("--classes", String(order.length));
    node.classList.toggle("many", !figures);
    node.replaceChildren(element("thead", {}, head), element("tbody", {}, rows));
  }

  /** @param {number} group */
  #name(group) {
    const { database } = this;
    return element(
      "span",
      { class: "called" },
      swatch(database.symbol(group), database.color(group)),
      element("bdi", {}, shortened(database.className(group), 32)),
    );
  }

  /**
   * @param {number} row
   * @param {number} column
   */
  #sentence(row, column) {
    const { database, neighbours } = this;
    const names = [row, column].map((group) => isolated(database.className(group)));
    const all = (database.sizes.get(row) ?? 0) * neighbours.k;
    return row === column
      ? `${names[0]}: ${wholePercent(this.share(row, row))} of the neighbours of its shapes are of its own ${kind(database)}`
      : `${names[0]} to ${names[1]}: ${wholePercent(this.share(row, column))}, ${this.counts[row][column]} of ${all} neighbours`;
  }

  /** @param {Found | null} cell */
  #point(cell) {
    for (const marked of this.node.querySelectorAll(".lit")) marked.classList.remove("lit");
    if (cell === null) {
      this.words.textContent = this.words.dataset.empty ?? "";
      return;
    }
    const [row, column] = [Number(cell.dataset.row), Number(cell.dataset.column)];
    this.words.textContent = `${this.#sentence(row, column)}.`;
    cell.parentElement.firstElementChild.classList.add("lit");
    this.node.querySelectorAll("thead th")[this.data.order.indexOf(column)].classList.add("lit");
  }

  /** @param {KeyboardEvent & Targeted} event */
  #key(event) {
    const cell = event.target.closest("[data-row]");
    if (!cell) return;
    const { order } = this.data;
    let [row, column] = [order.indexOf(Number(cell.dataset.row)), order.indexOf(Number(cell.dataset.column))];
    const last = order.length - 1;
    if (event.key === "ArrowUp") row = Math.max(row - 1, 0);
    else if (event.key === "ArrowDown") row = Math.min(row + 1, last);
    else if (event.key === "ArrowLeft") column = Math.max(column - 1, 0);
    else if (event.key === "ArrowRight") column = Math.min(column + 1, last);
    else if (event.key === "Home") column = 0;
    else if (event.key === "End") column = last;
    else if (event.key === "Enter" || event.key === " ") this.#open(order[row], order[column]);
    else return;
    event.preventDefault();
    if (event.key === "Enter" || event.key === " ") return;
    const next = this.node.tBodies[0].rows[row].cells[column + 1];
    cell.tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
    next.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /**
   * @param {number} row
   * @param {number} column
   */
  #open(row, column) {
    this.state.set({ row, column });
    document.getElementById("behind").scrollIntoView({ block: "nearest" });
  }

  /** The shapes behind the chosen cell. */
  #behind() {
    const { database, state, neighbours } = this;
    const node = document.getElementById("behind");
    const [row, column] = [state.get("row"), state.get("column")];
    for (const cell of this.node.querySelectorAll("[aria-selected]")) cell.removeAttribute("aria-selected");
    if (row === null || column === null) {
      node.replaceChildren();
      return;
    }
    this.node.querySelector(`[data-row="${row}"][data-column="${column}"]`)?.setAttribute("aria-selected", "true");
    const pairs = neighbours.pairs(row, column, state.get("space"));
    const all = new Set(pairs.flatMap(({ index, near }) => [index, ...near]));
    const query = new URLSearchParams();
    writeSelection(query, database, all);
    const ways = [
      row !== column &&
        element(
          "a",
          { href: compareAddress(database, { kind: "class", group: row }, { kind: "class", group: column }) },
          "Compare these classes",
        ),
      row !== column &&
        element(
          "a",
          {
            href: pageAddress("workbench.html", [
              ["class", database.classes[row]],
              ["class", database.classes[column]],
            ]),
          },
          "Into the Workbench",
        ),
      all.size > 0 && element("a", { href: galleryOf(database, all) }, `Show the ${count(all.size, "shape")}`),
      all.size > 0 && element("a", { href: pageAddress("index.html", query) }, "On the map"),
    ].filter(Boolean);
    const own = row === column;
    node.replaceChildren(
      ...[
        element("h3", {}, this.#name(row), " → ", this.#name(column)),
        element(
          "p",
          {},
          pairs.length === 0
            ? own
              ? `No shape of this ${kind(database)} has another one of it among its neighbours.`
              : "No shape of the one is a neighbour of a shape of the other."
            : [
                element("b", {}, `${grouped(pairs.length)} of ${count(database.sizes.get(row) ?? 0, "shape")}`),
                ` of `,
                element("bdi", {}, database.className(row)),
                ` ${pairs.length === 1 ? "has" : "have"} neighbours ${own ? `of ${pairs.length === 1 ? "its" : "their"} own ${kind(database)}` : "of "}`,
                !own && element("bdi", {}, database.className(column)),
                ": ",
                `${wholePercent(this.share(row, column))} of all their neighbours.`,
              ],
        ),
        element(
          "p",
          { class: "ways" },
          ways.flatMap((way) => [way, " "]),
        ),
        element(
          "ul",
          { class: "behind-list" },
          pairs.slice(0, MOST_BEHIND).map(({ index, near }) =>
            element(
              "li",
              {},
              this.#face(index),
              element("span", { class: "arrow", "aria-hidden": "true" }, "→"),
              near.slice(0, NEAR).map((other) => this.#face(other)),
              near.length > NEAR && element("span", { class: "quiet" }, `+${near.length - NEAR}`),
            ),
          ),
        ),
        pairs.length > MOST_BEHIND &&
          element("p", { class: "quiet" }, `and ${count(pairs.length - MOST_BEHIND, "more shape")}`),
      ].filter(Boolean),
    );
    this.announce(node.querySelector("p").textContent);
  }

  /** @param {number} index */
  #face(index) {
    const { database } = this;
    return element(
      "a",
      {
        href: pageAddress("shape.html", { id: database.ids.at(index) }),
        title: database.names.at(index),
        "aria-label": database.names.at(index),
      },
      picture(database, index, 64),
    );
  }
}
