// Which shape it is, the way back to all shapes, and those before and after it in its class.

import { element, swatch } from "../base/dom.js";
import { pageAddress } from "../base/place.js";
import { grouped } from "../base/words.js";
import { writeSelection } from "../database/selection.js";
import { findShapes } from "../database/shape-finder.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Database } from "../database/database.js" */
/** @import { ShapeLinks } from "./links.js" */

export class Heading {
  /**
   * @param {Database} database
   * @param {ShapeState} state
   * @param {{ links: ShapeLinks, go: (shape: number) => void, site: string | undefined }} parts
   */
  constructor(database, state, { links, go, site }) {
    this.database = database;
    this.state = state;
    this.links = links;
    this.site = site;
    findShapes(database, go);
    this.choose = document.getElementById("choose");
    this.choose.addEventListener("click", () => this.#toggle());
    state.listen((changed) => {
      if (["shape", "unknown", "theme", "selection"].some((name) => changed.has(name))) this.render();
    });
  }

  render() {
    const { database, state } = this;
    const shape = state.get("shape");
    const name = shape === null ? "No such shape" : database.names.at(shape);
    document.title = `${name} · ${this.site}`;
    document.getElementById("name").textContent = name;
    document
      .getElementById("of-class")
      .replaceChildren(...(shape !== null && database.labelled ? this.#group(database.groups[shape]) : []));
    document
      .getElementById("way-back")
      .replaceChildren(
        element(
          "a",
          { href: this.#gallery(), title: shape === null ? null : "The gallery, at this shape" },
          "All shapes",
        ),
      );
    this.#offerSelection(shape);
    document.getElementById("turn-over").replaceChildren(...(shape === null ? [] : this.#turnOver(shape)));
    document.getElementById("known").hidden = shape === null;
    const nowhere = document.getElementById("nowhere");
    nowhere.hidden = shape !== null;
    nowhere.replaceChildren(...(shape === null ? this.#nowhere(state.get("unknown")) : []));
  }

  /** @param {number} group */
  #group(group) {
    const { database } = this;
    return [swatch(database.symbol(group), database.color(group)), element("bdi", {}, database.className(group))];
  }

  #gallery() {
    const query = new URLSearchParams();
    writeSelection(query, this.database, this.state.get("selection"));
    const shape = this.state.get("shape");
    if (shape !== null) query.set("at", this.database.ids.at(shape));
    return pageAddress("shapes.html", query);
  }

  /**
   * To collect this shape, as the gallery and the maps do.
   * @param {number | null} shape
   */
  #offerSelection(shape) {
    const chosen = shape !== null && this.state.get("selection").has(shape);
    this.choose.hidden = shape === null;
    // Of no shape there are none.
    document.getElementById("open-tables").hidden = shape === null;
    this.choose.setAttribute("aria-pressed", String(chosen));
    this.choose.textContent = chosen ? "Selected" : "Select";
  }

  #toggle() {
    const selection = new Set(this.state.get("selection"));
    const shape = this.state.get("shape");
    if (shape === null) return;
    if (!selection.delete(shape)) selection.add(shape);
    this.state.set({ selection });
  }

  /** @param {string | null} id */
  #nowhere(id) {
    const offer = [
      "Find one by its name above, or choose one in the ",
      element("a", { href: this.#gallery() }, "gallery"),
      ".",
    ];
    if (id === null) return [element("p", {}, "The address names no shape. ", offer)];
    return [
      element("p", {}, "There is no shape “", element("bdi", {}, id), "” in this database. ", offer),
      element(
        "p",
        {},
        "Files that could not be used are listed on the page ",
        element("a", { href: pageAddress("about.html") }, "About"),
        ".",
      ),
    ];
  }

  /**
   * Links to the shapes before and after in the class; the last is followed by the first.
   * @param {number} shape
   */
  #turnOver(shape) {
    const { database, links } = this;
    const own = database.groups[shape];
    const fellows = [...database.groups.keys()].filter((index) => database.groups[index] === own);
    if (fellows.length < 2) return [];
    const place = fellows.indexOf(shape);
    /**
     * @param {number} by
     * @param {string} words
     * @param {string} rel
     * @param {string} said
     */
    const step = (by, words, rel, said) =>
      links.link(/** @type {number} */ (fellows.at((place + by) % fellows.length)), { rel, "aria-label": said }, words);
    return [
      step(-1, "‹ Previous", "prev", "Previous shape"),
      element(
        "span",
        { class: "quiet" },
        `${grouped(place + 1)} of ${grouped(fellows.length)}`,
        database.labelled && [own < 0 ? " without label" : [" in ", element("bdi", {}, database.className(own))]],
      ),
      step(1, "Next ›", "next", "Next shape"),
    ];
  }
}
