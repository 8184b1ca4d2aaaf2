// Pointing at a shape on a plot: its picture and name beside the pointer; a click chooses it.

import { element, picture, swatch } from "../base/dom.js";

const REACH = 14;
const GAP = 14;

export class Pointing {
  constructor(database) {
    this.database = database;
    this.node = element("div", { class: "card", hidden: true });
    document.getElementById("content").append(this.node);
    window.addEventListener("scroll", () => this.#hide(), { passive: true });
  }

  /** Watch a plot in its surface; `choose` is told of the shape that was clicked. */
  watch(surface, plot, choose) {
    const at = (event) => plot.at(event.offsetX, event.offsetY, REACH);
    surface.addEventListener("pointermove", (event) => {
      const index = at(event);
      surface.classList.toggle("on-shape", index !== null);
      if (index === null || event.pointerType !== "mouse" || event.buttons > 0) this.#hide();
      else this.#show(index, event);
    });
    surface.addEventListener("pointerleave", () => this.#hide());
    surface.addEventListener("click", (event) => {
      const index = at(event);
      if (index !== null) choose(index);
    });
  }

  #show(index, { clientX, clientY }) {
    const { database, node } = this;
    if (this.shown !== index) {
      const group = database.groups[index];
      node.replaceChildren(
        picture(database, index, 96),
        element(
          "div",
          {},
          element("p", { class: "name", dir: "auto" }, database.names[index]),
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
    const room = (at, size, whole) => (at + GAP + size < whole ? at + GAP : Math.max(at - GAP - size, 0));
    node.style.transform = `translate(${room(clientX, node.offsetWidth, window.innerWidth)}px, ${room(clientY, node.offsetHeight, window.innerHeight)}px)`;
  }

  #hide() {
    this.node.hidden = true;
  }
}
