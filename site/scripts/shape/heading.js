// Which shape it is, the way back to all shapes, and those before and after it in its class.

import { findShapes } from "../database/shape-finder.js";
import { element, swatch } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { writeSelection } from "../database/selection.js";
import { grouped } from "../base/words.js";

export class Heading {
  constructor(model, state, { links, go, site }) {
    Object.assign(this, { model, state, links, site });
    findShapes(model, go);
    this.choose = document.getElementById("choose");
    this.choose.addEventListener("click", () => this.#toggle());
    state.listen((changed) => {
      if (["shape", "unknown", "theme", "selection"].some((name) => changed.has(name))) this.render();
    });
  }

  render() {
    const { model, state } = this;
    const shape = state.get("shape");
    const name = shape === null ? "No such shape" : model.names[shape];
    document.title = `${name} · ${this.site}`;
    document.getElementById("name").textContent = name;
    document.getElementById("of-class").replaceChildren(...(shape !== null && model.labelled ? this.#group(model.groups[shape]) : []));
    document.getElementById("way-back").replaceChildren(element("a", { href: this.#gallery(), title: shape === null ? null : "The gallery, at this shape" }, "All shapes"));
    this.#offerSelection(shape);
    document.getElementById("turn-over").replaceChildren(...(shape === null ? [] : this.#turnOver(shape)));
    document.getElementById("known").hidden = shape === null;
    const nowhere = document.getElementById("nowhere");
    nowhere.hidden = shape !== null;
    nowhere.replaceChildren(...(shape === null ? this.#nowhere(state.get("unknown")) : []));
  }

  #group(group) {
    const { model } = this;
    return [swatch(model.symbol(group), model.color(group)), element("bdi", {}, model.className(group))];
  }

  #gallery() {
    const query = new URLSearchParams();
    writeSelection(query, this.model, this.state.get("selection"));
    if (this.state.get("shape") !== null) query.set("at", this.model.ids[this.state.get("shape")]);
    return pageAddress("shapes.html", query);
  }

  /** To collect this shape, as the gallery and the maps do. */
  #offerSelection(shape) {
    const chosen = this.state.get("selection").has(shape);
    this.choose.hidden = shape === null;
    this.choose.setAttribute("aria-pressed", String(chosen));
    this.choose.textContent = chosen ? "Selected" : "Select";
  }

  #toggle() {
    const selection = new Set(this.state.get("selection"));
    const shape = this.state.get("shape");
    if (!selection.delete(shape)) selection.add(shape);
    this.state.set({ selection });
  }

  #nowhere(id) {
    const offer = ["Find one by its name above, or choose one in the ", element("a", { href: this.#gallery() }, "gallery"), "."];
    if (id === null) return [element("p", {}, "The address names no shape. ", offer)];
    return [
      element("p", {}, "There is no shape ", element("b", {}, element("bdi", {}, id)), " in this database. ", offer),
      element("p", {}, "Files that could not be used are listed on the page ", element("a", { href: pageAddress("about.html") }, "About"), "."),
    ];
  }

  /** Links to the shapes before and after in the class; the last is followed by the first. */
  #turnOver(shape) {
    const { model, links } = this;
    const own = model.groups[shape];
    const fellows = [...model.groups.keys()].filter((index) => model.groups[index] === own);
    if (fellows.length < 2) return [];
    const place = fellows.indexOf(shape);
    const step = (by, words, rel, said) => links.link(fellows.at((place + by) % fellows.length), { rel, "aria-label": said }, words);
    return [
      step(-1, "‹ Previous", "prev", "Previous shape"),
      element("span", { class: "quiet" }, `${grouped(place + 1)} of ${grouped(fellows.length)}`, model.labelled && [own < 0 ? " without label" : [" in ", element("bdi", {}, model.className(own))]]),
      step(1, "Next ›", "next", "Next shape"),
    ];
  }
}
