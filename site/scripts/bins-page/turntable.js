// Any bin on any shape, to be turned. The 3D data of a shape is loaded when first asked for.

import { modelBytes } from "../chunks.js";
import { element } from "../dom.js";
import { unpackModel } from "../viewer/model.js";
import { canDraw, View } from "../viewer/view.js";
import { Finder } from "./finder.js";
import { dimensionOf, pictured, shapeLine } from "./look.js";
import { Plot } from "./plot.js";

const KEPT = 8;

export class Turntable {
  constructor(model, bins, selection, state, { pointing, announce }) {
    Object.assign(this, { model, bins, selection, state, announce });
    this.stage = document.getElementById("stage");
    this.name = document.getElementById("turn-name");
    this.colors = { ramp: selection.ramp.map(linear), clay: selection.clay, marked: selection.marked };
    this.asked = false;
    this.#watchReadings();
    this.#watchShapes();
    this.#makePick(pointing);
    state.listen((changed) => {
      if (["bin", "group", "shape", "reading"].some((name) => changed.has(name))) this.render();
      if (changed.has("theme")) this.pick.draw();
    });
  }

  /** The shape that is shown: the one that was chosen, or what shows the bin best. */
  get shape() {
    const [shape, bin] = [this.state.get("shape"), this.state.get("bin")];
    if (shape === "least") return this.#extreme(bin, -1);
    if (shape === "most") return this.#extreme(bin, 1);
    return shape ?? pictured(this.selection, this.model, bin, this.state.get("group"))[0]?.shape ?? this.#extreme(bin, 1);
  }

  #extreme(column, sign) {
    let best = 0;
    for (let row = 1; row < this.bins.rows; row += 1) if (sign * (this.bins.value(column, row) - this.bins.value(column, best)) > 0) best = row;
    return best;
  }

  start() {
    this.pick.show(this.model.methods[0]);
    this.render();
  }

  async render() {
    const { model, bins, state, shape } = this;
    const bin = state.get("bin");
    this.name.replaceChildren(...shapeLine(model, bins, bin, shape), element("span", { class: "quiet which" }, model.labelled ? model.names[shape] : ""));
    for (const end of ["most", "least"]) document.getElementById(`${end}-of-it`).setAttribute("aria-pressed", String(state.get("shape") === end));
    this.pick.draw();
    const reason = this.#impossible(bin);
    if (reason !== null) this.#say(shape, reason);
    else if (this.asked) await this.#show(shape, bin);
    else this.#offer(shape);
  }

  /** Why nothing can be painted, or null. */
  #impossible(bin) {
    if (!this.bins.isShare(bin)) return "This feature has no values on the surface.";
    if (this.selection.models === null) return "This site was built without 3D data of its shapes (--no-meshes).";
    this.capable ??= canDraw();
    return this.capable ? null : "This browser cannot draw in 3D: WebGL 2 is missing or switched off.";
  }

  #say(shape, text) {
    this.#clear(element("img", { src: this.model.picture(shape), alt: "", width: 320, height: 320 }), element("p", { class: "empty", role: "status" }, text));
  }

  #offer(shape) {
    const show = () => {
      this.asked = true;
      this.focusing = true;
      this.render();
    };
    this.#clear(
      element("img", { src: this.model.picture(shape), alt: "", width: 320, height: 320 }),
      element("button", { type: "button", class: "plain strong", id: "show-3d", onclick: show }, "Turn it in 3D"),
    );
  }

  #clear(...nodes) {
    this.view?.close();
    this.view = null;
    this.stage.replaceChildren(...nodes);
    this.stage.removeAttribute("aria-busy");
  }

  async #show(shape, bin) {
    const asked = (this.latest = Symbol("asked"));
    this.stage.setAttribute("aria-busy", "true");
    let solid;
    try {
      solid = await this.#load(shape);
    } catch {
      if (asked === this.latest) this.#say(shape, `There is no 3D data of ${this.model.names[shape]} in this site.`);
      return;
    }
    // Another shape, or another bin, may have been asked for meanwhile.
    if (asked !== this.latest) return;
    this.#prepare();
    const colors = this.#paint(solid, bin);
    if (solid === this.solid) this.view.paint(colors);
    else this.view.show(solid, colors);
    this.solid = solid;
    const { names } = this.bins;
    const reading = this.state.get("reading") === "inside" ? "which points fall into" : "values of";
    this.canvas.setAttribute("aria-label", `${this.model.names[shape]} in 3D, ${reading} ${names[bin]}`);
    this.stage.removeAttribute("aria-busy");
    this.announce(`${this.model.names[shape]}, ${names[bin]}`);
  }

  #prepare() {
    if (this.view) return;
    this.canvas = element("canvas", { tabindex: "0", role: "application", "aria-describedby": "turn-keys" });
    const back = element("button", { type: "button", class: "plain back", hidden: true, onclick: () => this.view.reset() }, "First view");
    this.stage.replaceChildren(this.canvas, back);
    this.solid = null;
    this.view = new View(this.canvas, {
      turned: () => {
        back.hidden = !this.view || (this.view.zoom === 1 && this.view.turn.every((value, place) => value === this.view.model.view[place]));
      },
    });
    if (this.focusing) this.canvas.focus({ preventScroll: true });
    this.focusing = false;
  }

  #models = new Map();

  /** The models used last are kept; the others are loaded anew. */
  async #load(shape) {
    const known = this.#models.get(shape);
    this.#models.delete(shape);
    const solid = known ?? unpackModel(await modelBytes(this.selection.models[shape]));
    this.#models.set(shape, solid);
    if (this.#models.size > KEPT) this.#models.delete(this.#models.keys().next().value);
    return solid;
  }

  #paint(solid, column) {
    const { ramp, clay, marked } = this.colors;
    const inside = this.state.get("reading") === "inside";
    const place = this.bins.binOf(column);
    const bins = solid.bins(dimensionOf(column, this.bins));
    const colors = new Float32Array(3 * solid.vertexCount);
    for (let vertex = 0; vertex < solid.vertexCount; vertex += 1) {
      const color = inside ? (bins[vertex] === place ? marked : clay) : ramp[bins[vertex]];
      colors.set(color, 3 * vertex);
    }
    return colors;
  }

  #watchReadings() {
    const { state } = this;
    const inputs = document.querySelectorAll("#readings input");
    const check = () => {
      for (const input of inputs) input.checked = input.value === state.get("reading");
    };
    for (const input of inputs) input.addEventListener("change", () => state.set({ reading: input.value }));
    state.listen((changed) => changed.has("reading") && check());
    check();
  }

  #watchShapes() {
    const { model, state } = this;
    for (const end of ["most", "least"]) {
      document.getElementById(`${end}-of-it`).addEventListener("click", () => state.set({ shape: end }));
    }
    const texts = model.ids.map((id, index) => `${id}\n${model.names[index]}\n${model.className(model.groups[index])}`.toLocaleLowerCase());
    new Finder("shape", {
      find: (text) => {
        const words = text.toLocaleLowerCase().split(/\s+/);
        return [...texts.keys()].filter((index) => words.every((word) => texts[index].includes(word)));
      },
      label: (index) => [element("bdi", {}, model.names[index]), " ", model.labelled && element("span", { class: "quiet" }, element("bdi", {}, model.className(model.groups[index])))].filter(Boolean),
      choose: (shape) => state.set({ shape }),
    });
  }

  /** The map of all shapes, on which one can be pointed at; large marks have much of the bin. */
  #makePick(pointing) {
    const { model } = this;
    this.pick = new Plot(model, {
      margin: 14,
      first: (index) => index !== this.shape,
      mark: (index) => {
        const group = model.groups[index];
        const share = this.#share(index);
        return { path: model.symbol(group), color: model.color(group), radius: 1.4 + 5 * Math.sqrt(share), alpha: 0.35 + 0.6 * Math.sqrt(share) };
      },
      drawn: () => this.#ring(),
    });
    const surface = document.getElementById("pick-surface");
    surface.append(this.pick.node);
    pointing.watch(surface, this.pick, (shape) => this.state.set({ shape }));
  }

  /** How much of the bin a shape has, from 0 for the least to 1 for the most of all shapes. */
  #share(index) {
    const bin = this.state.get("bin");
    if (this.scale?.bin !== bin) {
      const values = Array.from({ length: this.bins.rows }, (_, row) => this.bins.share(bin, row));
      const [low, high] = [Math.min(...values), Math.max(...values)];
      this.scale = { bin, shares: values.map((value) => (high > low ? (value - low) / (high - low) : 0)) };
    }
    return this.scale.shares[index];
  }

  #ring() {
    const { pen, node } = this.pick;
    const dense = window.devicePixelRatio || 1;
    const [x, y] = this.pick.screen(this.shape);
    pen.globalAlpha = 1;
    pen.lineWidth = 2.5 * dense;
    pen.strokeStyle = getComputedStyle(node).getPropertyValue("--accent");
    pen.beginPath();
    pen.arc(x * dense, y * dense, 9 * dense, 0, 7);
    pen.stroke();
  }
}

/** "#rrggbb" as linear light. */
function linear(code) {
  return [1, 3, 5].map((at) => {
    const value = Number.parseInt(code.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
}
