// Where a shape lies on a map, its nearest neighbours there, and what they say of it.

import { element, pause } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { toldAs } from "../base/snapshot.js";
import { pageAddress } from "../base/place.js";
import { styleColor } from "../base/theme.js";
import { count, figure, isolated } from "../base/words.js";
import { highestOf, ofAtMost } from "../database/hit-range.js";
import { Plot } from "../map/plot.js";
import { kind } from "../database/kind.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Database, Method } from "../database/database.js" */
/** @import { Over } from "../map/plot.js" */
/** @import { Pointing } from "../map/pointing.js" */
/** @import { ShapeLinks } from "./links.js" */

/** Above so many shapes, marks are small. */
const MANY = 1500;
const MOST_CLASSES = 6;

export class Surroundings {
  /**
   * @param {Database} database
   * @param {ShapeState} state
   * @param {{ links: ShapeLinks, pointing: Pointing, go: (shape: number) => void }} parts
   */
  constructor(database, state, { links, pointing, go }) {
    this.database = database;
    this.state = state;
    this.links = links;
    this.section = document.querySelector(".surroundings");
    this.#offerMaps();
    this.plot = new Plot(database, {
      margin: 14,
      first: (index) => !this.near.has(index) && index !== state.get("shape"),
      /** @param {number} index */
      mark: (index) => this.#mark(index),
      drawn: (over) => this.#tie(over),
    });
    const surface = document.getElementById("place-surface");
    surface.append(this.plot.node);
    toldAs(this.section, () => {
      const { title, neighbours } = database.methods[state.get("method")];
      const shape = isolated(database.names.at(state.get("shape") ?? 0));
      const words = `${title} map of ${count(database.count, "shape")}: ${shape}, ringed, and its ${count(neighbours, "nearest neighbour")}, in full colour.`;
      return { title: `${shape} on the map`, words, onPaper: true };
    });
    pointing.watch(surface, this.plot, go);
    state.listen((changed) => {
      if (changed.has("theme")) this.#looks.clear();
      if (["shape", "method"].some((name) => changed.has(name))) this.render();
      else if (changed.has("theme")) this.plot.draw();
    });
  }

  near = new Set();

  #offerMaps() {
    const { database, state } = this;
    const inputs = database.methods.map((_, method) =>
      element("input", { type: "radio", name: "map", value: method, onchange: () => state.set({ method }) }),
    );
    const check = () => inputs.forEach((input, method) => (input.checked = method === state.get("method")));
    document
      .getElementById("maps")
      .replaceChildren(
        ...inputs.map((input, method) =>
          element("label", {}, input, element("span", {}, database.methods[method].title)),
        ),
      );
    state.listen((changed) => changed.has("method") && check());
    check();
  }

  render() {
    const { database, state } = this;
    const shape = state.get("shape");
    this.section.hidden = shape === null || database.count === 1;
    if (shape === null || this.section.hidden) return;
    const method = state.get("method");
    const near = database.neighbours(shape, method);
    this.near = new Set(near);
    this.#draw(shape, method);
    const own = database.groups[shape];
    /** @param {number} other */
    const stranger = (other) => own >= 0 && database.groups[other] !== own;
    document.getElementById("nh").replaceChildren(...this.#tell(shape, near, database.methods[method]));
    document
      .getElementById("neighbours")
      .replaceChildren(...near.map((other) => this.links.pictured(other, 64, { stranger: stranger(other) })));
    document
      .getElementById("neighbours-key")
      .replaceChildren(
        near.some(stranger) ? `Underlined: of another ${kind(database)}. ` : "",
        element("a", { class: "on-screen", href: this.#overview(shape) }, "Open on the Overview"),
      );
  }

  /**
   * A drawing of very many shapes takes long: what is said of this one comes first.
   * @param {number} shape
   * @param {number} method
   */
  async #draw(shape, method) {
    if (this.database.count > MANY) await pause();
    if (this.state.get("shape") === shape && this.state.get("method") === method)
      this.plot.show(this.database.methods[method]);
  }

  /** @param {number} shape */
  #overview(shape) {
    const query = new URLSearchParams();
    const { methods, ids } = this.database;
    if (this.state.get("method") > 0) query.set("map", methods[this.state.get("method")].key);
    query.set("open", ids.at(shape));
    return pageAddress("index.html", query);
  }

  /**
   * Who its neighbours are, and its neighbourhood hit.
   * @param {number} shape
   * @param {number[]} near
   * @param {Method} method
   */
  #tell(shape, near, method) {
    const { database } = this;
    const { title, features, hit, hitOfClass, faith } = method;
    const kept = Math.round((faith?.kept?.[shape] ?? 0) * near.length);
    /** @type {(string | Node)[]} */
    const words = [
      features.length > 0
        ? `Near on the ${title} map means alike in features. `
        : `The places on the ${title} map were brought along. `,
      faith
        ? kept === near.length
          ? `All of the ${count(near.length, "shape")} most alike are near it here. `
          : `Of the ${count(near.length, "shape")} most alike, ${near.length - kept} ${near.length - kept === 1 ? "is" : "are"} elsewhere on the map. `
        : "",
    ];
    if (!database.labelled) return [...words, `These ${count(near.length, "shape")} are nearest.`];
    const census = database.census(near);
    const own = database.groups[shape];
    const listed = census
      .slice(0, MOST_CLASSES)
      .flatMap(([group, number], place) => [
        place > 0 ? ", " : "",
        `${number} `,
        group < 0
          ? "without label"
          : group === own
            ? `of its own ${kind(database)}`
            : element("bdi", {}, database.className(group)),
      ]);
    words.push(
      `Its ${count(near.length, "nearest neighbour")}: `,
      ...listed,
      census.length > MOST_CLASSES ? ", and others. " : ". ",
    );
    if (hit[shape] === null) return words;
    return [
      ...words,
      `Neighbourhood hit (NH), the share that is of its ${kind(database)}: `,
      element("b", {}, figure(hit[shape])),
      `${ofAtMost(highestOf(database, method, shape))}; its ${kind(database)} on average ${figure(hitOfClass[own])}.`,
    ];
  }

  /** @type {Map<number, { path: string, color: string }>} of the classes, in the theme in use */
  #looks = new Map();

  /** @param {number} index */
  #mark(index) {
    const { database, state } = this;
    const [shape, many] = [state.get("shape"), database.count > MANY];
    const group = database.groups[index];
    const look = entry(this.#looks, group, () => ({ path: database.symbol(group), color: database.color(group) }));
    if (index === shape) return { ...look, radius: 6, alpha: 1 };
    if (this.near.has(index)) return { ...look, radius: many ? 4 : 4.5, alpha: 1 };
    const own = shape !== null && group === database.groups[shape] && database.separable;
    return { ...look, radius: many ? 1.6 : 3, alpha: own ? 0.8 : 0.35 };
  }

  /**
   * Lines to the neighbours, and a ring around the shape itself.
   * @param {Over} over
   */
  #tie(over) {
    const shape = this.state.get("shape");
    if (shape === null) return;
    const place = this.plot.screen(shape);
    over.tie(
      place,
      [...this.near].map((other) => this.plot.screen(other)),
      styleColor("quiet"),
    );
    over.ring(place, 11, styleColor("accent"));
  }
}
