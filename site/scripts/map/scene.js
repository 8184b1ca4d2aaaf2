// Where every shape is at this moment, how present it is, and which part of the plane is in view.
// All maps draw the same scene, which is what links them.

import { calm, coarse } from "../base/dom.js";

/** @import { State } from "../base/state.js" */
/** @import { Bounds, Database } from "../database/database.js" */
/** @import { Join } from "../database/selection.js" */
/** @import { TrueNeighbours } from "../database/true-neighbours.js" */
/** @import { Coloring } from "./coloring.js" */
/** @import { MapView } from "./map.js" */

/**
 * The part of the plane in view: its middle, and how much it is magnified.
 * @typedef {{ x: number, y: number, zoom: number }} Camera
 *
 * How present a shape is.
 * @typedef {0 | 1 | 2 | 3} Emphasis
 *
 * What scenes and views read of the state of a page; the camera by the name that the scene has for it.
 * @typedef {object} MapValues
 * @property {number} method the map that is shown
 * @property {Set<number>} hidden classes
 * @property {Set<number>} selection
 * @property {boolean} [exact] whether pictures stand at their exact places
 * @property {Set<number> | null} matches shapes that a search finds
 * @property {number | null} opened
 * @property {number | null} pointed
 * @property {MapView | null} pointedFrom
 * @property {number | null} pointedGroup
 * @property {number[] | null} [pointedShapes] those of a line of a legend
 * @property {Coloring | null} [coloring] what else than the classes the marks are coloured by, as far as it is made
 * @property {boolean} [lines] whether lines lead from a shape to those most alike
 * @property {object} [alike] changes as soon as more is known of who is alike
 * @property {"move" | "select" | "lasso"} drag what dragging does: with "select" it draws a box
 * @property {Join} [join] what a drawn area does to the selection, where no key says it
 */

const DURATION = 650;
export const LARGEST_ZOOM = 40;
const CROWD = 1500;

/** What says how present a shape is. */
const WEIGHED = ["hidden", "selection", "matches", "pointedGroup", "pointedShapes"];

/** And what rings and lines are about. */
const RINGED = ["pointed", "opened", "lines", "alike"];

export const HIDDEN = 0;
export const FAINT = 1;
export const NORMAL = 2;
export const CHOSEN = 3;

/**
 * Whether there are so many shapes that maps draw them themselves: a chart would take a second for every change.
 * @param {Database} database
 */
export function crowded(database) {
  return database.count > CROWD;
}

/** The part of a page's state that says what is under the pointer: nothing, at first. */
/** @type {Readonly<Pick<MapValues, "pointed" | "pointedFrom" | "pointedGroup" | "pointedShapes">>} */
export const NOTHING_POINTED = Object.freeze({
  pointed: null,
  pointedFrom: null,
  pointedGroup: null,
  pointedShapes: null,
});

/**
 * The part that says what dragging does, at first: fingers move a map, a mouse selects.
 * @returns {Pick<MapValues, "drag" | "join">}
 */
export function dragging() {
  return { drag: coarse() ? "move" : "select", join: "replace" };
}

export class Scene {
  /**
   * @param {Database} database
   * @param {State} state
   * @param {string} [camera] names the state's value for the part of the plane in view
   */
  constructor(database, state, camera = "camera") {
    this.database = database;
    this.state = state;
    this.cameraName = camera;
    this.origin = state.get("method");
    this.target = state.get("method");
    this.progress = 1;
    this.x = Float64Array.from(database.methods[this.target].x);
    this.y = Float64Array.from(database.methods[this.target].y);
    /** @type {Bounds} */
    this.bounds = database.bounds[this.target];
    /** @type {Uint8Array} an Emphasis a shape */
    this.emphasis = new Uint8Array(database.count);
    this.present = 0;
    this.moving = false;
    /** @type {MapView[]} */
    this.views = [];
    /** @type {TrueNeighbours | null} */
    this.alike = null;
    this.weigh();
    state.listen((changed) => {
      if (changed.has("method")) this.#travel(state.get("method"), changed.has(camera));
      if (WEIGHED.some((name) => changed.has(name))) this.weigh();
      if ([camera, ...WEIGHED, "exact"].some((name) => changed.has(name))) this.draw();
      else if (RINGED.some((name) => changed.has(name))) for (const view of this.views) view.drawRings();
      if (changed.has("brushing") && crowded(database)) this.draw();
    });
  }

  /** Draw all maps with the next frame; of a crowd the first, and the others with every fourth and when all is still. */
  draw() {
    this.#frame ??= requestAnimationFrame(() => {
      this.#frame = null;
      this.#frames += 1;
      const few = crowded(this.database) && this.#frames % 4 > 0;
      for (const view of few ? this.views.slice(0, 1) : this.views) view.draw();
    });
    clearTimeout(this.#settling);
    this.#settling = setTimeout(() => this.#settle(), 160);
  }

  /** @type {number | null} */
  #frame = null;
  #frames = 0;
  /** @type {number | undefined} */
  #settling;

  /**
   * One map after the other, each in a frame of its own, so that no frame takes long; a crowd when its brush is let go,
   * which may rest for long before.
   */
  #settle() {
    if (this.state.get("brushing") && crowded(this.database)) return;
    const views = [...this.views];
    const next = () => {
      views.shift()?.settle();
      if (views.length > 0) this.#settling = setTimeout(next, 0);
    };
    next();
  }

  /** @param {number} index */
  visible(index) {
    return this.emphasis[index] > HIDDEN;
  }

  /** @type {AbortController | null} */
  #voyage = null;

  /**
   * Move all points to another projection, on a straight way; the camera goes back to showing all of it, unless it is to
   * be somewhere there.
   * @param {number} target
   * @param {boolean} aimed
   */
  #travel(target, aimed) {
    this.origin = this.target;
    this.target = target;
    const from = this.bounds;
    const to = this.database.bounds[target];
    const camera = aimed ? null : this.state.get(this.cameraName) && this.camera();
    this.#voyage?.abort();
    this.#voyage = new AbortController();
    animate(DURATION, this.#voyage.signal, (linear) => {
      this.#place(eased(linear));
      /**
       * @param {number} a
       * @param {number} b
       */
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
        this.state.set({ [this.cameraName]: linear < 1 ? view : null });
      }
      this.draw();
      if (linear === 1) this.#settle();
    });
  }

  /** @param {number} progress */
  #place(progress) {
    this.progress = progress;
    const [from, to] = [this.database.methods[this.origin], this.database.methods[this.target]];
    for (let index = 0; index < this.x.length; index += 1) {
      this.x[index] = from.x[index] + progress * (to.x[index] - from.x[index]);
      this.y[index] = from.y[index] + progress * (to.y[index] - from.y[index]);
    }
  }

  /** How present each shape is; a new array, because charts compare by identity. */
  weigh() {
    const hidden = this.state.get("hidden");
    const selection = this.state.get("selection");
    const matches = this.state.get("matches");
    const line = this.state.get("pointedShapes");
    const pointedShapes = line && new Set(line);
    const pointed = hidden.has(this.state.get("pointedGroup")) ? null : this.state.get("pointedGroup");
    const { groups, count } = this.database;
    const emphasis = new Uint8Array(count);
    const chosen = pointedShapes ?? (pointed === null && selection.size > 0 ? selection : matches);
    if (pointedShapes === null && pointed !== null)
      for (let index = 0; index < count; index += 1) emphasis[index] = groups[index] === pointed ? CHOSEN : FAINT;
    else {
      emphasis.fill(chosen ? FAINT : NORMAL);
      for (const index of chosen ?? []) emphasis[index] = CHOSEN;
    }
    this.present = 0;
    for (let index = 0; index < count; index += 1) {
      const placed = !Number.isNaN(this.x[index]);
      if (placed) this.present += 1;
      if (!placed || (hidden.size > 0 && hidden.has(groups[index]))) emphasis[index] = HIDDEN;
    }
    this.emphasis = emphasis;
  }

  /** @returns {Camera} */
  camera() {
    const camera = this.state.get(this.cameraName);
    return camera === null ? { x: this.bounds.x, y: this.bounds.y, zoom: 1 } : this.#bounded(camera);
  }

  /**
   * Look at another part of the plane; kept so that some of the map always stays in view.
   * @param {Camera} camera
   */
  look(camera) {
    const bounded = this.#bounded(camera);
    this.state.set({ [this.cameraName]: bounded.zoom <= 1.001 ? null : bounded });
  }

  /**
   * The address may hold any numbers.
   * @param {Camera} camera
   */
  #bounded(camera) {
    const zoom = Math.min(Math.max(camera.zoom, 1), LARGEST_ZOOM);
    /**
     * @param {number} value
     * @param {number} centre
     * @param {number} size
     */
    const within = (value, centre, size) => Math.min(Math.max(value, centre - size / 2), centre + size / 2);
    const { x, y, width, height } = this.bounds;
    return { x: within(camera.x, x, width), y: within(camera.y, y, height), zoom };
  }
}

/**
 * Call `step` with every frame, with the share of time gone, the last time with 1; once only for who wants calm.
 * @param {number} duration
 * @param {AbortSignal} signal
 * @param {(share: number) => void} step
 */
export function animate(duration, signal, step) {
  const started = performance.now();
  const frame = () => {
    if (signal.aborted) return;
    const share = calm() || duration === 0 ? 1 : Math.min(1, (performance.now() - started) / duration);
    step(share);
    if (share < 1) requestAnimationFrame(frame);
  };
  frame();
}

/** @param {number} t */
function eased(t) {
  return t < 0.5 ? 4 * t ** 3 : 1 - (2 - 2 * t) ** 3 / 2;
}
