// Where every shape is at this moment, how present it is, and which part of the plane is in view.
// All maps draw the same scene, which is what links them.

import { calm } from "./dom.js";

const DURATION = 650;
const LARGEST_ZOOM = 40;

export const HIDDEN = 0;
export const FAINT = 1;
export const NORMAL = 2;
export const CHOSEN = 3;

export class Scene {
  constructor(model, state) {
    this.model = model;
    this.state = state;
    this.origin = state.get("method");
    this.target = state.get("method");
    this.progress = 1;
    this.x = Float64Array.from(model.methods[this.target].x);
    this.y = Float64Array.from(model.methods[this.target].y);
    this.bounds = model.bounds[this.target];
    this.emphasis = [];
    this.matches = null;
    this.views = [];
    this.#weigh();
    state.listen((changed) => {
      if (changed.has("method")) this.#travel(state.get("method"));
      if (["hidden", "selection", "matches", "pointedGroup"].some((name) => changed.has(name))) this.#weigh();
      if (["camera", "hidden", "selection", "matches", "pointedGroup", "pointed", "opened"].some((name) => changed.has(name))) this.draw();
    });
  }

  /** Draw all maps with the next frame. */
  draw() {
    this.#frame ??= requestAnimationFrame(() => {
      this.#frame = null;
      for (const view of this.views) view.draw();
    });
    clearTimeout(this.#settling);
    this.#settling = setTimeout(() => this.views.forEach((view) => view.settle()), 160);
  }

  #frame = null;
  #settling = null;

  visible(index) {
    return this.emphasis[index] > HIDDEN;
  }

  /** Move all points to another projection, on a straight way; the camera goes back to showing all of it. */
  #travel(target) {
    this.origin = this.target;
    this.target = target;
    const from = this.bounds;
    const to = this.model.bounds[target];
    const camera = this.state.get("camera");
    const started = performance.now();
    const step = () => {
      if (this.target !== target) return;
      const linear = calm() ? 1 : Math.min(1, (performance.now() - started) / DURATION);
      this.#place(eased(linear));
      const mix = (a, b) => a + this.progress * (b - a);
      this.bounds = {
        x: mix(from.x, to.x),
        y: mix(from.y, to.y),
        width: mix(from.width, to.width),
        height: mix(from.height, to.height),
      };
      if (camera) {
        const whole = { x: this.bounds.x, y: this.bounds.y, zoom: 1 };
        const view = { x: mix(camera.x, whole.x), y: mix(camera.y, whole.y), zoom: mix(camera.zoom, 1) };
        this.state.set({ camera: linear < 1 ? view : null });
      }
      this.draw();
      if (linear < 1) requestAnimationFrame(step);
    };
    step();
  }

  #place(progress) {
    this.progress = progress;
    const [from, to] = [this.model.methods[this.origin], this.model.methods[this.target]];
    for (let index = 0; index < this.x.length; index += 1) {
      this.x[index] = from.x[index] + progress * (to.x[index] - from.x[index]);
      this.y[index] = from.y[index] + progress * (to.y[index] - from.y[index]);
    }
  }

  /** How present each shape is; a new array, because charts compare by identity. */
  #weigh() {
    const hidden = this.state.get("hidden");
    const selection = this.state.get("selection");
    const matches = this.state.get("matches");
    const pointed = this.state.get("pointedGroup");
    this.emphasis = this.model.groups.map((group, index) => {
      if (hidden.has(group)) return HIDDEN;
      if (pointed !== null) return group === pointed ? CHOSEN : FAINT;
      if (selection.size > 0) return selection.has(index) ? CHOSEN : FAINT;
      if (matches) return matches.has(index) ? CHOSEN : FAINT;
      return NORMAL;
    });
  }

  camera() {
    return this.state.get("camera") ?? { x: this.bounds.x, y: this.bounds.y, zoom: 1 };
  }

  /** Look at another part of the plane; kept so that some of the map always stays in view. */
  look(camera) {
    const zoom = Math.min(Math.max(camera.zoom, 1), LARGEST_ZOOM);
    if (zoom <= 1.001) {
      this.state.set({ camera: null });
      return;
    }
    const within = (value, centre, size) => Math.min(Math.max(value, centre - size / 2), centre + size / 2);
    const { x, y, width, height } = this.bounds;
    this.state.set({ camera: { x: within(camera.x, x, width), y: within(camera.y, y, height), zoom } });
  }
}

function eased(t) {
  return t < 0.5 ? 4 * t ** 3 : 1 - (2 - 2 * t) ** 3 / 2;
}
