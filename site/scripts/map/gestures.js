// Pointer, wheel and keys on a map.

import { toggled } from "../database/selection.js";
import { ShapeBrush } from "./brush.js";

/** @import { Fingers, Place } from "./brush.js" */
/** @import { MapView } from "./map.js" */
/** @import { Camera } from "./scene.js" */

export class Gestures extends ShapeBrush {
  /**
   * @param {MapView} view
   * @param {object} ways
   * @param {(index: number) => void} ways.open is told of the shape that is clicked
   * @param {(index: number) => void} ways.announce of the shape that keys went to
   */
  constructor(view, { open, announce }) {
    super(view.surface, view.brush, view, view.state);
    this.view = view;
    this.scene = view.scene;
    this.open = open;
    this.announce = announce;
    const { surface } = view;
    surface.addEventListener("pointerleave", () => this.state.set({ pointed: null }));
    surface.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    surface.addEventListener("keydown", (event) => this.#key(event));
    surface.addEventListener("blur", () => this.state.set({ pointed: null }));
  }

  moves() {
    return this.state.get("drag") === "move";
  }

  hold() {
    return this.scene.camera();
  }

  /**
   * @param {Place} place
   * @param {PointerEvent} event
   */
  hover(place, { pointerType }) {
    const index = this.view.at(...place, pointerType === "mouse" ? 6 : 14);
    this.surface.classList.toggle("on-shape", index !== null);
    this.state.set({ pointed: index, pointedFrom: this.view });
  }

  /**
   * @param {Place} place
   * @param {PointerEvent} event
   */
  click(place, { pointerType, shiftKey }) {
    const index = this.view.at(...place, pointerType === "mouse" ? 6 : 16);
    if (index !== null && shiftKey) this.#toggle(index);
    else if (index !== null) this.open(index);
    else this.state.set({ selection: new Set() });
  }

  /**
   * @param {Place} from
   * @param {Place} to
   * @param {Camera} camera
   */
  move([fromX, fromY], [toX, toY], camera) {
    const { scale } = this.view;
    this.state.set({ pointed: null });
    this.scene.look({ ...camera, x: camera.x - (toX - fromX) / scale, y: camera.y + (toY - fromY) / scale });
  }

  /**
   * @param {Fingers} before
   * @param {Fingers} now
   * @param {Camera} camera
   */
  pinch(before, now, camera) {
    const zoom = (camera.zoom * now.spread) / before.spread;
    const whole = this.view.scale / this.scene.camera().zoom;
    const [old, scale] = [whole * camera.zoom, whole * zoom];
    const { width, height } = this.view;
    const x = camera.x + (before.middle[0] - width / 2) / old;
    const y = camera.y - (before.middle[1] - height / 2) / old;
    this.scene.look({
      x: x - (now.middle[0] - width / 2) / scale,
      y: y + (now.middle[1] - height / 2) / scale,
      zoom,
    });
  }

  /** @param {number} index */
  #toggle(index) {
    this.state.set({ selection: toggled(this.state.get("selection"), index) });
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    // Where the page itself scrolls, the wheel belongs to it unless the reader asks for zoom.
    const scrolls = document.documentElement.scrollHeight > window.innerHeight + 1;
    if (scrolls && !event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 18 : 1;
    this.zoom(Math.exp((-event.deltaY * lines * (event.ctrlKey ? 4 : 1)) / 500), this.placeOf(event));
  }

  /**
   * Zoom by a factor with one place of the screen held still; the middle unless another is given.
   * @param {number} factor
   * @param {Place} [place]
   */
  zoom(factor, place = [this.view.width / 2, this.view.height / 2]) {
    const camera = this.scene.camera();
    const zoom = Math.min(Math.max(camera.zoom * factor, 1), 40);
    const [x, y] = this.view.toPlane(...place);
    const keep = camera.zoom / zoom;
    this.scene.look({ x: x + (camera.x - x) * keep, y: y + (camera.y - y) * keep, zoom });
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    /** @type {Record<string, Place>} */
    const directions = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const pointed = this.state.get("pointed");
    if (event.key in directions) {
      if (event.shiftKey) this.#pan(directions[event.key]);
      else this.#step(directions[event.key]);
    } else if (event.key === "Enter") {
      if (pointed !== null) this.open(pointed);
    } else if (event.key === " ") {
      if (pointed !== null) this.#toggle(pointed);
    } else return;
    event.preventDefault();
  }

  /** @param {Place} way */
  #pan([dx, dy]) {
    const camera = this.scene.camera();
    const step = 80 / this.view.scale;
    this.scene.look({ ...camera, x: camera.x + dx * step, y: camera.y - dy * step });
  }

  /**
   * Go to the nearest shape that lies more in a direction than beside it.
   * @param {Place} way
   */
  #step([dx, dy]) {
    const { view, scene } = this;
    const from = this.state.get("pointed");
    const [x, y] = from === null ? [view.width / 2, view.height / 2] : view.screen(from);
    /** @type {[number | null, number]} */
    let [best, least] = [null, Infinity];
    for (let index = 0; index < view.database.count; index += 1) {
      if (index === from || !scene.visible(index)) continue;
      const [px, py] = view.screen(index);
      const along = (px - x) * dx + (py - y) * dy;
      const across = Math.abs((px - x) * dy) + Math.abs((py - y) * dx);
      if (from !== null && (along <= 0 || across > along)) continue;
      const distance = Math.hypot(px - x, py - y) + across;
      if (distance < least) [best, least] = [index, distance];
    }
    if (best === null) return;
    const [px, py] = view.screen(best);
    if (px < 0 || py < 0 || px > view.width || py > view.height) {
      scene.look({ ...scene.camera(), x: scene.x[best], y: scene.y[best] });
    }
    this.state.set({ pointed: best, pointedFrom: view });
    this.announce(best);
  }
}
