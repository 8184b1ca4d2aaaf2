// A scene whose map is made while one looks: shapes glide towards wherever the layout has them so far, from wherever
// they are, so that neither a new step of the layout nor a new layout makes anything jump.

import { calm } from "../base/dom.js";
import { bounds } from "../database/database.js";
import { Scene } from "./scene.js";

/** @import { Bounds, ShapeMap } from "../database/database.js" */

/**
 * Where shapes are going: two numbers a shape, no numbers for one that is not on the map.
 * @typedef {{ x: ArrayLike<number>, y: ArrayLike<number> }} Places
 */

/** In this many milliseconds a shape goes two thirds of its way. */
const PACE = 70;

/** Share of the map's size that is no movement any more. */
const STILL = 0.001;

export class LiveScene extends Scene {
  /** Whether shapes are on their way; views then draw moving marks and leave the chart alone. */
  moving = false;

  /** @type {(Places & { bounds: Bounds }) | null} */
  #goal = null;
  /** @type {ShapeMap | null} the finished map, once there is one */
  #last = null;
  /** @type {number | null} */
  #frame = null;
  #time = 0;

  /**
   * Where a layout in progress has the shapes.
   * @param {ArrayLike<number>} x
   * @param {ArrayLike<number>} y
   */
  stream(x, y) {
    if (!calm()) this.#glide({ x, y }, null);
  }

  /**
   * The finished map, as the database has maps.
   * @param {ShapeMap} map
   */
  show(map) {
    const there = !this.moving && map.x === this.database.methods[this.target].x;
    if (there || calm()) this.#arrive(map);
    else this.#glide(map, map);
  }

  /** A layout was given up: go back to the map that is shown. */
  rest() {
    if (this.moving) this.show(this.database.methods[this.target]);
  }

  /**
   * @param {Places} goal
   * @param {ShapeMap | null} last
   */
  #glide(goal, last) {
    if (this.#goal === null) this.state.set({ [this.cameraName]: null });
    this.#goal = { ...goal, bounds: bounds(goal) };
    this.#last = last;
    for (let index = 0; index < this.x.length; index += 1) {
      // A shape that comes to the map starts where it belongs; one that leaves is gone.
      if (Number.isNaN(this.x[index]) !== Number.isNaN(goal.x[index]))
        [this.x[index], this.y[index]] = [goal.x[index], goal.y[index]];
    }
    this.weigh();
    if (this.#frame !== null) return;
    this.moving = true;
    for (const view of this.views) view.labels.clear();
    this.#time = performance.now();
    this.#frame = requestAnimationFrame(() => this.#step());
  }

  #step() {
    const now = performance.now();
    const share = 1 - Math.exp(-Math.max(now - this.#time, 1) / PACE);
    this.#time = now;
    const goal = /** @type {Places & { bounds: Bounds }} */ (this.#goal);
    let farthest = 0;
    for (let index = 0; index < this.x.length; index += 1) {
      const dx = goal.x[index] - this.x[index];
      const dy = goal.y[index] - this.y[index];
      this.x[index] += share * dx;
      this.y[index] += share * dy;
      farthest = Math.max(farthest, Math.abs(dx) || 0, Math.abs(dy) || 0);
    }
    /** @param {keyof Bounds} name */
    const mix = (name) => this.bounds[name] + share * (goal.bounds[name] - this.bounds[name]);
    this.bounds = { x: mix("x"), y: mix("y"), width: mix("width"), height: mix("height") };
    if (this.#last && farthest < STILL * Math.max(goal.bounds.width, goal.bounds.height)) {
      this.#arrive(this.#last);
      return;
    }
    for (const view of this.views) view.draw();
    this.#frame = requestAnimationFrame(() => this.#step());
  }

  /** @param {ShapeMap} map */
  #arrive(map) {
    if (this.#frame !== null) cancelAnimationFrame(this.#frame);
    this.#frame = null;
    this.#goal = null;
    this.moving = false;
    this.database.replace(map);
    this.x = Float64Array.from(map.x);
    this.y = Float64Array.from(map.y);
    this.bounds = this.database.bounds[this.target];
    this.weigh();
    for (const view of this.views) view.settle();
  }
}
