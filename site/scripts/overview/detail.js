// What is known of one shape: picture, labels, facts, and its nearest neighbours on the map.

import { element, focused, picture } from "../base/dom.js";
import { longText } from "../base/long-text.js";
import { pageAddress } from "../base/place.js";
import { count, figure, grouped } from "../base/words.js";
import { meshFacts, surfaceFacts } from "../database/facts.js";
import { highestOf, ofAtMost } from "../database/hit-range.js";
import { classLine, missingWords } from "../map/card.js";
import { kind } from "../database/kind.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database, Method } from "../database/database.js" */
/** @import { Parted } from "../map/lines.js" */

export class Detail {
  /**
   * @param {Database} database
   * @param {OverviewState} state
   * @param {object} ways
   * @param {(index: number | null) => void} ways.point shows a shape on the map
   * @param {(index: number) => Parted | null} ways.parted who is most alike to one, as far as it is known
   */
  constructor(database, state, { point, parted }) {
    this.database = database;
    this.point = point;
    this.parted = parted;
    this.state = state;
    this.node = document.getElementById("detail");
    state.listen((changed) => {
      const redrawn = ["method", "theme", "alike"].some((name) => changed.has(name));
      if (changed.has("opened") || (redrawn && state.get("opened") !== null)) this.show();
    });
  }

  async show() {
    const index = this.state.get("opened");
    if (index === null) {
      this.node.hidden = true;
      this.returnTo?.focus({ preventScroll: true });
      this.returnTo = null;
      return;
    }
    const known = await this.database.details(index);
    if (this.state.get("opened") !== index) return;
    const first = this.node.hidden;
    if (first) this.returnTo = focused();
    this.node.replaceChildren(...this.#content(index, known));
    this.node.hidden = false;
    this.node.scrollTop = 0;
    if (first) this.node.querySelector("button").focus({ preventScroll: true });
  }

  /**
   * @param {number} index
   * @param {Chunk.ShapeDetails} known
   */
  #content(index, known) {
    const { database } = this;
    const method = database.methods[this.state.get("method")];
    const others = known.labels.filter(([labeling]) => labeling !== database.data.labeling);
    return [
      element(
        "div",
        { class: "detail-head" },
        element("h2", { dir: "auto" }, database.names.at(index)),
        element(
          "button",
          { type: "button", class: "plain", "aria-label": "Close", onclick: () => this.state.set({ opened: null }) },
          "Close",
        ),
      ),
      element("div", { class: "portrait" }, picture(database, index, 256, database.names.at(index))),
      element(
        "p",
        {},
        element("a", { href: pageAddress("shape.html", this.#pageQuery(index)) }, "All about this shape"),
      ),
      database.labelled && classLine(database, database.groups[index]),
      ...this.#neighbours(index, method),
      others.length > 0 && facts("Other labels", others),
      known.metadata.length > 0 && facts("From the database", known.metadata),
      facts("Mesh", [["id", database.ids.at(index)], ...surfaceFacts(known), ...meshFacts(known)]),
      known.repairs.length > 0 &&
        facts(
          "Repairs",
          known.repairs.map(([repair, number]) => [repair, grouped(number)]),
        ),
    ].filter(Boolean);
  }

  /**
   * Its page, on the map that is seen here.
   * @param {number} index
   */
  #pageQuery(index) {
    const { ids, methods } = this.database;
    const { base } = methods[this.state.get("method")];
    return { id: ids.at(index), ...(base > 0 && { map: methods[base].key }) };
  }

  /**
   * @param {number} index
   * @param {Method} method
   */
  #neighbours(index, method) {
    const { database } = this;
    if (database.count === 1) return [];
    const near = database.neighbours(index, this.state.get("method"));
    const hit = method.hit[index];
    return [
      element("h3", {}, `${count(near.length, "nearest neighbour")} on the ${method.title} map`),
      hit !== null &&
        element(
          "p",
          {},
          "NH ",
          element("b", {}, figure(hit)),
          `${ofAtMost(highestOf(database, method, index))}: the share of them in its own ${kind(database)}.`,
        ),
      this.#pictures(index, near),
      database.groups[index] >= 0 &&
        near.some((other) => database.groups[other] !== database.groups[index]) &&
        element("p", { class: "key" }, "Underlined: of another class."),
      ...this.#elsewhere(index),
    ].filter(Boolean);
  }

  /**
   * Those of the most alike that are elsewhere on the map.
   * @param {number} index
   */
  #elsewhere(index) {
    const parted = this.parted(index);
    if (parted === null || parted.kept.length + parted.missing.length === 0) return [];
    const { missing } = parted;
    return [
      element("p", {}, missingWords(parted), missing.length > 0 && ` ${missing.length === 1 ? "It is" : "They are"}:`),
      missing.length > 0 && this.#pictures(index, missing, "elsewhere"),
    ];
  }

  /**
   * Pictures of some shapes near one, each a way to it.
   * @param {number} index
   * @param {number[]} shapes
   * @param {string} [kind]
   */
  #pictures(index, shapes, kind = "neighbours") {
    const { database } = this;
    return element(
      "div",
      { class: kind },
      shapes.map((other) =>
        element(
          "button",
          {
            type: "button",
            class:
              database.groups[other] === database.groups[index] || database.groups[index] < 0
                ? "shape"
                : "shape stranger",
            "aria-label": `Open ${database.names.at(other)}, ${database.className(database.groups[other])}`,
            title: `${database.names.at(other)}\n${database.className(database.groups[other])}`,
            onclick: () => this.state.set({ opened: other }),
            onpointerenter: () => this.point(other),
            onpointerleave: () => this.point(null),
          },
          picture(database, other, 64),
        ),
      ),
    );
  }
}

/**
 * @param {string} title
 * @param {(string | null)[][] | [string, string][] | string[][]} rows
 */
function facts(title, rows) {
  return element(
    "section",
    {},
    element("h3", {}, title),
    element(
      "dl",
      {},
      rows.map(([name, value]) => [
        element("dt", { dir: "auto" }, name),
        element("dd", { dir: "auto" }, value && longText(value)),
      ]),
    ),
  );
}
