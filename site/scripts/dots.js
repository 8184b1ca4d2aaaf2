// The marks of a map on a canvas, for as long as they move: drawing them anew costs a millisecond, where the chart
// takes a frame or more. They look as the chart draws them, so that nobody sees the one take over from the other.

import { element } from "./dom.js";
import { CHOSEN, FAINT } from "./scene.js";

const OPACITY = { [FAINT]: 0.14 };

export class Dots {
  constructor(view) {
    this.view = view;
    this.node = element("canvas", { class: "dots", hidden: true, "aria-hidden": "true" });
    this.pen = this.node.getContext("2d");
    view.node.after(this.node);
  }

  draw() {
    const { view, pen } = this;
    const { scene, model } = view;
    const dense = window.devicePixelRatio || 1;
    const [width, height] = [Math.round(view.width * dense), Math.round(view.height * dense)];
    if (this.node.width !== width || this.node.height !== height) Object.assign(this.node, { width, height });
    else pen.clearRect(0, 0, width, height);
    const size = Math.sqrt(view.markSize) / 2;
    pen.strokeStyle = model.marks.outline;
    for (let index = 0; index < model.count; index += 1) {
      if (!scene.visible(index)) continue;
      const [x, y] = view.screen(index);
      const scale = size * (scene.emphasis[index] === CHOSEN ? Math.sqrt(1.5) : 1);
      pen.setTransform(dense * scale, 0, 0, dense * scale, dense * x, dense * y);
      pen.globalAlpha = OPACITY[scene.emphasis[index]] ?? 0.92;
      pen.lineWidth = 0.6 / scale;
      const mark = this.#mark(model.groups[index]);
      pen.fillStyle = view.name === "hit" ? shade(model, index) : model.color(model.groups[index]);
      pen.fill(mark);
      pen.stroke(mark);
    }
    pen.setTransform(1, 0, 0, 1, 0, 0);
    this.#show(true);
  }

  /** The chart shows the same again. */
  clear() {
    if (!this.node.hidden) this.#show(false);
  }

  #show(moving) {
    this.node.hidden = !moving;
    this.view.node.style.visibility = moving ? "hidden" : "";
  }

  #marks = new Map();

  #mark(group) {
    const path = this.view.name === "hit" ? this.view.model.data.marks.plain : this.view.model.symbol(group);
    if (!this.#marks.has(path)) this.#marks.set(path, new Path2D(path));
    return this.#marks.get(path);
  }
}

/** The colour of the hit that a shape had where it came from. */
function shade(model, index) {
  const hit = model.methods[0].hit[index];
  const { hit: ramp, unlabelled } = model.marks;
  return hit === null ? unlabelled : ramp[Math.round(hit * (ramp.length - 1))];
}
