// Pointing at a shape on a plot: its picture and name beside the pointer; a click chooses it, and an area selects.

import { element, picture, svg, swatch } from "../base/dom.js";
import { clicked } from "../database/selection.js";
import { ShapeBrush, selects } from "./brush.js";

/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Plot } from "./plot.js" */

const REACH = 14;
const GAP = 14;

export class Pointing {
  /** @type {number | null} */
  shown = null;

  /** @param {Database} database */
  constructor(database) {
    this.database = database;
    this.node = element("div", { class: "card", hidden: true });
    document.getElementById("content").append(this.node);
    window.addEventListener("scroll", () => this.#hide(), { passive: true });
  }

  /**
   * Watch a plot in its surface; `choose` is told of the shape that was clicked. With a `state`, its selection is what
   * a box or a lasso has in it, as on all maps, and a click beside all shapes drops it.
   * @param {HTMLElement} surface
   * @param {Plot} plot
   * @param {(index: number) => void} choose
   * @param {State | null} [state]
   */
  watch(surface, plot, choose, state = null) {
    /** @param {MouseEvent} event */
    const at = (event) => plot.at(event.offsetX, event.offsetY, REACH);
    const brush = state && new PlotBrush(surface, plot, state);
    surface.addEventListener("pointermove", (event) => {
      const index = at(event);
      surface.classList.toggle("on-shape", index !== null);
      if (index === null || event.pointerType !== "mouse" || event.buttons > 0) this.#hide();
      else this.#show(index, event);
    });
    surface.addEventListener("pointerleave", () => this.#hide());
    surface.addEventListener("click", (event) => {
      if (brush?.dragged) return;
      const index = at(event);
      if (state && selects(event)) {
        if (index !== null) state.set({ selection: clicked(state.get("selection"), index, event) });
      } else if (index !== null) choose(index);
      else state?.set({ selection: new Set() });
    });
  }

  /**
   * @param {number} index
   * @param {{ clientX: number, clientY: number }} event
   */
  #show(index, { clientX, clientY }) {
    const { database, node } = this;
    if (this.shown !== index) {
      const group = database.groups[index];
      node.replaceChildren(
        picture(database, index, 96),
        element(
          "div",
          {},
          element("p", { class: "name", dir: "auto" }, database.names.at(index)),
          database.labelled &&
            element(
              "p",
              { class: "of-class" },
              swatch(database.symbol(group), database.color(group)),
              element("bdi", {}, database.className(group)),
            ),
        ),
      );
      this.shown = index;
    }
    node.hidden = false;
    /**
     * @param {number} at
     * @param {number} size
     * @param {number} whole
     */
    const room = (at, size, whole) => (at + GAP + size < whole ? at + GAP : Math.max(at - GAP - size, 0));
    node.style.transform = `translate(${room(clientX, node.offsetWidth, window.innerWidth)}px, ${room(clientY, node.offsetHeight, window.innerHeight)}px)`;
  }

  #hide() {
    this.node.hidden = true;
  }
}

/** A mouse draws areas on a plot; a finger scrolls the page. */
class PlotBrush extends ShapeBrush {
  /** @type {number | null} */
  #frame = null;

  /**
   * @param {HTMLElement} surface
   * @param {Plot} plot
   * @param {State} state
   */
  constructor(surface, plot, state) {
    const outline = svg("path", { class: "brush" });
    surface.append(svg("svg", { class: "overlay", "aria-hidden": "true" }, outline));
    super(surface, outline, plot, state);
    this.shapes = plot;
    state.listen((changed) => {
      if (changed.has("selection")) this.#frame ??= requestAnimationFrame(() => this.#redraw());
    });
  }

  /** @param {PointerEvent} event */
  takes({ pointerType, button }) {
    return pointerType === "mouse" && button === 0;
  }

  #redraw() {
    this.#frame = null;
    this.shapes.draw();
  }
}
