// One of the linked maps: a chart, and above it names, rings and the brush.

import { drawChart } from "../base/chart.js";
import { element, svg } from "../base/dom.js";
import { entry } from "../base/entry.js";
import { Dots } from "./dots.js";
import { Labels } from "./labels.js";
import { CHOSEN, crowded } from "./scene.js";

/** @import { Scene } from "./scene.js" */

/** @typedef {"class" | "hit" | "thumbnail"} MapName what its marks tell */

export class MapView {
  width = 0;
  height = 0;

  /**
   * @param {Scene} scene
   * @param {Found} figure
   */
  constructor(scene, figure) {
    this.scene = scene;
    this.database = scene.database;
    this.state = scene.state;
    this.figure = figure;
    this.name = /** @type {MapName} */ (figure.dataset.view);
    this.surface = figure.querySelector(".surface");
    this.node = element("div", { class: "chart", "aria-hidden": "true" });
    this.overlay = svg("svg", { class: "overlay", "aria-hidden": "true" });
    this.labels = new Labels(this.database, this.overlay);
    this.ties = this.overlay.insertBefore(svg("path", { class: "ties" }), this.overlay.firstChild);
    this.opened = this.overlay.appendChild(svg("circle", { class: "ring opened" }));
    this.pointed = this.overlay.appendChild(svg("circle", { class: "ring pointed" }));
    this.brush = this.overlay.appendChild(svg("rect", { class: "brush" }));
    this.surface.append(this.node, this.overlay);
    /** @type {boolean[]} */
    this.pictured = [];
    /** @type {Map<string, any>} */
    this.sent = new Map();
    this.started = false;
    /** @type {Dots | null} */
    this.dots = null;
    /** @type {number[] | null} */
    this.order = null;
    /** @type {any} Vega's view, where a chart draws the map */
    this.vega = null;
    this.running = false;
    this.stale = false;
    this.measure();
  }

  get large() {
    return this.figure.dataset.slot === "large";
  }

  /** Draw the map with the colours of the theme in use; called again when the theme changes. */
  async start() {
    if (!crowded(this.database)) await this.#startChart();
    this.started = true;
    performance.mark(`drawn: ${this.name}`);
    this.settle();
  }

  async #startChart() {
    this.vega?.finalize();
    this.vega = null;
    this.sent.clear();
    const spec = this.database.data.charts[this.name];
    // Browsers scale SVG pictures down better than canvas does, and many dots are quicker on canvas.
    const renderer = this.name === "thumbnail" ? "svg" : "canvas";
    const vega = await drawChart(this.node, spec, this.database.marks.config, renderer);
    this.vega = vega;
    this.#choosePictures();
    this.#send();
    await vega.runAsync();
  }

  measure() {
    this.width = Math.max(this.surface.clientWidth, 10);
    this.height = Math.max(this.surface.clientHeight, 10);
    this.overlay.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
  }

  /** The size of the surface changed. */
  resize() {
    this.measure();
    this.settle();
  }

  // Plane and screen

  /** Height of the part that nothing covers. */
  get clearHeight() {
    return this.height - (this.large ? this.scene.covered : 0);
  }

  get scale() {
    const { width, height } = this.scene.bounds;
    const margin = Math.max(this.large ? 36 : 12, this.name === "thumbnail" ? this.#wholeSize / 2 : 0);
    /** @param {number} size */
    const room = (size) => Math.max(size - 2 * margin, 8);
    return Math.min(room(this.width) / width, room(this.clearHeight) / height) * this.scene.camera().zoom;
  }

  /** How the plane lies on the screen at this moment, for who wants the places of many shapes. */
  lay() {
    const camera = this.scene.camera();
    const scale = this.scale;
    return { scale, left: this.width / 2 - camera.x * scale, top: this.clearHeight / 2 + camera.y * scale };
  }

  /** @param {number} index */
  screen(index) {
    return this.toScreen(this.scene.x[index], this.scene.y[index]);
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  toScreen(x, y) {
    const { scale, left, top } = this.lay();
    return [left + x * scale, top - y * scale];
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  toPlane(x, y) {
    const camera = this.scene.camera();
    const scale = this.scale;
    return [camera.x + (x - this.width / 2) / scale, camera.y - (y - this.clearHeight / 2) / scale];
  }

  get markSize() {
    const many = Math.min(Math.max(42000 / this.scene.present, 26), 150);
    const size = this.large ? many * Math.min(Math.max(this.width / 800, 0.5), 1) : Math.max(many * 0.22, 9);
    return size * Math.min(this.scene.camera().zoom, 4) ** 0.5;
  }

  get markRadius() {
    return Math.sqrt(this.markSize) / 2;
  }

  get pictureSize() {
    return Math.min(this.#wholeSize * this.scene.camera().zoom ** 0.5, 180);
  }

  /** Size of a picture when the whole map is shown. */
  get #wholeSize() {
    const room = Math.sqrt((this.width * this.height * 0.7) / this.database.count);
    return Math.min(Math.max(room, this.large ? Math.min(44, this.width / 11) : 15), this.large ? 110 : 40);
  }

  /**
   * The visible shape at a place on the screen, or null.
   * @param {number} x
   * @param {number} y
   * @param {number} reach
   */
  at(x, y, reach) {
    const { scale, left, top } = this.lay();
    const [pictureReach, markReach] = [this.pictureSize / 2, this.markRadius + reach];
    /** @type {[number | null, number]} */
    let [best, least] = [null, Infinity];
    for (let index = 0; index < this.database.count; index += 1) {
      if (!this.scene.visible(index)) continue;
      const distance = Math.hypot(left + this.scene.x[index] * scale - x, top - this.scene.y[index] * scale - y);
      if (distance <= (this.pictured[index] ? pictureReach : markReach) && distance < least)
        [best, least] = [index, distance];
    }
    return best;
  }

  /**
   * Visible shapes in a rectangle of the screen.
   * @param {number} west
   * @param {number} north
   * @param {number} east
   * @param {number} south
   */
  inside(west, north, east, south) {
    const { scale, left, top } = this.lay();
    /** @type {number[]} */
    const found = [];
    for (let index = 0; index < this.database.count; index += 1) {
      if (!this.scene.visible(index)) continue;
      const [x, y] = [left + this.scene.x[index] * scale, top - this.scene.y[index] * scale];
      if (x >= west && x <= east && y >= north && y <= south) found.push(index);
    }
    return found;
  }

  // Drawing

  draw() {
    this.drawRings();
    this.labels.follow((index) => this.screen(index));
    if (!this.started) return;
    if (this.scene.moving || crowded(this.database)) this.#drawDots();
    else if (this.vega) {
      this.#send();
      this.#run();
    }
  }

  #drawDots() {
    this.dots ??= new Dots(this);
    this.dots.draw();
  }

  /** After the last of a series of changes: what would be too slow or too restless for every frame. */
  settle() {
    if (!this.started || this.scene.moving) return;
    this.#choosePictures();
    if (crowded(this.database)) this.#drawDots();
    else if (this.vega) {
      this.#send();
      this.#run();
    }
    this.drawRings();
    if (this.large) this.#name();
    else this.labels.clear();
  }

  async #run() {
    if (this.running) {
      this.stale = true;
      return;
    }
    this.running = true;
    const vega = this.vega;
    await vega.runAsync();
    this.running = false;
    if (!this.scene.moving) this.dots?.clear();
    if (this.stale && vega === this.vega) {
      this.stale = false;
      this.#run();
    }
  }

  /** Tell the chart what changed since it was told last. */
  #send() {
    const { scene, vega } = this;
    if (this.sent.get("width") !== this.width || this.sent.get("height") !== this.height) {
      vega.width(this.width).height(this.height);
      this.sent.set("width", this.width).set("height", this.height);
    }
    if (this.sent.get("revision") !== this.database.revision) {
      vega.data("shapes", this.database.rows());
      this.sent.set("revision", this.database.revision);
    }
    const [left, bottom] = this.toPlane(0, this.height);
    const [right, top] = this.toPlane(this.width, 0);
    const values = {
      x_domain: [left, right],
      y_domain: [bottom, top],
      origin: scene.origin,
      target: scene.target,
      progress: scene.progress,
      emphasis: scene.emphasis,
      mark_size: this.markSize,
      unlabelled: this.database.marks.unlabelled,
      outline: this.database.marks.outline,
    };
    if (this.name === "thumbnail") Object.assign(values, { pictured: this.pictured, picture_size: this.pictureSize });
    for (const [name, value] of Object.entries(values)) {
      const before = this.sent.get(name);
      if (before === value || (name.endsWith("_domain") && before?.[0] === value[0] && before[1] === value[1]))
        continue;
      vega.signal(name, value);
      this.sent.set(name, value);
    }
  }

  /** What is pointed at and what is open. */
  drawRings() {
    this.#drawTies();
    /** @param {number} index */
    const radius = (index) => (this.pictured[index] ? this.pictureSize / 2 + 2 : this.markRadius + 4);
    for (const [ring, index] of [
      [this.opened, this.state.get("opened")],
      [this.pointed, this.state.get("pointed")],
    ]) {
      const shown = index !== null && this.scene.visible(index);
      ring.classList.toggle("shown", shown);
      if (!shown) continue;
      const [x, y] = this.screen(index);
      ring.setAttribute("cx", x);
      ring.setAttribute("cy", y);
      ring.setAttribute("r", radius(index));
    }
  }

  /** Lines from the opened shape to the neighbours that its NH counts. */
  #drawTies() {
    const index = this.state.get("opened");
    const shown = this.large && index !== null && this.scene.visible(index);
    this.ties.classList.toggle("shown", shown);
    if (!shown) return;
    const from = this.screen(index);
    const near = this.database.neighbours(index, this.scene.target).filter((other) => this.scene.visible(other));
    this.ties.setAttribute("d", near.map((other) => `M${from}L${this.screen(other)}`).join(""));
  }

  /** Which shapes are drawn as pictures: as many as lie apart, chosen ones first; the rest are dots. */
  #choosePictures() {
    if (this.name !== "thumbnail") return;
    const { emphasis } = this.scene;
    const apart = this.pictureSize * (this.database.count > MOST_PICTURES ? 0.8 : 0.5);
    /** @type {Map<number, [number, number][]>} */
    const taken = new Map();
    /**
     * @param {number} column
     * @param {number} row
     */
    const cell = (column, row) => row * 100000 + column;
    /**
     * @param {number} x
     * @param {number} y
     */
    const free = (x, y) => {
      const [column, row] = [Math.floor(x / apart), Math.floor(y / apart)];
      for (let i = -1; i <= 1; i += 1) {
        for (let j = -1; j <= 1; j += 1) {
          for (const [px, py] of taken.get(cell(column + i, row + j)) ?? []) {
            if (Math.max(Math.abs(px - x), Math.abs(py - y)) < apart) return false;
          }
        }
      }
      entry(taken, cell(column, row), () => []).push([x, y]);
      return true;
    };
    const half = this.pictureSize / 2;
    const { scale, left, top } = this.lay();
    const pictured = new Array(this.database.count).fill(false);
    let room = MOST_PICTURES;
    for (const chosen of [true, false]) {
      for (const index of this.#scattered()) {
        if (room === 0) break;
        if (!this.scene.visible(index) || (emphasis[index] === CHOSEN) !== chosen) continue;
        const [x, y] = [left + this.scene.x[index] * scale, top - this.scene.y[index] * scale];
        if (x < -half || y < -half || x > this.width + half || y > this.height + half || !free(x, y)) continue;
        pictured[index] = true;
        room -= 1;
      }
    }
    if (pictured.some((value, index) => value !== this.pictured[index])) this.pictured = pictured;
  }

  /** All shapes in an order that favours no class and is always the same, so that pictures stay when others come. */
  #scattered() {
    this.order ??= this.database.ids.map((_, index) => index).sort((a, b) => scatter(a) - scatter(b) || a - b);
    return this.order;
  }

  #name() {
    const { scale, left, top } = this.lay();
    const points = [];
    for (let index = 0; index < this.database.count; index += 1) {
      if (!this.scene.visible(index)) continue;
      const [x, y] = [left + this.scene.x[index] * scale, top - this.scene.y[index] * scale];
      if (x < 0 || y < 0 || x > this.width || y > this.clearHeight) continue;
      points.push({ index, group: this.database.groups[index], x, y });
    }
    this.labels.place(
      points,
      this.width,
      this.clearHeight,
      this.name === "thumbnail" ? this.pictureSize / 2 : this.markRadius,
    );
    this.labels.follow((index) => this.screen(index));
  }
}

/** More pictures than this make a map slow, and none of them readable. */
const MOST_PICTURES = 500;

/** @param {number} index */
function scatter(index) {
  return Math.imul(index + 1, 0x9e3779b1) >>> 0;
}
