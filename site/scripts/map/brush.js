// One gesture for all that is dragged on: a press becomes a box, or it moves what is shown; two fingers pinch. Escape, a
// second finger, and a browser that takes the pointer for itself give a box up.

/** @import { State } from "../base/state.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { MapValues } from "./scene.js" */

/**
 * What a press is becoming, and what was shown as it began.
 * @typedef {{ kind: "click" | "box" | "move", becomes: "box" | "move", from: Place, held: any }} Press
 * @typedef {{ spread: number, middle: Place }} Fingers
 * @typedef {{ kind: "pinch", fingers: Fingers, held: any } | { kind: "over" }} Other
 * @typedef {PointerEvent & Targeted} Pointed
 */

const CLICK = 4;

/** @typedef {[number, number]} Place  on the surface */

/** What a kind of surface does on each part of the gesture is said by a class of its own. */
export class Brush {
  /** Whether the last press became more than a click. */
  dragged = false;

  /** @type {Map<number, Place>} */
  #pointers = new Map();
  /** @type {Press | Other | null} */
  #press = null;

  /** @param {HTMLElement} surface */
  constructor(surface) {
    this.surface = surface;
    surface.addEventListener("pointerdown", (event) => this.#down(event));
    surface.addEventListener("pointermove", (event) => this.#move(event));
    surface.addEventListener("pointerup", (event) => this.#up(event));
    surface.addEventListener("pointercancel", (event) => this.#cancel(event));
    // Before anything else that Escape closes.
    window.addEventListener("keydown", (event) => this.#escape(event), { capture: true });
  }

  /**
   * Whether this pointer draws here; others are left to the browser.
   * @param {Pointed} _event
   */
  takes(_event) {
    return true;
  }

  /**
   * Whether dragging moves what is shown.
   * @param {Pointed} _event
   */
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

  /**
   * What is shown as a press or a pinch at a place begins; handed on until it ends.
   * @param {Place} _place
   * @returns {any}
   */
  hold(_place) {}
  /**
   * @param {Place} _place
   * @param {Pointed} _event
   */
  hover(_place, _event) {}
  /**
   * @param {Place} _place
   * @param {Pointed} _event
   */
  click(_place, _event) {}
  /**
   * A box begins, grows from one place to another, and is made or given up.
   * @param {Pointed} _event
   */
  begin(_event) {}
  /**
   * @param {Place} _from
   * @param {Place} _to
   * @param {any} _held
   */
  draw(_from, _to, _held) {}
  end() {}
  giveUp() {}
  /**
   * @param {Place} _from
   * @param {Place} _to
   * @param {any} _held
   */
  move(_from, _to, _held) {}
  /**
   * Two fingers, before and now.
   * @param {Fingers} _before
   * @param {Fingers} _now
   * @param {any} _held
   */
  pinch(_before, _now, _held) {}

  /**
   * @param {{ clientX: number, clientY: number }} event
   * @returns {Place}
   */
  placeOf({ clientX, clientY }) {
    const { left, top } = this.surface.getBoundingClientRect();
    return [clientX - left, clientY - top];
  }

  /** @param {Pointed} event */
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

  /** @param {Pointed} event */
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

  /** @param {Pointed} event */
  #up(event) {
    const kind = this.#release(event);
    if (kind === "box") this.end();
    else if (kind === "click") this.click(this.placeOf(event), event);
  }

  /** @param {Pointed} event */
  #cancel(event) {
    this.#giveUp();
    this.#release(event);
  }

  /** @param {KeyboardEvent} event */
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

  /**
   * The pointer is gone; what its press has become.
   * @param {Pointed} event
   */
  #release(event) {
    const kind = this.#press?.kind;
    this.#pointers.delete(event.pointerId);
    this.#press = null;
    return kind;
  }

  /** @returns {Fingers} */
  #fingers() {
    const [[ax, ay], [bx, by]] = [...this.#pointers.values()];
    return { spread: Math.max(Math.hypot(ax - bx, ay - by), 1), middle: [(ax + bx) / 2, (ay + by) / 2] };
  }
}

/** @typedef {{ inside(left: number, top: number, right: number, bottom: number): number[] }} Inside  says which shapes are inside a rectangle */

/** A box on a map of shapes: it selects those in it; with shift, beside those that are selected. */
export class ShapeBrush extends Brush {
  /** @type {Set<number>} */
  #before = new Set();
  /** @type {Set<number>} */
  #kept = new Set();

  /**
   * @param {HTMLElement} surface
   * @param {SVGRectElement} frame shows the box
   * @param {Inside} plot
   * @param {State<MapValues & Shared>} state
   */
  constructor(surface, frame, plot, state) {
    super(surface);
    this.frame = frame;
    this.plot = plot;
    this.state = state;
  }

  /** @param {Pointed} event */
  begin({ shiftKey }) {
    this.#before = this.state.get("selection");
    this.#kept = shiftKey ? this.#before : new Set();
    this.state.set({ brushing: true, pointed: null });
  }

  /**
   * @param {Place} from
   * @param {Place} to
   */
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

/**
 * Show a box as a rectangle of an SVG, or none with null.
 * @param {Element} frame
 * @param {{ x: number, y: number, width: number, height: number } | null} box
 */
export function showBox(frame, box) {
  frame.classList.toggle("shown", box !== null);
  for (const [name, value] of Object.entries(box ?? {})) frame.setAttribute(name, value);
}
