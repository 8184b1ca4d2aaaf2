// The place of a shape that can be turned: first its picture, and the model where a reader asks for it. The 3D data of
// a shape is loaded when it is first shown.

import { element } from "../base/dom.js";
import { unpackModel } from "../viewer/model.js";
import { canDraw, View } from "../viewer/view.js";

/** @import { Database } from "../database/database.js" */
/** @import { Model } from "../viewer/model.js" */

/**
 * How a shape is shown: what its colours say, and the colours of its model, three numbers a vertex, in linear light; and
 * what to do once the model is on the screen.
 * @typedef {object} Showing
 * @property {string} label
 * @property {(solid: Model) => Float32Array | Promise<Float32Array>} paint
 * @property {(solid: Model) => void} [shown]
 */

const KEPT = 8;

export class Stage {
  /**
   * @param {Found} node
   * @param {object} options
   * @param {Database} options.database
   * @param {((shape: number) => Promise<ArrayBuffer>) | null} options.load the model of a shape; null where there is none
   * @param {string} options.keys id of the words that say how a shape is turned
   */
  constructor(node, { database, load, keys }) {
    this.node = node;
    this.database = database;
    this.load = load;
    this.keys = keys;
    this.asked = false;
    /** @type {boolean | null} */
    this.capable = null;
    /** @type {View | null} */
    this.view = null;
    /** @type {Model | null} */
    this.solid = null;
    this.focusing = false;
  }

  /**
   * Show a shape: its picture with an offer to turn it, and once that was taken, its model. Resolves to whether the model
   * is on the screen.
   * @param {number} shape
   * @param {Showing} how
   */
  async show(shape, how) {
    this.latest = Symbol("shown");
    const impossible = this.#impossible();
    if (impossible !== null) this.#say(shape, impossible);
    else if (!this.asked) this.#offer(shape, how);
    else return this.#turn(shape, how);
    return false;
  }

  /** Show nothing, and give back what the graphics card held. */
  rest() {
    this.latest = Symbol("rest");
    this.#clear();
  }

  #impossible() {
    if (this.load === null)
      return "This site holds no 3D data of its shapes: it was built with --no-meshes, or as one file.";
    this.capable ??= canDraw();
    return this.capable ? null : "This browser cannot draw in 3D: WebGL 2 is missing or switched off.";
  }

  /**
   * @param {number} shape
   * @param {string} text
   */
  #say(shape, text) {
    this.#clear(this.#picture(shape), element("p", { class: "empty", role: "status" }, text));
  }

  /**
   * @param {number} shape
   * @param {Showing} how
   */
  #offer(shape, how) {
    const show = () => {
      this.asked = true;
      this.focusing = true;
      this.show(shape, how);
    };
    this.#clear(
      this.#picture(shape),
      element("button", { type: "button", class: "plain strong", id: "show-3d", onclick: show }, "Turn it in 3D"),
    );
  }

  /** @param {number} shape */
  #picture(shape) {
    const image = element("img", { alt: "", width: 320, height: 320 });
    this.database.pictures.show(image, shape);
    return image;
  }

  /** @param {...(HTMLImageElement | HTMLParagraphElement | HTMLButtonElement)} nodes */
  #clear(...nodes) {
    this.view?.close();
    this.view = null;
    this.node.replaceChildren(...nodes);
    this.node.removeAttribute("aria-busy");
  }

  /**
   * @param {number} shape
   * @param {Showing} how
   */
  async #turn(shape, { label, paint, shown }) {
    const { latest } = this;
    this.node.setAttribute("aria-busy", "true");
    let solid;
    try {
      solid = await this.#solid(shape);
    } catch {
      if (latest === this.latest)
        this.#say(shape, `There is no 3D data of ${this.database.names.at(shape)} in this site.`);
      return false;
    }
    const colors = await paint(solid);
    // Something else may have been asked for meanwhile.
    if (latest !== this.latest) return false;
    const view = this.view ?? this.#prepare();
    if (solid === this.solid) view.paint(colors);
    else view.show(solid, colors);
    this.solid = solid;
    view.canvas.setAttribute("aria-label", label);
    this.node.removeAttribute("aria-busy");
    shown?.(solid);
    return true;
  }

  #prepare() {
    const canvas = element("canvas", { tabindex: "0", role: "application", "aria-describedby": this.keys });
    const back = element(
      "button",
      { type: "button", class: "plain back", hidden: true, onclick: () => view.reset() },
      "First view",
    );
    this.node.replaceChildren(canvas, back);
    this.solid = null;
    const view = new View(canvas, {
      turned: () => {
        back.hidden =
          this.view !== view ||
          (view.zoom === 1 && view.turn.every((value, place) => value === view.model?.view[place]));
      },
    });
    this.view = view;
    if (this.focusing) canvas.focus({ preventScroll: true });
    this.focusing = false;
    return view;
  }

  /** @type {Map<number, Model>} */
  #models = new Map();

  /**
   * The models used last are kept; the others are loaded anew.
   * @param {number} shape
   */
  async #solid(shape) {
    const known = this.#models.get(shape);
    this.#models.delete(shape);
    const load = /** @type {(shape: number) => Promise<ArrayBuffer>} */ (this.load);
    const solid = known ?? unpackModel(await load(shape));
    this.#models.set(shape, solid);
    if (this.#models.size > KEPT) this.#models.delete([...this.#models.keys()][0]);
    return solid;
  }
}
