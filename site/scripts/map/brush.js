// One gesture for all that is dragged on: a press becomes an area, or it moves what is shown; two fingers pinch. Escape, a
// second finger, and a browser that takes the pointer for itself give an area up.

import { combined } from "../database/selection.js";
import { boxOf, lassoOf } from "./area.js";

/** @import { State } from "../base/state.js" */
/** @import { Join, Shared } from "../database/selection.js" */
/** @import { Area } from "./area.js" */
/** @import { MapValues } from "./scene.js" */

/**
 * What a press is becoming, and what was shown as it began.
 * @typedef {{ kind: "click" | "area" | "move", becomes: "area" | "move", from: Place, held: any }} Press
 * @typedef {{ spread: number, middle: Place }} Fingers
 * @typedef {{ kind: "pinch", fingers: Fingers, held: any } | { kind: "over" }} Other
 * @typedef {PointerEvent & Targeted} Pointed
 */

const CLICK = 4;

/** Two clicks are one double click within these milliseconds and pixels. */
const DOUBLE = 400;
const SAME = 12;

/** @typedef {[number, number]} Place  on the surface */

/** What a kind of surface does on each part of the gesture is said by a class of its own. */
export class Brush {
  /** Whether the last press became more than a click. */
  dragged = false;

  /** @type {Map<number, Place>} */
  #pointers = new Map();
  /** @type {Press | Other | null} */
  #press = null;
  /** @type {{ time: number, place: Place } | null} */
  #clicked = null;

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
   * A second click where the first one was.
   * @param {Place} place
   * @param {Pointed} event
   */
  double(place, event) {
    this.click(place, event);
  }
  /**
   * An area begins, grows from one place to another, and is made or given up.
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
    const becomes = this.moves(event) || event.button === 1 ? "move" : "area";
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
      if (press.kind === "area") this.begin(event);
    }
    if (press.kind === "area") this.draw(press.from, place, press.held);
    else if (press.kind === "move") this.move(press.from, place, press.held);
    else if (press.kind === "pinch") this.pinch(press.fingers, this.#fingers(), press.held);
  }

  /** @param {Pointed} event */
  #up(event) {
    const kind = this.#release(event);
    if (kind === "area") this.end();
    else if (kind === "click") this.#click(this.placeOf(event), event);
  }

  /**
   * @param {Place} place
   * @param {Pointed} event
   */
  #click(place, event) {
    const before = this.#clicked;
    const again = before && event.timeStamp - before.time < DOUBLE && this.distance(place, before.place) < SAME;
    this.#clicked = again ? null : { time: event.timeStamp, place };
    if (again) this.double(place, event);
    else this.click(place, event);
  }

  /** @param {Pointed} event */
  #cancel(event) {
    this.#giveUp();
    this.#release(event);
  }

  /** @param {KeyboardEvent} event */
  #escape(event) {
    if (event.key !== "Escape" || this.#press?.kind !== "area") return;
    event.preventDefault();
    event.stopPropagation();
    this.#giveUp();
  }

  #giveUp() {
    if (this.#press?.kind !== "area") return;
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

/** @typedef {{ inside(holds: Area["holds"]): number[] }} Inside  says which of the shapes that it shows an area of the surface holds */

/** Places of a lasso are so many pixels apart. */
const STRIDE = 3;

/**
 * Whether a press with these keys selects, wherever dragging moves.
 * @param {{ shiftKey: boolean, altKey: boolean, ctrlKey: boolean, metaKey: boolean }} keys
 */
export function selects({ shiftKey, altKey, ctrlKey, metaKey }) {
  return shiftKey || altKey || ctrlKey || metaKey;
}

/**
 * A box or a lasso on a map of shapes: it selects those in it; with Shift, beside those that are selected; with Alt, it
 * takes them out. The state says which of the two a drag draws; with Ctrl or Command it is the other one.
 */
export class ShapeBrush extends Brush {
  /** @type {Set<number>} */
  #before = new Set();
  /** @type {Join} */
  #join = "replace";
  /** @type {Place[] | null} the way of a lasso */
  #line = null;

  /**
   * @param {HTMLElement} surface
   * @param {SVGPathElement} outline shows the area
   * @param {Inside} plot
   * @param {State<MapValues & Shared>} state
   */
  constructor(surface, outline, plot, state) {
    super(surface);
    this.outline = outline;
    this.plot = plot;
    this.state = state;
  }

  /** @param {Pointed} event */
  begin({ shiftKey, altKey, ctrlKey, metaKey }) {
    this.#before = this.state.get("selection");
    this.#join = altKey ? "subtract" : shiftKey ? "add" : (this.state.get("join") ?? "replace");
    this.#line = (this.state.get("drag") === "lasso") === (ctrlKey || metaKey) ? null : [];
    this.state.set({ brushing: true, pointed: null });
  }

  /**
   * @param {Place} from
   * @param {Place} to
   */
  draw(from, to) {
    const { path, holds } = this.#line === null ? boxOf(from, to) : lassoOf(this.#extend(this.#line, from, to));
    this.outline.classList.add("shown");
    this.outline.setAttribute("d", path);
    this.state.set({ selection: combined(this.#before, this.plot.inside(holds), this.#join) });
  }

  /**
   * @param {Place[]} line
   * @param {Place} from
   * @param {Place} to
   */
  #extend(line, from, to) {
    if (line.length === 0) line.push(from);
    if (Math.hypot(to[0] - line.at(-1)[0], to[1] - line.at(-1)[1]) >= STRIDE) line.push(to);
    return line;
  }

  end() {
    this.outline.classList.remove("shown");
    this.state.set({ brushing: false });
  }

  giveUp() {
    this.state.set({ selection: this.#before });
    this.end();
  }
}
