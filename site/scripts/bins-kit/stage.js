// The place of a shape that can be turned: first its picture, and the model where a reader asks for it. The 3D data of
// a shape is loaded when it is first shown.

import { element } from "../base/dom.js";
import { unpackModel } from "../viewer/model.js";
import { canDraw, View } from "../viewer/view.js";

const KEPT = 8;

export class Stage {
  /**
   * `load(shape)` gives the bytes of a shape's model; null where the site has none. `keys` is the id of the words that
   * say how a shape is turned.
   * @param {Found} node
   */
  constructor(node, { database, load, keys }) {
    this.node = node;
    this.database = database;
    this.load = load;
    this.keys = keys;
    this.asked = false;
    this.capable = null;
  }

  /**
   * Show a shape: its picture with an offer to turn it, and once that was taken, its model. `paint(solid)` gives its
   * colours, three numbers a vertex, in linear light; `label` says what they show. Where something else than the site
   * or the browser speaks against it, `reason` says what. Resolves to whether the model is on the screen.
   */
  async show(shape, { label, paint, reason = null }) {
    this.latest = Symbol("shown");
    const impossible = reason ?? this.#impossible();
    if (impossible !== null) this.#say(shape, impossible);
    else if (!this.asked) this.#offer(shape, { label, paint });
    else return this.#turn(shape, label, paint);
    return false;
  }

  #impossible() {
    if (this.load === null)
      return "This site holds no 3D data of its shapes: it was built with --no-meshes, or as one file.";
    this.capable ??= canDraw();
    return this.capable ? null : "This browser cannot draw in 3D: WebGL 2 is missing or switched off.";
  }

  /** @param {string} text */
  #say(shape, text) {
    this.#clear(this.#picture(shape), element("p", { class: "empty", role: "status" }, text));
  }

  #offer(shape, view) {
    const show = () => {
      this.asked = true;
      this.focusing = true;
      this.show(shape, view);
    };
    this.#clear(
      this.#picture(shape),
      element("button", { type: "button", class: "plain strong", id: "show-3d", onclick: show }, "Turn it in 3D"),
    );
  }

  #picture(shape) {
    return element("img", { src: this.database.picture(shape), alt: "", width: 320, height: 320 });
  }

  /** @param {...(HTMLImageElement | HTMLParagraphElement | HTMLButtonElement)} nodes */
  #clear(...nodes) {
    this.view?.close();
    this.view = null;
    this.node.replaceChildren(...nodes);
    this.node.removeAttribute("aria-busy");
  }

  async #turn(shape, label, paint) {
    const { latest } = this;
    this.node.setAttribute("aria-busy", "true");
    let solid;
    try {
      solid = await this.#solid(shape);
    } catch {
      if (latest === this.latest)
        this.#say(shape, `There is no 3D data of ${this.database.names[shape]} in this site.`);
      return false;
    }
    const colors = await paint(solid);
    // Something else may have been asked for meanwhile.
    if (latest !== this.latest) return false;
    this.#prepare();
    if (solid === this.solid) this.view.paint(colors);
    else this.view.show(solid, colors);
    this.solid = solid;
    this.canvas.setAttribute("aria-label", label);
    this.node.removeAttribute("aria-busy");
    return true;
  }

  #prepare() {
    if (this.view) return;
    this.canvas = element("canvas", { tabindex: "0", role: "application", "aria-describedby": this.keys });
    const back = element(
      "button",
      { type: "button", class: "plain back", hidden: true, onclick: () => this.view.reset() },
      "First view",
    );
    this.node.replaceChildren(this.canvas, back);
    this.solid = null;
    this.view = new View(this.canvas, {
      turned: () => {
        back.hidden =
          !this.view ||
          (this.view.zoom === 1 && this.view.turn.every((value, place) => value === this.view.model.view[place]));
      },
    });
    if (this.focusing) this.canvas.focus({ preventScroll: true });
    this.focusing = false;
  }

  #models = new Map();

  /** The models used last are kept; the others are loaded anew. */
  async #solid(shape) {
    const known = this.#models.get(shape);
    this.#models.delete(shape);
    const solid = known ?? unpackModel(await this.load(shape));
    this.#models.set(shape, solid);
    if (this.#models.size > KEPT) this.#models.delete(this.#models.keys().next().value);
    return solid;
  }
}
