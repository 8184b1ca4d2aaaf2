// The most central shapes of both groups, coloured by a bin or by where the two differ: pictures first, and 3D where a
// reader asks for it.

import { chunk } from "../base/chunks.js";
import { besideAddress } from "../addresses/shape.js";
import { element, picture } from "../base/dom.js";
import { pageAddress, resource } from "../base/place.js";
import { percent } from "../base/words.js";
import { binName, exactly } from "../bins-kit/bin-name.js";
import { Legend } from "../bins-kit/legend.js";
import { byFeature, sumOf } from "../bins-kit/difference.js";
import { showingBin, UNPAINTED } from "../bins-kit/on-surface.js";
import { Stage } from "../bins-kit/stage.js";
import { modelsOf, TwoSurfaces } from "../bins-kit/two-surfaces.js";
import { copyEvidence } from "../database/facts.js";
import { similarityOf } from "../database/level-similarity.js";
import { Paint } from "../viewer/paint.js";
import { meaning } from "./words.js";

/** @import { CompareState } from "../addresses/compare.js" */
/** @import { Database } from "../database/database.js" */
/** @import { LevelSimilarity } from "../database/level-similarity.js" */
/** @import { Similarity } from "../database/similarity.js" */
/** @import { View } from "./groups-view.js" */
/** @import { Side } from "./groups.js" */

const EXAMPLES = 6;
/** @type {Side[]} */
const SIDES = ["a", "b"];

export class OnShapes {
  /** @type {View | null} */
  view = null;
  /** @type {Record<Side, number>} */
  chosen = { a: 0, b: 0 };
  /** @type {Chunk.Selection | null} */
  selection = null;
  /** @type {Record<Side, Stage> | null} */
  stages = null;
  /** @type {TwoSurfaces | null} */
  surfaces = null;
  /** @type {Similarity | LevelSimilarity | null} */
  similarity = null;
  /** @type {Legend} */
  legend;
  /** @type {Paint} */
  paint;

  /**
   * @param {Database} database
   * @param {CompareState} state
   * @param {(text: string) => void} announce
   */
  constructor(database, state, announce) {
    this.database = database;
    this.state = state;
    this.announce = announce;
    this.asked = false;
    for (const input of document.querySelectorAll("#readings input"))
      input.addEventListener("change", () => state.set({ reading: input.value }));
    document.getElementById("turn-both").addEventListener("click", () => {
      this.asked = true;
      this.draw();
      document.getElementById("stage-a").focus({ preventScroll: true });
    });
  }

  /** @param {View} view */
  async show(view) {
    this.view = view;
    const { a, b } = view.contrast.central;
    this.chosen = { a: a[0], b: b[0] };
    await this.draw();
  }

  async draw() {
    const { view, state } = this;
    if (!view) return;
    this.selection ??= await chunk("selection");
    if (view !== this.view) return;
    this.stages ??= this.#makeStages(this.selection);
    this.#offerReadings(view);
    if (state.get("reading") === "apart") await this.#apart(view);
    else this.#bin(view, this.selection);
  }

  /**
   * The choice of what colours show; by a value of the whole shape nothing is coloured.
   * @param {View} view
   */
  #offerReadings({ bins, bin }) {
    const share = bins.isShare(bin);
    const reading = this.state.get("reading");
    for (const input of document.querySelectorAll("#readings input")) {
      input.checked = input.value === (share || reading === "apart" ? reading : "value");
      const label = /** @type {Found} */ (input.closest("label"));
      if (input.value === "inside") label.hidden = !share;
      if (input.value !== "value") continue;
      label.title = share ? "The descriptor’s value at every point" : UNPAINTED;
      label.querySelector("span").textContent = share ? "value" : "no colours";
    }
  }

  /** What the two pictures show, in a sentence. */
  caption() {
    const { view, database, chosen, state } = this;
    if (view === null) return "";
    const { bins, bin } = view;
    const pair = SIDES.map((side) => database.names.at(chosen[side])).join(" and ");
    const { title } = bins.features[bins.featureOf(bin)];
    const called = `${bins.names[bin]}${bins.called[bin] ? ` (${bins.called[bin]})` : ""}`;
    if (state.get("reading") === "apart")
      return `${pair}: coloured is what the one has and the other lacks, in all features together.`;
    if (!bins.isShare(bin)) return `${pair}, and their values of ${called}, a value of the whole shape.`;
    return state.get("reading") === "inside"
      ? `${pair}: coloured is what falls into the bin ${called}.`
      : `${pair}, coloured by ${title}; the range marked in the legend is that of the bin ${called}.`;
  }

  /**
   * One bin on both shapes.
   * @param {View} view
   * @param {Chunk.Selection} selection
   */
  #bin({ bins, bin }, selection) {
    this.surfaces?.leave();
    const share = bins.isShare(bin);
    document.getElementById("turn-both").hidden = this.asked || selection.models === null;
    document
      .getElementById("seen-bin")
      .replaceChildren(
        element("p", {}, binName(bins, bin)),
        share ? "" : element("p", { class: "quiet in-page" }, UNPAINTED),
        exactly(bins, bin, meaning(bin, bins)),
      );
    if (share && !this.asked && !SIDES.some((side) => this.#painting(this.chosen[side])))
      document
        .getElementById("seen-bin")
        .append(
          element(
            "p",
            { class: "quiet in-page" },
            selection.models === null
              ? "No pictures of this bin were painted on these two."
              : "No pictures of this bin were painted on these two: turn both in 3D to see its colours.",
          ),
        );
    const dimension = bins.dimensionOf(bin);
    if (dimension !== null) this.legend.show(selection.dimensions[dimension], bins.binOf(bin));
    else this.legend.clear();
    /** @param {number} index */
    const told = (index) => `${bins.telling(bin)(bins.share(bin, index))}${share ? " in the bin" : ""}`;
    for (const side of SIDES) {
      this.#side(side, told);
      this.#stage(side, this.chosen[side]);
    }
    const reading = this.state.get("reading") === "inside" ? "which points fall into" : "values of";
    if (this.asked && share) this.announce(`${reading} ${bins.names[bin]}`);
  }

  /**
   * Where the two shapes differ, in all features together.
   * @param {View} view
   */
  async #apart(view) {
    const { database, chosen } = this;
    const { bins } = view;
    const known = await database.details(chosen.a);
    if (view !== this.view || this.state.get("reading") !== "apart") return;
    const selection = /** @type {Chunk.Selection} */ (this.selection);
    const stages = /** @type {Record<Side, Stage>} */ (this.stages);
    /** @type {[number, number]} */
    const pair = [chosen.a, chosen.b];
    document.getElementById("turn-both").hidden = true;
    this.legend.clear();
    this.surfaces ??= new TwoSurfaces(database, bins, selection, {
      stages: [stages.a, stages.b],
      legend: document.getElementById("apart-legend"),
    });
    this.similarity ??= similarityOf(bins);
    const parts = await this.similarity.differences(...pair, { features: [...bins.features.keys()] });
    if (view !== this.view || chosen.a !== pair[0] || chosen.b !== pair[1] || this.state.get("reading") !== "apart")
      return;
    const evidence = copyEvidence(known, chosen.b);
    const nowhere = byFeature(parts, bins, pair).reduce((sum, { beside }) => sum + beside, 0);
    document
      .getElementById("seen-bin")
      .replaceChildren(
        evidence === null ? "" : `The two are copies of each other: ${evidence}. `,
        "All features together: what one of these two shapes has and the other lacks is coloured. ",
        ...(nowhere > 0
          ? [
              element("b", {}, percent(nowhere)),
              " of what sets them apart lies in what is measured of whole shapes, and is nowhere on them. ",
            ]
          : []),
        element("a", { href: besideAddress(database, ...pair) }, "Feature by feature"),
      );
    for (const side of SIDES) this.#side(side, () => "");
    this.surfaces.show(pair, parts, sumOf(parts));
  }

  /** @param {Chunk.Selection} selection */
  #makeStages(selection) {
    const { database } = this;
    this.legend = new Legend(selection);
    this.paint = new Paint(selection);
    /** @param {Side} side */
    const make = (side) =>
      new Stage(document.getElementById(`stage-${side}`), { database, load: modelsOf(selection), keys: "turn-keys" });
    return { a: make("a"), b: make("b") };
  }

  /**
   * Which shape is shown, and those to choose another from.
   * @param {Side} side
   * @param {(shape: number) => string} told what is said of a shape
   */
  #side(side, told) {
    const { database } = this;
    const view = /** @type {View} */ (this.view);
    const shape = this.chosen[side];
    const group = view[side];
    document
      .getElementById(`seen-${side}`)
      .replaceChildren(
        element("p", { class: "of" }, group.mark(), element("b", {}, element("bdi", {}, group.label))),
        element(
          "p",
          {},
          element(
            "a",
            { href: pageAddress("shape.html", { id: database.ids.at(shape) }) },
            element("bdi", {}, database.names.at(shape)),
          ),
          " ",
          element("span", { class: "quiet" }, told(shape)),
        ),
      );
    document.getElementById(`examples-${side}`).replaceChildren(
      ...view.contrast.central[side].slice(0, EXAMPLES).map((index) =>
        element(
          "button",
          {
            type: "button",
            class: "example",
            "aria-pressed": String(index === shape),
            "aria-label": [database.names.at(index), told(index)].filter(Boolean).join(", "),
            title: database.names.at(index),
            onclick: () => {
              this.chosen[side] = index;
              this.draw();
              document.querySelector(`#examples-${side} [aria-pressed="true"]`)?.focus();
            },
          },
          picture(database, index, 56),
        ),
      ),
    );
  }

  /**
   * The pictures of the bin that is looked at on a shape, if they were drawn.
   * @param {number} shape
   */
  #painting(shape) {
    return this.selection?.paintings.find(
      ({ column, ...painted }) => column === this.view?.bin && painted.shape === shape,
    );
  }

  /**
   * @param {Side} side
   * @param {number} shape
   */
  #stage(side, shape) {
    const { bins, bin } = /** @type {View} */ (this.view);
    const { [side]: stage } = /** @type {Record<Side, Stage>} */ (this.stages);
    const inside = this.state.get("reading") === "inside";
    if (!this.asked) {
      const painting = this.#painting(shape);
      stage.rest();
      stage.node.replaceChildren(
        painting === undefined
          ? picture(this.database, shape, 320)
          : element("img", {
              src: resource(inside ? painting.inside : painting.value),
              alt: `${this.database.names.at(shape)}, ${inside ? "what falls into the bin" : "its values in colours"}`,
              width: 320,
              height: 320,
            }),
      );
      return;
    }
    stage.asked = true;
    stage.show(shape, showingBin(shape, bin, { database: this.database, bins, paint: this.paint, inside }));
  }
}
