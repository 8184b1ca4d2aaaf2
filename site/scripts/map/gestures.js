// Pointer, wheel and keys on a map.

import { toggled } from "../database/selection.js";

const CLICK = 4;

export class Gestures {
  #pointers = new Map();
  #drag = null;

  constructor(view, { open, promote, announce }) {
    this.view = view;
    this.scene = view.scene;
    this.state = view.state;
    this.open = open;
    this.promote = promote;
    this.announce = announce;
    const { surface } = view;
    surface.addEventListener("pointerdown", (event) => this.#down(event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    surface.addEventListener("pointerup", (event) => this.#up(event));
    surface.addEventListener("pointercancel", (event) => this.#cancel(event));
    surface.addEventListener("pointerleave", () => this.state.set({ pointed: null }));
    surface.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    surface.addEventListener("keydown", (event) => this.#key(event));
    surface.addEventListener("blur", () => this.state.set({ pointed: null }));
  }

  #place(event) {
    const box = this.view.surface.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #down(event) {
    if (event.button === 2) return;
    const place = this.#place(event);
    this.#pointers.set(event.pointerId, place);
    this.view.surface.setPointerCapture(event.pointerId);
    if (this.#pointers.size === 2) {
      this.#drag = { kind: "pinch", ...this.#pinch(), camera: this.scene.camera() };
      this.#hideBrush();
      return;
    }
    const moves = this.state.get("drag") === "move" || event.button === 1;
    this.#drag = {
      kind: "press",
      becomes: moves ? "move" : "select",
      start: place,
      camera: this.scene.camera(),
      before: event.shiftKey ? this.state.get("selection") : new Set(),
    };
  }

  #move(event) {
    const place = this.#place(event);
    if (this.#pointers.has(event.pointerId)) this.#pointers.set(event.pointerId, place);
    const drag = this.#drag;
    if (!drag) {
      this.#point(place, event.pointerType === "mouse" ? 6 : 14);
      return;
    }
    if (drag.kind === "pinch") {
      this.#stretch(drag);
      return;
    }
    const [dx, dy] = [place[0] - drag.start[0], place[1] - drag.start[1]];
    if (drag.kind === "press" && Math.hypot(dx, dy) > CLICK) {
      drag.kind = drag.becomes;
      this.state.set({ pointed: null, brushing: drag.kind === "select" });
    }
    if (drag.kind === "move") {
      const scale = this.view.scale;
      this.scene.look({ ...drag.camera, x: drag.camera.x - dx / scale, y: drag.camera.y + dy / scale });
    }
    if (drag.kind === "select") this.#select(drag, place);
  }

  #up(event) {
    const drag = this.#drag;
    this.#release(event);
    if (drag?.kind !== "press") return;
    const index = this.view.at(...this.#place(event), event.pointerType === "mouse" ? 6 : 16);
    if (!this.view.large) this.promote(this.view.name);
    else if (index !== null && event.shiftKey) this.#toggle(index);
    else if (index !== null) this.open(index);
    else this.state.set({ selection: new Set() });
  }

  #cancel(event) {
    this.#release(event);
  }

  #release(event) {
    this.#pointers.delete(event.pointerId);
    this.#hideBrush();
    this.#drag = null;
    this.state.set({ brushing: false });
  }

  #hideBrush() {
    this.view.brush.classList.remove("shown");
  }

  #point(place, reach) {
    const index = this.view.at(...place, reach);
    this.view.surface.classList.toggle("on-shape", index !== null);
    this.state.set({ pointed: index, pointedFrom: this.view });
  }

  #select(drag, place) {
    const [x, y] = place;
    const [left, right] = [Math.min(x, drag.start[0]), Math.max(x, drag.start[0])];
    const [top, bottom] = [Math.min(y, drag.start[1]), Math.max(y, drag.start[1])];
    const { brush } = this.view;
    brush.classList.add("shown");
    brush.setAttribute("x", left);
    brush.setAttribute("y", top);
    brush.setAttribute("width", right - left);
    brush.setAttribute("height", bottom - top);
    this.state.set({ selection: new Set([...drag.before, ...this.view.inside(left, top, right, bottom)]) });
  }

  #toggle(index) {
    this.state.set({ selection: toggled(this.state.get("selection"), index) });
  }

  #pinch() {
    const [[ax, ay], [bx, by]] = [...this.#pointers.values()];
    return { spread: Math.hypot(ax - bx, ay - by), middle: [(ax + bx) / 2, (ay + by) / 2] };
  }

  #stretch(drag) {
    const { spread, middle } = this.#pinch();
    const factor = spread / Math.max(drag.spread, 1);
    const zoom = drag.camera.zoom * factor;
    const scale = (this.view.scale / this.scene.camera().zoom) * zoom;
    const old = (this.view.scale / this.scene.camera().zoom) * drag.camera.zoom;
    const { width, clearHeight: height } = this.view;
    const x = drag.camera.x + (drag.middle[0] - width / 2) / old;
    const y = drag.camera.y - (drag.middle[1] - height / 2) / old;
    this.scene.look({ x: x - (middle[0] - width / 2) / scale, y: y + (middle[1] - height / 2) / scale, zoom });
  }

  #wheel(event) {
    // Where the page itself scrolls, the wheel belongs to it unless the reader asks for zoom.
    const scrolls = document.documentElement.scrollHeight > window.innerHeight + 1;
    if (!this.view.large || (scrolls && !event.ctrlKey && !event.metaKey)) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 18 : 1;
    this.zoom(Math.exp((-event.deltaY * lines * (event.ctrlKey ? 4 : 1)) / 500), this.#place(event));
  }

  /** Zoom by a factor with one place of the screen held still; the middle unless another is given. */
  zoom(factor, place = [this.view.width / 2, this.view.clearHeight / 2]) {
    const camera = this.scene.camera();
    const zoom = Math.min(Math.max(camera.zoom * factor, 1), 40);
    const [x, y] = this.view.toPlane(...place);
    const keep = camera.zoom / zoom;
    this.scene.look({ x: x + (camera.x - x) * keep, y: y + (camera.y - y) * keep, zoom });
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const directions = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const pointed = this.state.get("pointed");
    if (event.key in directions) {
      if (event.shiftKey) this.#pan(directions[event.key]);
      else this.#step(directions[event.key]);
    } else if (event.key === "Enter") {
      if (!this.view.large) this.promote(this.view.name);
      else if (pointed !== null) this.open(pointed);
    } else if (event.key === " ") {
      if (pointed !== null) this.#toggle(pointed);
    } else return;
    event.preventDefault();
  }

  #pan([dx, dy]) {
    const camera = this.scene.camera();
    const step = 80 / this.view.scale;
    this.scene.look({ ...camera, x: camera.x + dx * step, y: camera.y - dy * step });
  }

  /** Go to the nearest shape that lies more in a direction than beside it. */
  #step([dx, dy]) {
    const { view, scene } = this;
    const from = this.state.get("pointed");
    const [x, y] = from === null ? [view.width / 2, view.clearHeight / 2] : view.screen(from);
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
    if (px < 0 || py < 0 || px > view.width || py > view.clearHeight) {
      scene.look({ ...scene.camera(), x: scene.x[best], y: scene.y[best] });
    }
    this.state.set({ pointed: best, pointedFrom: view });
    this.announce(best);
  }
}
