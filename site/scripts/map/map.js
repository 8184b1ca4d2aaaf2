// One of the linked maps: marks that a chart draws, or that are drawn here, and above them names, rings and the brush.

import { drawChart } from "../base/chart.js";
import { element, svg } from "../base/dom.js";
import { drawnAs, toldAs } from "../base/snapshot.js";
import { entry } from "../base/entry.js";
import { currentTheme } from "../base/theme.js";
import { heartOf, largestCluster, Thinning } from "./clusters.js";
import { classColoring, classNaming, hitColoring, placedGroups } from "./coloring.js";
import { Dots } from "./dots.js";
import { mapFigure, mapWords } from "./figure.js";
import { Labels } from "./labels.js";
import { partedNeighbours } from "./lines.js";
import { animate, CHOSEN, crowded, HIDDEN } from "./scene.js";
import { spread, thinned } from "./spread.js";

/** @import { Theme } from "../base/theme.js" */
/** @import { Bounds } from "../database/database.js" */
/** @import { Mark } from "./clusters.js" */
/** @import { Coloring, Naming } from "./coloring.js" */
/** @import { Parted } from "./lines.js" */
/** @import { Camera, Scene } from "./scene.js" */

/** @typedef {"class" | "hit" | "thumbnail" | "color"} MapName what its marks tell; `color` what its reader chose */

/** How long pictures take to go to their new places, in milliseconds. */
const GLIDE = 240;
/** Pictures and the rings about them, which do not touch each other. */
const RIM = 3;
/** The share of a map that pictures fill when it is shown whole, the smallest that one makes out, and the largest. */
const FILLED = 0.4;
const SMALLEST = 36;
const LARGEST = 110;
/** Pictures of so many shapes make way for dots within a frame or a few. */
const MAKING_WAY = 800;
/** Radius of a mark, about, on a map that is shown whole. */
const DOT = 4;
/** Where shapes lie in tight clumps pictures are smaller, so that this share of the shapes have one; down to this size, if half do. */
const MOST = 0.75;
const HALF = 0.5;
const TIGHTEST = 28;
/** The largest beside other maps, whose margins hold half of it: shapes are then at the same places on all. */
const LARGEST_BESIDE = 60;
/** The largest when zoomed in. */
const CLOSEST = 200;
/** The largest of those on sheets, which are small. */
const CLOSEST_ON_SHEETS = 96;
/** Where pictures stand at their exact places, they may cover each other by half. */
const EXACT_APART = 0.5;
/** So far from its edges a map shows what was out of view. */
const INWARD = 0.2;
/** So many pixels of a map hold a mark of each class at the most for what is found out about many. */
const THINNED = 5;
/** Of a crowd only so many groups are named, those that take most of the map in view: others come as one zooms in. */
const MOST_NAMED = 80;
/** On a smaller map there is no room for names. */
const NAMED_WIDTH = 280;

export class MapView {
  width = 0;
  height = 0;

  /**
   * @param {Scene} scene
   * @param {Found} figure
   * @param {object} [how]
   * @param {boolean} [how.charted] whether a chart draws the marks at rest; a map that is seen first waits for none
   * @param {() => void} [how.settled] called as often as pictures were chosen
   * @param {() => boolean} [how.covered] whether something else stands over it, so that nobody would read its names
   */
  constructor(scene, figure, { charted = true, settled = () => {}, covered = () => false } = {}) {
    this.scene = scene;
    this.database = scene.database;
    this.state = scene.state;
    this.figure = figure;
    this.charted = charted;
    this.settled = settled;
    this.covered = covered;
    this.name = /** @type {MapName} */ (figure.dataset.view);
    /** @type {Coloring | null} what its reader colours the map by, if not by classes */
    this.chosenColoring = null;
    this.surface = figure.querySelector(".surface");
    this.node = element("div", { class: "chart", "aria-hidden": "true" });
    this.overlay = svg("svg", { class: "overlay", "aria-hidden": "true" });
    this.labels = new Labels(classNaming(this.database), this.overlay);
    /** @type {Record<"near" | keyof Parted, SVGPathElement>} */
    this.ties = { near: tie("near"), false: tie("false"), missing: tie("missing"), kept: tie("kept") };
    this.overlay.prepend(...Object.values(this.ties));
    this.opened = this.overlay.appendChild(svg("circle", { class: "ring opened" }));
    this.pointed = this.overlay.appendChild(svg("circle", { class: "ring pointed" }));
    this.brush = this.overlay.appendChild(svg("path", { class: "brush" }));
    this.surface.append(this.node, this.overlay);
    drawnAs(this.surface, (picture) => mapFigure(this, picture));
    toldAs(figure, () => mapWords(this));
    // Of a map without pictures; of a crowd, megabytes, were they made each time.
    const nowhere = new Float64Array(this.database.count);
    this.#none = { pictured: new Uint8Array(this.database.count), shift: { x: nowhere, y: nowhere } };
    /** @type {ArrayLike<number>} 1 for a shape that is drawn as a picture */
    this.pictured = [];
    // How far each picture stands from its place, in sizes of a picture.
    /** @type {{ x: Float64Array, y: Float64Array }} */
    this.shift = this.#none.shift;
    /** @type {Map<string, any>} */
    this.sent = new Map();
    this.started = false;
    /** @type {Theme | null} in whose colours it was drawn last */
    this.theme = null;
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

  #none;

  /** Whether a chart draws the marks when they are at rest. */
  get #onChart() {
    return this.charted && this.name !== "color" && !crowded(this.database);
  }

  /**
   * What the colours of marks say.
   * @returns {Coloring}
   */
  get coloring() {
    if (this.name === "hit") return hitColoring(this.database, this.database.methods[this.scene.target]);
    const { chosenColoring: chosen } = this;
    if (chosen !== null) return chosen.of?.(this.database.methods[this.scene.target]) ?? chosen;
    return classColoring(this.database);
  }

  /**
   * Let colours say what a page asks for: `class`, `hit`, or what its reader chose.
   * @param {string} color
   * @param {Coloring | null} chosen
   */
  colorBy(color, chosen) {
    this.name = /** @type {MapName} */ (chosen === null ? color : "color");
    this.chosenColoring = chosen;
    this.figure.dataset.view = this.name;
  }

  /** Draw the map with the colours of the theme in use; called again when the theme changes. */
  async start() {
    this.theme = currentTheme();
    if (crowded(this.database)) await this.database.fetchSheets();
    if (this.#onChart) await this.#startChart();
    this.started = true;
    this.settle();
    performance.mark(`drawn: ${this.name}`);
  }

  async #startChart() {
    this.vega?.finalize();
    this.vega = null;
    const { name } = this;
    const spec = this.database.data.charts[/** @type {"class" | "hit" | "thumbnail"} */ (name)];
    // Browsers scale SVG pictures down better than canvas does, and many dots are quicker on canvas.
    const renderer = name === "thumbnail" ? "svg" : "canvas";
    const vega = await drawChart(this.node, spec, this.database.marks.config, renderer);
    // Meanwhile the map may have been drawn once more, or be asked to tell something else.
    this.vega?.finalize();
    this.vega = null;
    if (this.name !== name) return;
    this.vega = vega;
    this.sent.clear();
    this.#choosePictures();
    this.#send();
    await vega.runAsync();
  }

  measure() {
    this.width = Math.max(this.surface.clientWidth, 10);
    this.height = Math.max(this.surface.clientHeight, 10);
    this.overlay.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
  }

  /** The size of the surface may have changed. */
  resize() {
    const { width, height } = this;
    this.measure();
    if (width !== this.width || height !== this.height) this.settle();
  }

  // Plane and screen

  get scale() {
    return this.#scaleOf(this.scene.bounds, this.#wholeSize) * this.scene.camera().zoom;
  }

  /**
   * Pixels for a unit of a plane that is shown whole.
   * @param {Bounds} bounds
   * @param {number} size of a picture
   */
  #scaleOf({ width, height }, size) {
    const margin = Math.max(Math.min(this.width / 14, 36), this.name === "thumbnail" ? size / 2 + RIM : 0);
    /** @param {number} length */
    const room = (length) => Math.max(length - 2 * margin, 8);
    return Math.min(room(this.width) / width, room(this.height) / height);
  }

  /** How the plane lies on the screen at this moment. */
  lay() {
    const camera = this.scene.camera();
    const scale = this.scale;
    return { scale, left: this.width / 2 - camera.x * scale, top: this.height / 2 + camera.y * scale };
  }

  /**
   * Where shapes are drawn on the screen, for who wants the places of many.
   * @returns {(index: number) => number[]}
   */
  placing() {
    const { scale, left, top } = this.lay();
    const { x, y } = this.scene;
    const size = this.name === "thumbnail" ? this.pictureSize : 0;
    return (index) => [
      left + x[index] * scale + this.shift.x[index] * size,
      top - y[index] * scale + this.shift.y[index] * size,
    ];
  }

  /**
   * Tell of every visible shape where it is drawn on the screen.
   * @param {(index: number, x: number, y: number) => void} tell
   */
  each(tell) {
    const { scale, left, top } = this.lay();
    const { x, y, emphasis } = this.scene;
    const { shift } = this;
    const size = this.name === "thumbnail" ? this.pictureSize : 0;
    for (let index = 0; index < x.length; index += 1)
      if (emphasis[index] > HIDDEN)
        tell(index, left + x[index] * scale + shift.x[index] * size, top - y[index] * scale + shift.y[index] * size);
  }

  /** @param {number} index */
  screen(index) {
    return this.placing()(index);
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  toPlane(x, y) {
    const camera = this.scene.camera();
    const scale = this.scale;
    return [camera.x + (x - this.width / 2) / scale, camera.y - (y - this.height / 2) / scale];
  }

  /**
   * The place in the plane that one of the screen stands for: that of the shape whose picture is there, which may stand
   * beside it, and would else be pushed away by who zooms in on it.
   * @param {number} x
   * @param {number} y
   */
  meant(x, y) {
    const index = this.at(x, y, 0);
    return index !== null && this.pictured[index] ? [this.scene.x[index], this.scene.y[index]] : this.toPlane(x, y);
  }

  get markSize() {
    const { present } = this.scene;
    // Of ten thousand marks one still tells the symbols; more are as small as their number asks for, until one zooms in.
    const many = Math.min(Math.max(42000 / present, Math.min(26, 2600 / Math.sqrt(present))), 150);
    const largest = Math.max(2 * many, 52);
    const zoomed = Math.min(many * Math.sqrt(this.scene.camera().zoom), largest);
    return zoomed * Math.min(Math.max(this.width / 800, 0.5), 1);
  }

  get markRadius() {
    return Math.sqrt(this.markSize) / 2;
  }

  get pictureSize() {
    const closest = this.database.sheets ? CLOSEST_ON_SHEETS : CLOSEST;
    return Math.min(this.#wholeSize * this.scene.camera().zoom ** 0.6, Math.max(closest, this.#wholeSize));
  }

  /** Size of a picture when the whole map is shown; from one map to another it changes as shapes go their way. */
  get #wholeSize() {
    const { origin, target, progress } = this.scene;
    const size = this.#sizeOn(target);
    return progress === 1 ? size : size + (1 - progress) * (this.#sizeOn(origin) - size);
  }

  /** @param {number} method */
  #sizeOn(method) {
    const room = Math.sqrt((this.width * this.height * FILLED) / this.database.count);
    const roomy = Math.min(
      Math.max(room, Math.min(SMALLEST, this.width / 13)),
      this.charted ? LARGEST_BESIDE : LARGEST,
    );
    if (this.name !== "thumbnail" || this.charted || crowded(this.database)) return roomy;
    return entry(this.#sizes, [method, this.database.revision, this.width, this.height].join(" "), () => {
      const tightest = Math.min(TIGHTEST, roomy);
      if (this.#shareWith(tightest, method) < HALF) return roomy;
      let size = roomy;
      while (size > tightest && this.#shareWith(size, method) < MOST) size = Math.max(0.9 * size, tightest);
      return size;
    });
  }

  /** @type {Map<string, number>} */
  #sizes = new Map();

  /**
   * The share of all shapes that have a picture where pictures are of a size on a map that is shown whole.
   * @param {number} size
   * @param {number} method
   */
  #shareWith(size, method) {
    const { x, y } = this.database.methods[method];
    const bounds = this.database.bounds[method];
    const scale = this.#scaleOf(bounds, size);
    const { pictured } = spread(
      this.#scattered().map((index) => x[index] * scale),
      this.#scattered().map((index) => -y[index] * scale),
      size + RIM,
      { frame: this.#frameOf(bounds, scale, 1) },
    );
    return pictured.reduce((sum, value) => sum + value, 0) / pictured.length;
  }

  /**
   * The whole map in pixels from the origin of its plane.
   * @param {Bounds} bounds
   * @param {number} scale
   * @param {number} zoom
   */
  #frameOf({ x, y }, scale, zoom) {
    const [halfWidth, halfHeight] = [(this.width * zoom) / 2, (this.height * zoom) / 2];
    return {
      left: x * scale - halfWidth,
      right: x * scale + halfWidth,
      top: -y * scale - halfHeight,
      bottom: -y * scale + halfHeight,
    };
  }

  /**
   * The visible shape at a place on the screen, or null.
   * @param {number} x
   * @param {number} y
   * @param {number} reach
   */
  at(x, y, reach) {
    const [pictureReach, markReach] = [this.pictureSize / 2, this.markRadius + reach].map((far) => far ** 2);
    const { pictured } = this;
    let best = -1;
    let least = Infinity;
    this.each((index, left, top) => {
      const distance = (left - x) ** 2 + (top - y) ** 2;
      if (distance > (pictured[index] ? pictureReach : markReach) || distance >= least) return;
      best = index;
      least = distance;
    });
    return best < 0 ? null : best;
  }

  /**
   * Visible shapes whose place on the screen an area holds.
   * @param {(x: number, y: number) => boolean} holds
   */
  inside(holds) {
    /** @type {number[]} */
    const found = [];
    this.each((index, x, y) => {
      if (holds(x, y)) found.push(index);
    });
    return found;
  }

  // Drawing

  draw() {
    this.drawRings();
    this.labels.follow(this.placing());
    if (this.started) this.#drawMarks();
  }

  #drawMarks() {
    if (this.scene.moving || !this.#onChart) {
      this.dots ??= new Dots(this);
      this.dots.draw();
    } else if (this.vega) {
      this.#send();
      this.#run();
    }
  }

  /** After the last of a series of changes: what would be too slow or too restless for every frame. */
  settle() {
    if (!this.started || this.scene.moving) return;
    this.#choosePictures();
    this.#keepInView();
    this.#drawMarks();
    this.drawRings();
    if (this.width >= NAMED_WIDTH && !this.covered()) this.#name();
    else this.labels.clear();
    this.settled();
  }

  /** How many shapes in view have no picture; none before pictures were chosen. */
  get dotted() {
    if (!this.started) return 0;
    const { width, height, pictured } = this;
    let dots = 0;
    this.each((index, x, y) => {
      if (x >= 0 && y >= 0 && x <= width && y <= height && !pictured[index]) dots += 1;
    });
    return dots;
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
      ground: this.database.marks.ground,
    };
    if (this.name === "thumbnail") {
      const size = this.pictureSize;
      Object.assign(values, {
        pictured: this.pictured,
        picture_size: size,
        shift_x: this.shift.x,
        shift_y: this.shift.y,
        shift_size: size / this.scale,
      });
    }
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

  /**
   * Lines from the shape that is pointed at, else from the opened one, to those most alike; else from this one to the
   * neighbours that its NH counts.
   */
  #drawTies() {
    const { scene, state, ties } = this;
    const [pointed, opened] = [state.get("pointed"), state.get("opened")];
    const index = pointed ?? opened;
    const shown = index !== null && scene.visible(index) && !scene.moving;
    const parted = shown && state.get("lines") ? partedNeighbours(this, index) : null;
    const near = shown && parted === null && pointed === null ? this.database.neighbours(index, scene.target) : [];
    const lines = { near, kept: [], missing: [], false: [], ...parted };
    const placeOf = this.placing();
    for (const [name, path] of Object.entries(ties)) {
      const others = lines[/** @type {keyof typeof lines} */ (name)].filter((other) => scene.visible(other));
      path.classList.toggle("shown", others.length > 0);
      if (others.length > 0)
        path.setAttribute(
          "d",
          others.map((other) => `M${placeOf(/** @type {number} */ (index))}L${placeOf(other)}`).join(""),
        );
    }
  }

  /** Which shapes are drawn as pictures, and where. */
  #choosePictures() {
    const { pictured, shift } = this.name === "thumbnail" ? this.#findPictures() : this.#none;
    this.pictured = pictured;
    this.#glide(shift);
  }

  /** Pictures beside each other, or at their places where the reader asks for it. */
  #findPictures() {
    const { count } = this.database;
    const pictured = new Uint8Array(count);
    const shift = { x: new Float64Array(count), y: new Float64Array(count) };
    const { x, y } = this.scene;
    const { zoom, ...camera } = this.scene.camera();
    const [scale, size] = [this.scale, this.pictureSize + RIM];
    // Beyond what is in view, too: a map that is moved a little shows the same pictures.
    const [wide, high] = [this.width, this.height].map((room) => room / scale);
    /** @param {number} index */
    const near = (index) =>
      this.scene.visible(index) && Math.abs(x[index] - camera.x) < wide && Math.abs(y[index] - camera.y) < high;
    const grid = this.database.sheets?.grid(size / 2 / scale);
    // Every group has a picture before any has two.
    const middles = this.#middles();
    const first = [...middles].filter(near);
    const rows = [...first, ...this.#drawable(grid).filter((index) => near(index) && !middles.has(index))];
    const places = [rows.map((index) => x[index] * scale), rows.map((index) => -y[index] * scale)];
    const naming = this.#naming;
    // Beside another map a shape is where it is on that one.
    const found =
      this.charted || this.state.get("exact")
        ? thinned(places[0], places[1], size, EXACT_APART)
        : spread(places[0], places[1], size, {
            frame: this.#frameOf(this.scene.bounds, scale / zoom, zoom),
            first: first.length,
            groups: rows.length > MAKING_WAY ? null : rows.map((index) => naming.groupOf(index)),
            dot: this.markRadius,
            crowd: grid === 0,
          });
    for (const [place, index] of rows.entries()) {
      pictured[index] = found.pictured[place];
      shift.x[index] = (found.x[place] - places[0][place]) / this.pictureSize;
      shift.y[index] = (found.y[place] - places[1][place]) / this.pictureSize;
    }
    this.#addChosen(rows, places, pictured);
    return { pictured, shift };
  }

  /**
   * Where no shape is in view, since an address or a reader went to where none is, or other marks stand elsewhere, go to
   * the nearest; of several maps the first says where.
   */
  #keepInView() {
    const { scene } = this;
    if (scene.views[0] !== this || this.state.get(scene.cameraName) === null) return;
    let nearest = -1;
    let least = Infinity;
    this.each((index, x, y) => {
      const outside = Math.hypot(beyond(x, this.width, 0), beyond(y, this.height, 0));
      if (outside >= least) return;
      nearest = index;
      least = outside;
    });
    if (nearest < 0 || least === 0) return;
    const camera = scene.camera();
    const [x, y] = this.screen(nearest);
    scene.look({
      ...camera,
      x: camera.x + beyond(x, this.width, INWARD) / this.scale,
      y: camera.y - beyond(y, this.height, INWARD) / this.scale,
    });
    // Beyond the edge of the map there is no looking.
    if (isSame(scene.camera(), camera)) this.state.set({ [scene.cameraName]: null });
  }

  /**
   * Pictures of what stands out, too, at their places: what they may cover is faint, and nothing else moves for them.
   * @param {number[]} rows
   * @param {number[][]} places
   * @param {Uint8Array} pictured
   */
  #addChosen(rows, [x, y], pictured) {
    const chosen = [...rows.keys()].filter((place) => this.scene.emphasis[rows[place]] === CHOSEN);
    const inOrder = [
      ...chosen.filter((place) => pictured[rows[place]]),
      ...chosen.filter((place) => !pictured[rows[place]]),
    ];
    const found = thinned(
      inOrder.map((place) => x[place]),
      inOrder.map((place) => y[place]),
      this.pictureSize,
      EXACT_APART,
    );
    for (const [number, place] of inOrder.entries()) if (found.pictured[number]) pictured[rows[place]] = 1;
  }

  /**
   * Let pictures go to where they now stand.
   * @param {{ x: Float64Array, y: Float64Array }} goal
   */
  #glide(goal) {
    this.#gliding?.abort();
    const from = this.shift;
    const still = isEqual(goal.x, from.x) && isEqual(goal.y, from.y);
    if (still) return;
    if (this.dots === null || this.#onChart) {
      this.shift = goal;
      return;
    }
    this.#gliding = new AbortController();
    animate(GLIDE, this.#gliding.signal, (share) => {
      const rest = (1 - share) ** 3;
      /**
       * @param {Float64Array} to
       * @param {Float64Array} before
       */
      const mix = (to, before) => to.map((value, index) => value + rest * (before[index] - value));
      this.shift = rest === 0 ? goal : { x: mix(goal.x, from.x), y: mix(goal.y, from.y) };
      this.draw();
      if (rest === 0) this.#name();
    });
  }

  /** @type {AbortController | null} */
  #gliding = null;

  /**
   * The shapes whose pictures the map may show, in the order in which they come to one.
   * @param {number} [grid] where pictures lie on sheets
   */
  #drawable(grid) {
    const { sheets, methods } = this.database;
    return sheets ? [...sheets.shapes(methods[this.scene.target].key, grid)] : this.#scattered();
  }

  /** All shapes in an order that favours no class and is always the same, so that pictures stay when others come. */
  #scattered() {
    this.order ??= [...this.database.ids.keys()].sort((a, b) => scatter(a) - scatter(b) || a - b);
    return this.order;
  }

  /** The groups whose names stand on the map. */
  get #naming() {
    return this.coloring.naming ?? classNaming(this.database);
  }

  /** @type {{ coloring: Coloring | null, map: string, middles: Set<number> } | null} */
  #known = null;

  /** The shape in the middle of the largest cluster of each group, in the order of shapes. */
  #middles() {
    const { scene, database, width, height, chosenColoring: coloring } = this;
    const naming = this.#naming;
    const map = [scene.target, database.revision, width, height].join(" ");
    if (this.#known?.coloring !== coloring || this.#known.map !== map) {
      // Of the map that is gone to, not of one on the way there.
      const { x, y } = database.methods[scene.target];
      const bounds = database.bounds[scene.target];
      const scale = Math.min(width / bounds.width, height / bounds.height);
      const thinning = new Thinning(width, height, THINNED);
      const [left, top] = [bounds.x - width / scale / 2, bounds.y - height / scale / 2];
      /** @type {Mark[]} */
      const marks = [];
      for (const index of database.sheets?.shapes(database.methods[scene.target].key) ?? database.ids.keys()) {
        const group = naming.groupOf(index);
        const mark = { index, group, x: (x[index] - left) * scale, y: (y[index] - top) * scale };
        if (group >= 0 && (!crowded(database) || thinning.takes(mark.x, mark.y, group))) marks.push(mark);
      }
      const groups = Map.groupBy(marks, ({ group }) => group);
      const middles = [...groups.values()].map((members) => heartOf(largestCluster(members, DOT), DOT).index);
      this.#known = { coloring, map, middles: new Set(middles.sort((a, b) => a - b)) };
    }
    return this.#known.middles;
  }

  /** @type {{ coloring: Coloring, map: string, groups: Set<number> } | null} */
  #together = null;

  /**
   * Groups with a place on this map.
   * @param {Coloring} coloring with groups of its own
   */
  #placed(coloring) {
    const map = `${this.scene.target} ${this.database.revision}`;
    if (this.#together?.coloring !== coloring || this.#together.map !== map) {
      const groups = placedGroups(/** @type {Naming} */ (coloring.naming), this.database, this.scene.target);
      this.#together = { coloring, map, groups };
    }
    return this.#together.groups;
  }

  /** @type {{ key: string, seen: unknown[], pictured: ArrayLike<number> } | null} what names were placed for */
  #namedFor = null;

  /** Place the names, unless they would find the same marks once more: a selection hides none. */
  #name() {
    const { scene, database, pictured } = this;
    const { scale, left, top } = this.lay();
    const key = [this.name, scene.target, this.width, this.height, scale, left, top].join(" ");
    const seen = [this.state.get("hidden"), this.chosenColoring, this.shift, database.methods[scene.target].x];
    const before = this.#namedFor;
    this.#namedFor = { key, seen, pictured };
    const same = before?.key === key && isEqual(before.seen, seen) && isEqual(before.pictured, pictured);
    if (same && this.labels.anchors.size > 0) this.labels.follow(this.placing());
    else this.#placeNames();
  }

  #placeNames() {
    const { coloring, width, height, pictured, markRadius } = this;
    const naming = this.#naming;
    this.labels.naming = naming;
    const named = coloring.naming && !coloring.ofClasses ? this.#placed(coloring) : null;
    const pictureRadius = this.pictureSize / 2;
    const thinning = crowded(this.database) ? new Thinning(width, height, THINNED) : null;
    const standing = this.labels.anchors;
    /** @type {(Mark & { radius: number })[]} */
    const points = [];
    this.each((index, x, y) => {
      if (x < 0 || y < 0 || x > width || y > height) return;
      const own = naming.groupOf(index);
      const group = named === null || named.has(own) ? own : -1;
      const radius = pictured[index] ? pictureRadius : markRadius;
      // Where a name stands, it stays.
      if (thinning?.takes(x, y, group) === false && !pictured[index] && !standing.has(index)) return;
      points.push({ index, group, x, y, radius });
    });
    if (thinning !== null) keepLargest(points, MOST_NAMED);
    const largest = points.reduce((most, { radius }) => Math.max(most, radius), 0);
    this.labels.place(points, { width, height, covered: coveredOf(this.surface) }, largest);
    this.labels.follow(this.placing());
  }
}

/**
 * What of a surface lies below the buttons that zoom.
 * @param {Element} surface
 */
function coveredOf(surface) {
  const { left, top } = surface.getBoundingClientRect();
  return [...document.querySelectorAll(".zoom")].map((buttons) => {
    const box = buttons.getBoundingClientRect();
    return { left: box.left - left, right: box.right - left, top: box.top - top, bottom: box.bottom - top };
  });
}

/**
 * Let all but the groups of most marks be nameless.
 * @param {Mark[]} marks
 * @param {number} most
 */
function keepLargest(marks, most) {
  /** @type {Map<number, number>} */
  const sizes = new Map();
  for (const { group } of marks) sizes.set(group, (sizes.get(group) ?? 0) + 1);
  const order = [...sizes.keys()].sort((a, b) => (sizes.get(b) ?? 0) - (sizes.get(a) ?? 0) || a - b);
  const small = new Set(order.slice(most));
  if (small.size > 0) for (const mark of marks) if (small.has(mark.group)) mark.group = -1;
}

/**
 * @param {ArrayLike<unknown>} one
 * @param {ArrayLike<unknown>} other
 */
function isEqual(one, other) {
  for (let place = 0; place < one.length; place += 1) if (one[place] !== other[place]) return false;
  return one.length === other.length;
}

/** @param {string} kind */
function tie(kind) {
  return svg("path", { class: `ties ${kind}` });
}

/**
 * How far a place is outside of what goes from 0 to a length, less a share of it on both sides; below zero before it.
 * @param {number} place
 * @param {number} length
 * @param {number} rim
 */
function beyond(place, length, rim) {
  return Math.min(place - rim * length, 0) + Math.max(place - (1 - rim) * length, 0);
}

/**
 * @param {Camera} one
 * @param {Camera} other
 */
function isSame(one, other) {
  return one.x === other.x && one.y === other.y && one.zoom === other.zoom;
}

/** @param {number} index */
function scatter(index) {
  return Math.imul(index + 1, 0x9e3779b1) >>> 0;
}
