// Where a reader chooses the two groups: a list of what there is on each side, and a field to find shapes by words.

import { element } from "../base/dom.js";
import { count, grouped, isolated } from "../base/words.js";
import { isSame, nameOf } from "./groups.js";

/** @import { GroupSpec } from "../addresses/compare.js" */
/** @import { CompareState } from "../addresses/compare.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Side } from "./groups.js" */

/** @typedef {{ spec: GroupSpec, text: string }} Offer */

/** @type {Side[]} */
const SIDES = ["a", "b"];

export class Chooser {
  /**
   * @param {Database} database
   * @param {Chunk.Clusters | null} clusters
   * @param {CompareState} state
   */
  constructor(database, clusters, state) {
    this.database = database;
    this.state = state;
    this.lists = { a: document.getElementById("group-a"), b: document.getElementById("group-b") };
    this.offers = this.#offers(clusters);
    for (const side of SIDES) {
      this.lists[side].addEventListener("change", (event) =>
        this.choose(side, this.shown[side][Number(event.target.value)]),
      );
      document.getElementById(`find-${side}`).addEventListener("submit", (event) => {
        event.preventDefault();
        const text = event.target.elements.find.value.trim();
        event.target.reset();
        if (text !== "") this.choose(side, { kind: "search", text });
      });
    }
    document
      .getElementById("swap")
      .addEventListener("click", () => state.set({ a: state.get("b"), b: state.get("a") }));
    state.listen((changed) => {
      if (changed.has("a") || changed.has("b")) this.render();
    });
    /** @type {Record<Side, GroupSpec[]>} */
    this.shown = { a: [], b: [] };
  }

  /**
   * What every database offers: its classes and clusters with their sizes.
   * @param {Chunk.Clusters | null} clusters
   * @returns {[string, Offer[]][]}
   */
  #offers(clusters) {
    const { database } = this;
    const classes = database.classes.map((name, group) => ({
      spec: { kind: /** @type {const} */ ("class"), group },
      text: `${isolated(name)} (${grouped(database.sizes.get(group) ?? 0)})`,
    }));
    const found = clusters === null || clusters.standIn ? [] : clusters.clusters;
    return [
      [clusters?.standIn ? "Clusters" : "Classes", classes],
      [
        "Clusters, made from the features alone",
        found.map(({ name, size }) => ({
          spec: { kind: /** @type {const} */ ("cluster"), name },
          text: `${isolated(name)} (${grouped(size)})`,
        })),
      ],
    ];
  }

  /**
   * @param {Side} side
   * @param {GroupSpec | null} spec
   */
  choose(side, spec) {
    const other = side === "a" ? "b" : "a";
    /** @type {Partial<Record<Side, GroupSpec | null>>} */
    const patch = { [side]: spec };
    if (spec !== null && isSame(spec, this.state.get(other))) {
      // Two rests are no question: the sides change places then.
      patch[other] = spec.kind === "rest" ? this.state.get(side) : { kind: "rest" };
      this.#moved = spec.kind === "rest" ? null : patch[other];
    }
    this.state.set(patch);
  }

  /** What became of a side for whose group the other side was chosen. */
  /** @type {GroupSpec | null} */
  #moved = null;

  /** Why a side is another than the reader chose, in words; empty where it is not. */
  get moved() {
    const { state } = this;
    const side = SIDES.find((own) => this.#moved !== null && state.get(own) === this.#moved);
    if (side === undefined) return "";
    const name = nameOf(/** @type {GroupSpec} */ (state.get(side === "a" ? "b" : "a")), this.database);
    return `Nothing can be compared with itself: as ${isolated(name)} was on both sides, it is now compared with all other shapes.`;
  }

  render() {
    for (const side of SIDES) {
      const spec = this.state.get(side);
      /** @type {Offer[]} */
      const own = [{ spec: { kind: "rest" }, text: "all other shapes" }];
      // The set of shapes that came along can be chosen on both sides.
      for (const from of side === "a" ? SIDES : SIDES.toReversed()) {
        const known = this.state.get(from);
        if (known?.kind !== "shapes" && known?.kind !== "search") continue;
        const other = this.state.get(from === "a" ? "b" : "a");
        if (!own.some((offer) => isSame(offer.spec, known)))
          own.push({ spec: known, text: textOf(known, this.database, { side: from, other }) });
      }
      /** @type {[string, Offer[]][]} */
      const groups = [...this.offers, ["Other groups", own]];
      const lists = groups.filter(([, offers]) => offers.length > 0);
      const flat = lists.flatMap(([, offers]) => offers);
      this.shown[side] = flat.map((offer) => offer.spec);
      let number = 0;
      const list = this.lists[side];
      list.replaceChildren(
        element("option", { value: "", disabled: true, hidden: true }, "Choose a group"),
        ...lists.map(([label, offers]) =>
          element(
            "optgroup",
            { label },
            offers.map(({ text }) => element("option", { value: number++ }, text)),
          ),
        ),
      );
      const place = flat.findIndex((offer) => spec !== null && isSame(offer.spec, spec));
      list.value = place < 0 ? "" : String(place);
    }
  }
}

/**
 * @param {Extract<GroupSpec, { kind: "search" | "shapes" }>} spec
 * @param {Database} database
 * @param {{ side: Side, other: GroupSpec | null }} among
 */
function textOf(spec, database, among) {
  const name = nameOf(spec, database, among);
  if (spec.kind === "search") return `found by ${name}`;
  return spec.shapes.size === 1 || among.other?.kind === "shapes" ? name : count(spec.shapes.size, "selected shape");
}
