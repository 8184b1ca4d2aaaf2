// A bin on the most central shapes of both groups: pictures first, and 3D where a reader asks for it.

import { chunk, modelBytes } from "../base/chunks.js";
import { element, picture } from "../base/dom.js";
import { pageAddress, resource } from "../base/place.js";
import { percent } from "../bins-kit/bin-card.js";
import { Legend } from "../bins-kit/legend.js";
import { dimensionOf } from "../bins-kit/look.js";
import { Stage } from "../bins-kit/stage.js";
import { Paint } from "../viewer/paint.js";

/** @import { CompareState } from "../addresses/compare.js" */
/** @import { Database } from "../database/database.js" */
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
    const inputs = document.querySelectorAll("#readings input");
    this.check = () => {
      for (const input of inputs) input.checked = input.value === state.get("reading");
    };
    for (const input of inputs) input.addEventListener("change", () => state.set({ reading: input.value }));
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
    const { bins, bin } = view;
    this.check();
    const share = bins.isShare(bin);
    document.getElementById("readings").hidden = !share;
    document.getElementById("turn-both").hidden = this.asked || !share || this.selection.models === null;
    const hue = element("i", { class: "hued" });
    hue.style.background = bins.color(bin);
    document
      .getElementById("seen-bin")
      .replaceChildren(hue, element("b", {}, element("bdi", {}, bins.names[bin])), " ", bins.sentence(bin));
    const dimension = dimensionOf(bin, bins);
    if (dimension !== null) this.legend.show(this.selection.dimensions[dimension], bins.binOf(bin));
    else this.legend.clear();
    for (const side of SIDES) this.#side(side, share);
    const reading = state.get("reading") === "inside" ? "which points fall into" : "values of";
    if (this.asked && share) this.announce(`${reading} ${bins.names[bin]}`);
  }

  /** @param {Chunk.Selection} selection */
  #makeStages(selection) {
    const { database } = this;
    this.legend = new Legend(selection);
    this.paint = new Paint(selection);
    const { models } = selection;
    const load = models && ((/** @type {number} */ index) => modelBytes(models[index]));
    /** @param {Side} side */
    const make = (side) => new Stage(document.getElementById(`stage-${side}`), { database, load, keys: "turn-keys" });
    return { a: make("a"), b: make("b") };
  }

  /**
   * @param {Side} side
   * @param {boolean} share
   */
  #side(side, share) {
    const { database } = this;
    const view = /** @type {View} */ (this.view);
    const { bins, bin } = view;
    const shape = this.chosen[side];
    const group = view[side];
    /** @param {number} index */
    /** @param {number} index */
    const told = (index) =>
      share ? `${percent(bins.share(bin, index))} in the bin` : String(Number(bins.share(bin, index).toPrecision(3)));
    document
      .getElementById(`seen-${side}`)
      .replaceChildren(
        element("p", { class: "of" }, group.mark(), element("b", {}, element("bdi", {}, group.name))),
        element(
          "p",
          {},
          element(
            "a",
            { href: pageAddress("shape.html", { id: database.ids[shape] }) },
            element("bdi", {}, database.names[shape]),
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
            "aria-label": `${database.names[index]}, ${told(index)}`,
            title: database.names[index],
            onclick: () => {
              this.chosen[side] = index;
              this.#side(side, share);
              document.querySelector(`#examples-${side} [aria-pressed="true"]`)?.focus();
            },
          },
          picture(database, index, 56),
        ),
      ),
    );
    this.#stage(side, shape, share);
  }

  /**
   * @param {Side} side
   * @param {number} shape
   * @param {boolean} share
   */
  #stage(side, shape, share) {
    const { bins, bin } = /** @type {View} */ (this.view);
    const { [side]: stage } = /** @type {Record<Side, Stage>} */ (this.stages);
    const inside = this.state.get("reading") === "inside";
    if (!this.asked && share) {
      const painting = this.selection?.paintings.find((painted) => painted.column === bin && painted.shape === shape);
      stage.node.replaceChildren(
        painting === undefined
          ? picture(this.database, shape, 320)
          : element("img", {
              src: resource(inside ? painting.inside : painting.value),
              alt: `${this.database.names[shape]}, ${inside ? "what falls into the bin" : "its values in colours"}`,
              width: 320,
              height: 320,
            }),
      );
      return;
    }
    stage.asked = true;
    const dimension = /** @type {number} */ (dimensionOf(bin, bins));
    stage.show(shape, {
      label: `${this.database.names[shape]} in 3D, ${inside ? "which points fall into" : "values of"} ${bins.names[bin]}`,
      paint: (solid) =>
        inside ? this.paint.inside(solid, dimension, bins.binOf(bin)) : this.paint.values(solid, dimension),
      reason: share ? null : "This feature has no values on the surface.",
    });
  }
}
