// A shape that can be turned: WebGL, one light set-up, one colour a vertex.

import { opennessOf } from "./openness.js";
import { cornersOf } from "./surface.js";

/** @import { Model } from "./model.js" */
/** @import { Corners } from "./surface.js" */

// The eye's distance in radii of the shape, as in its picture: a long lens, mild perspective.
const DISTANCE = 5;
const MARGIN = 0.04;
const [CLOSEST, FARTHEST] = [8, 0.5];

const VERTICES = `#version 300 es
in vec3 position;
in vec3 normal;
in vec3 color;
in float openness;
uniform mat3 turn;
uniform vec3 middle;
uniform vec2 lens;
uniform float radius;
out vec3 facing;
out vec3 place;
out vec3 tint;
out float open;
void main() {
  place = turn * (position - middle);
  facing = turn * normal;
  tint = color;
  open = openness;
  float away = ${DISTANCE.toFixed(1)} * radius - place.z;
  // Depth from -1 to 1 between the near and the far side of the ball around the shape.
  gl_Position = vec4(place.xy * lens, (away - ${DISTANCE.toFixed(1)} * radius) / (1.1 * radius) * away, away);
}`;

// The lights of the pictures (shapeviz_report/render/shading.py).
const FRAGMENTS = `#version 300 es
precision highp float;
in vec3 facing;
in vec3 place;
in vec3 tint;
in float open;
uniform float radius;
out vec4 shown;
void main() {
  vec3 normal = normalize(facing);
  vec3 viewer = normalize(vec3(0.0, 0.0, ${DISTANCE.toFixed(1)} * radius) - place);
  if (!gl_FrontFacing) normal = -normal;
  // Where the surface turns away, a smoothed normal may already point behind it.
  normal = normalize(normal - min(dot(normal, viewer), 0.0) * viewer);
  float key = max(0.0, (dot(normal, vec3(-0.48, 0.62, 0.62)) + 0.25) / 1.25);
  float fill = max(0.0, dot(normal, vec3(0.80, 0.10, 0.59)));
  float sky = 0.5 + 0.5 * normal.y;
  float rim = pow(1.0 - min(dot(normal, viewer), 1.0), 3.0) * sky;
  // Obscured places lose all light of the sky, but only part of the lamps'.
  vec3 light = (0.45 + 0.55 * open) * (key * vec3(0.93, 0.89, 0.83) + fill * vec3(0.12, 0.14, 0.17))
    + open * (mix(vec3(0.10, 0.095, 0.09), vec3(0.23, 0.245, 0.27), sky) + rim * vec3(0.12, 0.13, 0.14));
  vec3 color = min(tint * light, 1.0);
  shown = vec4(mix(12.92 * color, 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, color)), 1.0);
}`;

/** Whether this browser can draw in 3D. */
export function canDraw() {
  return document.createElement("canvas").getContext("webgl2") !== null;
}

export class View {
  // What the graphics card has: made anew whenever it was taken away.
  /** @type {WebGL2RenderingContext} */
  gl;
  /** @type {WebGLProgram} */
  program;
  /** @type {WebGLVertexArrayObject} */
  array;
  /** @type {Record<string, WebGLBuffer>} */
  buffers;

  // What is shown: colours a vertex, the corners' ball, and how the reader turned it.
  /** @type {Model | null} */
  model = null;
  /** @type {Float32Array} */
  colors;
  /** @type {Corners} */
  corners;
  middle = [0, 0, 0];
  radius = 1;
  /** @type {number[]} */
  turn;
  zoom = 1;
  /** @type {number | null} */
  #asked = null;

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {{ turned?: () => void }} [options] called after the reader turned or scaled the shape
   */
  constructor(canvas, { turned = () => {} } = {}) {
    this.canvas = canvas;
    this.turned = turned;
    /** @type {Map<number, [number, number]>} */
    this.pointers = new Map();
    this.#prepare();
    // A browser may take the graphics card away at any time, and give it back.
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => {
      this.#prepare();
      if (this.model) this.show(this.model, this.colors, { keep: true });
    });
    this.#watch();
    this.observer = new ResizeObserver(() => this.draw());
    this.observer.observe(canvas);
  }

  /**
   * Show a model (see model.js) in linear colours, three numbers a vertex; in the view of its picture, unless the
   * view of the model before is to be kept.
   * @param {Model} model
   * @param {Float32Array} colors
   * @param {{ keep?: boolean }} [options]
   */
  show(model, colors, { keep = false } = {}) {
    const { gl } = this;
    if (model !== this.model || keep) {
      this.model = model;
      this.corners = cornersOf(model);
      this.#measure(model.positions);
      this.#fill("position", this.corners.positions);
      this.#fill("normal", this.corners.normals);
      const openness = opennessOf(model, this.radius);
      this.#fill(
        "openness",
        Float32Array.from(this.corners.source, (vertex) => openness[vertex]),
        1,
      );
    }
    this.paint(colors);
    if (!keep) this.reset();
    gl.bindVertexArray(this.array);
  }

  /**
   * Give the same shape other colours.
   * @param {Float32Array} colors
   */
  paint(colors) {
    this.colors = colors;
    const { source } = this.corners;
    const spread = new Float32Array(3 * source.length);
    for (let corner = 0; corner < source.length; corner += 1) {
      for (let channel = 0; channel < 3; channel += 1)
        spread[3 * corner + channel] = colors[3 * source[corner] + channel];
    }
    this.#fill("color", spread);
    this.draw();
  }

  reset() {
    if (!this.model) return;
    this.turn = Array.from(this.model.view);
    this.zoom = 1;
    this.draw();
    this.turned();
  }

  /**
   * Turn by angles to the right and upwards, in radians.
   * @param {number} right
   * @param {number} up
   */
  rotate(right, up) {
    const [c, s, d, t] = [Math.cos(right), Math.sin(right), Math.cos(up), Math.sin(up)];
    const step = [c, 0, s, -t * -s, d, -t * c, -s * d, t, c * d];
    const { turn } = this;
    this.turn = step.map((_, i) => {
      const [row, column] = [3 * Math.floor(i / 3), i % 3];
      return step[row] * turn[column] + step[row + 1] * turn[3 + column] + step[row + 2] * turn[6 + column];
    });
    this.draw();
    this.turned();
  }

  /** @param {number} factor */
  scale(factor) {
    this.zoom = Math.min(Math.max(this.zoom * factor, FARTHEST), CLOSEST);
    this.draw();
    this.turned();
  }

  /** Draw before the browser paints next. */
  draw() {
    if (!this.model || this.#asked) return;
    this.#asked = requestAnimationFrame(() => {
      this.#asked = null;
      this.#drawNow();
    });
  }

  close() {
    this.observer.disconnect();
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  #prepare() {
    const context = this.canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
    const gl = /** @type {WebGL2RenderingContext} */ (context);
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [kind, source] of /** @type {[number, string][]} */ ([
      [gl.VERTEX_SHADER, VERTICES],
      [gl.FRAGMENT_SHADER, FRAGMENTS],
    ])) {
      const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(`the 3D view cannot be set up: ${gl.getProgramInfoLog(this.program)}`);
    }
    this.array = gl.createVertexArray();
    const names = ["position", "normal", "color", "openness"];
    this.buffers = Object.fromEntries(names.map((name) => [name, gl.createBuffer()]));
  }

  /**
   * @param {string} name
   * @param {Float32Array} values
   * @param {number} [size] numbers a corner
   */
  #fill(name, values, size = 3) {
    const { gl } = this;
    const place = gl.getAttribLocation(this.program, name);
    gl.bindVertexArray(this.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  }

  /**
   * The ball around the shape: turning about its middle keeps the shape in sight.
   * @param {Float32Array} positions
   */
  #measure(positions) {
    const [low, high] = [
      [Infinity, Infinity, Infinity],
      [-Infinity, -Infinity, -Infinity],
    ];
    for (let i = 0; i < positions.length; i += 1) {
      low[i % 3] = Math.min(low[i % 3], positions[i]);
      high[i % 3] = Math.max(high[i % 3], positions[i]);
    }
    this.middle = low.map((value, axis) => (value + high[axis]) / 2);
    let squared = 1e-12;
    for (let i = 0; i < positions.length; i += 3) {
      squared = Math.max(
        squared,
        this.middle.reduce((sum, value, axis) => sum + (positions[i + axis] - value) ** 2, 0),
      );
    }
    this.radius = Math.sqrt(squared);
  }

  #drawNow() {
    const { canvas, gl, program } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((size) =>
      Math.round(size * window.devicePixelRatio),
    );
    if (width === 0 || height === 0 || gl.isContextLost()) return;
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    const side = Math.min(width, height);
    // The ball, seen from the eye, fills the shorter side.
    const lens = Math.sqrt(DISTANCE ** 2 - 1) * (1 - 2 * MARGIN) * this.zoom;
    /** @param {string} name */
    const at = (name) => gl.getUniformLocation(program, name);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.enable(gl.DEPTH_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(program);
    gl.bindVertexArray(this.array);
    gl.uniformMatrix3fv(at("turn"), true, this.turn);
    gl.uniform3fv(at("middle"), this.middle);
    gl.uniform2f(at("lens"), (lens * side) / width, (lens * side) / height);
    gl.uniform1f(at("radius"), this.radius);
    gl.drawArrays(gl.TRIANGLES, 0, this.corners.source.length);
  }

  #watch() {
    const { canvas, pointers } = this;
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = pointers.get(event.pointerId);
      if (!before || !this.model) return;
      const spread = this.#spread();
      pointers.set(event.pointerId, [event.clientX, event.clientY]);
      if (pointers.size === 2) {
        if (spread > 0) this.scale(this.#spread() / spread);
        return;
      }
      const turn = Math.PI / Math.max(Math.min(canvas.clientWidth, canvas.clientHeight), 1);
      this.rotate((event.clientX - before[0]) * turn, (event.clientY - before[1]) * turn);
    });
    for (const name of /** @type {const} */ (["pointerup", "pointercancel"])) {
      canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
    }
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener(
      "wheel",
      (event) => {
        // A page that scrolls past must not stop at a picture: only one that the reader took hold of scales.
        if (document.activeElement !== canvas || !this.model) return;
        event.preventDefault();
        this.scale(Math.exp(-event.deltaY / 400));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || !this.model) return;
      const step = Math.PI / 18;
      /** @type {Record<string, [number, number]>} */
      const turns = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
      if (event.key in turns) this.rotate(...turns[event.key]);
      else if (event.key === "+" || event.key === "=") this.scale(1.2);
      else if (event.key === "-") this.scale(1 / 1.2);
      else if (event.key === "0") this.reset();
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
  }

  /** Between two fingers. */
  #spread() {
    if (this.pointers.size !== 2) return 0;
    const [a, b] = [...this.pointers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  }
}
