// Pointer, wheel and keys on a map.

import { unstep } from "../base/place.js";
import { clicked, combined, toggled } from "../database/selection.js";
import { boxOf } from "./area.js";
import { ShapeBrush, selects } from "./brush.js";
import { LARGEST_ZOOM } from "./scene.js";

/** @import { Join } from "../database/selection.js" */
/** @import { Fingers, Place } from "./brush.js" */
/** @import { MapView } from "./map.js" */
/** @import { Camera } from "./scene.js" */

/** Space about the shapes that are zoomed to, in pixels, and how far one of them is zoomed to. */
const SPACE = 48;
const CLOSEST = 8;

export class Gestures extends ShapeBrush {
  /** @type {Set<number> | null} what the first of two clicks dropped */
  #dropped = null;
  /** @type {number | null} the last shape that Space took in or out */
  #anchor = null;

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

  /** @param {PointerEvent} event */
  moves(event) {
    return this.state.get("drag") === "move" && !selects(event);
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
  click(place, event) {
    const index = this.view.at(...place, event.pointerType === "mouse" ? 6 : 16);
    const selection = this.state.get("selection");
    this.#dropped = null;
    if (selects(event)) {
      if (index !== null) this.state.set({ selection: clicked(selection, index, event) });
    } else if (index !== null) this.open(index);
    else {
      this.#dropped = selection;
      this.state.set({ selection: new Set() });
    }
  }

  /**
   * Zoom to where it was clicked; what the first click dropped is selected again.
   * @param {Place} place
   * @param {PointerEvent} event
   */
  double(place, event) {
    if (selects(event)) {
      this.click(place, event);
      return;
    }
    if (this.#dropped?.size) {
      unstep();
      this.state.set({ selection: this.#dropped });
    }
    this.zoom(2, place);
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
    const zoom = Math.min(Math.max(camera.zoom * factor, 1), LARGEST_ZOOM);
    const [x, y] = this.view.meant(...place);
    const keep = camera.zoom / zoom;
    this.scene.look({ x: x + (camera.x - x) * keep, y: y + (camera.y - y) * keep, zoom });
  }

  /** Zoom until the selected shapes, as far as they are shown, fill the map. */
  zoomToSelection() {
    this.zoomTo([...this.state.get("selection")]);
  }

  /**
   * Zoom until some shapes, as far as they are shown, fill the map.
   * @param {number[]} shapes
   */
  zoomTo(shapes) {
    const { scene, view } = this;
    const shown = shapes.filter((index) => scene.visible(index));
    if (shown.length === 0) return;
    const [x, y] = [scene.x, scene.y].map((values) => shown.map((index) => values[index]));
    const [west, east, south, north] = [Math.min(...x), Math.max(...x), Math.min(...y), Math.max(...y)];
    const whole = view.scale / scene.camera().zoom;
    const scale = Math.min(
      Math.max(view.width - 2 * SPACE, SPACE) / (east - west),
      Math.max(view.height - 2 * SPACE, SPACE) / (north - south),
    );
    const zoom = Math.min(scale / whole, CLOSEST);
    scene.look({ x: (west + east) / 2, y: (south + north) / 2, zoom });
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if ((event.ctrlKey || event.metaKey) && event.key === "a") {
      this.#take(
        this.view.inside(() => true),
        "replace",
      );
      event.preventDefault();
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    /** @type {Record<string, Place>} */
    const directions = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const pointed = this.state.get("pointed");
    if (event.key in directions) {
      if (event.shiftKey) this.#pan(directions[event.key]);
      else this.#step(directions[event.key]);
    } else if (event.key === "Enter") {
      if (pointed !== null) this.open(pointed);
    } else if (event.key === " " || (event.shiftKey && event.key === "Delete")) {
      if (pointed !== null) this.#pick(pointed, event);
    } else if (event.key === "z") this.zoomToSelection();
    else return;
    event.preventDefault();
  }

  /**
   * Take a shape in or out; with Shift, what lies in the box between it and the one before, as a drag would.
   * @param {number} index
   * @param {KeyboardEvent} event
   */
  #pick(index, { key, shiftKey }) {
    const before = this.#anchor ?? index;
    this.#anchor = index;
    if (!shiftKey) this.state.set({ selection: toggled(this.state.get("selection"), index) });
    else {
      const [from, to] = [before, index].map((corner) => /** @type {Place} */ (this.view.screen(corner)));
      this.#take(this.view.inside(boxOf(from, to).holds), key === "Delete" ? "subtract" : "add");
    }
  }

  /**
   * @param {number[]} found
   * @param {Join} join
   */
  #take(found, join) {
    this.state.set({ selection: combined(this.state.get("selection"), found, join) });
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
