// One gesture for all that is dragged on: a press becomes a box, or it moves what is shown; two fingers pinch. Escape, a
// second finger, and a browser that takes the pointer for itself give a box up.

const CLICK = 4;

/** @typedef {[number, number]} Place  on the surface */

/** What a kind of surface does on each part of the gesture is said by a class of its own. */
export class Brush {
  /** Whether the last press became more than a click. */
  dragged = false;

  #pointers = new Map();
  #press = null;

  constructor(surface) {
    this.surface = surface;
    surface.addEventListener("pointerdown", (event) => this.#down(event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    surface.addEventListener("pointerup", (event) => this.#up(event));
    surface.addEventListener("pointercancel", (event) => this.#cancel(event));
    // Before anything else that Escape closes.
    window.addEventListener("keydown", (event) => this.#escape(event), { capture: true });
  }

  /** Whether this pointer draws here; others are left to the browser. */
  takes(_event) {
    return true;
  }

  /** Whether dragging moves what is shown. */
  moves(_event) {
    return false;
  }

  /**
   * How far a pointer went, to tell a drag from a click.
   * @param {Place} to
   * @param {Place} from
   */
  distance([x, y], [fromX, fromY]) {
    return Math.hypot(x - fromX, y - fromY);
  }

  /** What is shown as a press or a pinch at a place begins; handed on until it ends. */
  hold(_place) {}
  hover(_place, _event) {}
  click(_place, _event) {}
  /** A box begins, grows from one place to another, and is made or given up. */
  begin(_event) {}
  draw(_from, _to, _held) {}
  end() {}
  giveUp() {}
  move(_from, _to, _held) {}
  /** Two fingers, `{ spread, middle }`, before and now. */
  pinch(_before, _now, _held) {}

  /** @returns {Place} */
  placeOf({ clientX, clientY }) {
    const { left, top } = this.surface.getBoundingClientRect();
    return [clientX - left, clientY - top];
  }

  #down(event) {
    this.dragged = false;
    if (event.button === 2 || !this.takes(event)) return;
    const place = this.placeOf(event);
    this.#pointers.set(event.pointerId, place);
    this.surface.setPointerCapture(event.pointerId);
    if (this.#pointers.size === 2) {
      this.#giveUp();
      const fingers = this.#fingers();
      this.#press = { kind: "pinch", fingers, held: this.hold(fingers.middle) };
      return;
    }
    const becomes = this.moves(event) || event.button === 1 ? "move" : "box";
    this.#press = { kind: "click", becomes, from: place, held: this.hold(place) };
  }

  #move(event) {
    const place = this.placeOf(event);
    if (this.#pointers.has(event.pointerId)) this.#pointers.set(event.pointerId, place);
    const press = this.#press;
    if (press === null) {
      this.hover(place, event);
      return;
    }
    if (press.kind === "click" && this.distance(place, press.from) > CLICK) {
      press.kind = press.becomes;
      this.dragged = true;
      if (press.kind === "box") this.begin(event);
    }
    if (press.kind === "box") this.draw(press.from, place, press.held);
    else if (press.kind === "move") this.move(press.from, place, press.held);
    else if (press.kind === "pinch") this.pinch(press.fingers, this.#fingers(), press.held);
  }

  #up(event) {
    const kind = this.#release(event);
    if (kind === "box") this.end();
    else if (kind === "click") this.click(this.placeOf(event), event);
  }

  #cancel(event) {
    this.#giveUp();
    this.#release(event);
  }

  #escape(event) {
    if (event.key !== "Escape" || this.#press?.kind !== "box") return;
    event.preventDefault();
    event.stopPropagation();
    this.#giveUp();
  }

  #giveUp() {
    if (this.#press?.kind !== "box") return;
    this.giveUp();
    this.#press = { kind: "over" };
  }

  /** The pointer is gone; what its press has become. */
  #release(event) {
    const kind = this.#press?.kind;
    this.#pointers.delete(event.pointerId);
    this.#press = null;
    return kind;
  }

  #fingers() {
    const [[ax, ay], [bx, by]] = [...this.#pointers.values()];
    return { spread: Math.max(Math.hypot(ax - bx, ay - by), 1), middle: [(ax + bx) / 2, (ay + by) / 2] };
  }
}

/** A box on a map of shapes: it selects those in it; with shift, beside those that are selected. */
export class ShapeBrush extends Brush {
  #before = null;
  #kept = null;

  /** `plot` says which shapes are inside a rectangle; `frame` is the rectangle of an SVG that shows the box. */
  constructor(surface, frame, plot, state) {
    super(surface);
    this.frame = frame;
    this.plot = plot;
    this.state = state;
  }

  begin({ shiftKey }) {
    this.#before = this.state.get("selection");
    this.#kept = shiftKey ? this.#before : new Set();
    this.state.set({ brushing: true, pointed: null });
  }

  draw([fromX, fromY], [toX, toY]) {
    const [left, right] = [Math.min(fromX, toX), Math.max(fromX, toX)];
    const [top, bottom] = [Math.min(fromY, toY), Math.max(fromY, toY)];
    showBox(this.frame, { x: left, y: top, width: right - left, height: bottom - top });
    this.state.set({ selection: new Set([...this.#kept, ...this.plot.inside(left, top, right, bottom)]) });
  }

  end() {
    showBox(this.frame, null);
    this.state.set({ brushing: false });
  }

  giveUp() {
    this.state.set({ selection: this.#before });
    this.end();
  }
}

/** Show a box as a rectangle of an SVG, or none with null. */
export function showBox(frame, box) {
  frame.classList.toggle("shown", box !== null);
  for (const [name, value] of Object.entries(box ?? {})) frame.setAttribute(name, value);
}
