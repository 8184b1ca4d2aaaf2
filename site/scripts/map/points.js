// Very many marks of shapes on a canvas, by WebGL: one call draws all that are as present. They look as marks.js draws them.

import { element } from "../base/dom.js";
import { coverage, FADED, FULL, OUTLINE, rgbaOf, SMALLEST_OUTLINED } from "./marks.js";

/**
 * How marks look: for every shape red, green and blue, from 0 to 255, and the number of its symbol.
 * @typedef {{ paint: Uint8Array, symbols: string[] }} Paint
 *
 * How the plane lies in a drawing of this size, in pixels of the page.
 * @typedef {{ scale: number, left: number, top: number, width: number, height: number }} Lay
 *
 * Shapes that are as present.
 * @typedef {{ level: number, radius: number, faint: boolean }} Layer
 */

/** Symbols reach a little beyond their radius. */
const REACH = 1.6;

/** Beyond so many sheets of symbols they are forgotten: a reader who zooms for long would fill the memory. */
const MOST_SHEETS = 50;

const VERTICES = `#version 300 es
in vec2 place;
in vec4 paint;
in float level;
uniform vec3 lay;
uniform vec2 size;
uniform float density;
uniform float side;
uniform float shown;
flat out vec3 color;
flat out int symbol;
void main() {
  color = paint.rgb;
  symbol = int(paint.a * 255.0 + 0.5);
  // On whole pixels: a stamp is laid as it was cut. What is not shown now lies outside.
  vec2 at = floor((lay.yz + place * vec2(lay.x, -lay.x)) * density + 0.5);
  gl_Position = level == shown ? vec4(at / size * 2.0 - 1.0, 0.0, 1.0) * vec4(1.0, -1.0, 1.0, 1.0) : vec4(2.0);
  gl_PointSize = side;
}`;

const FRAGMENTS = `#version 300 es
precision highp float;
uniform sampler2D stamps;
uniform vec4 outline;
uniform float side;
uniform float opacity;
flat in vec3 color;
flat in int symbol;
out vec4 laid;
void main() {
  ivec2 at = ivec2(gl_PointCoord * side);
  vec4 stamp = texelFetch(stamps, ivec2(at.x + symbol * int(side), at.y), 0);
  float line = stamp.g * outline.a;
  laid = opacity * (vec4(outline.rgb, 1.0) * line + vec4(color, 1.0) * stamp.r * (1.0 - line));
}`;

const EVERYWHERE = `#version 300 es
void main() {
  gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}`;

const NOTHING = `#version 300 es
precision highp float;
out vec4 laid;
void main() {
  laid = vec4(0.0);
}`;

export class Points {
  /** @type {Paint | null} the one that the graphics memory holds */
  #paint = null;
  /** @type {Map<string, { texture: WebGLTexture, side: number }>} */
  #sheets = new Map();

  /**
   * A canvas for so many marks; null where there is no WebGL.
   * @param {number} count
   * @param {Attributes} attributes of the canvas
   * @param {() => void} lost is called when the browser takes the graphics memory away
   */
  static made(count, attributes, lost) {
    const node = element("canvas", attributes);
    const gl = node.getContext("webgl2", { antialias: false, depth: false });
    if (gl === null) return null;
    node.addEventListener("webglcontextlost", lost);
    return new Points(node, gl, count);
  }

  /**
   * @param {HTMLCanvasElement} node
   * @param {WebGL2RenderingContext} gl
   * @param {number} count
   */
  constructor(node, gl, count) {
    this.node = node;
    this.gl = gl;
    this.count = count;
    this.places = new Float32Array(2 * count);
    this.marks = programOf(gl, VERTICES, FRAGMENTS);
    this.veil = programOf(gl, EVERYWHERE, NOTHING);
    this.buffers = {
      place: this.#attribute("place", 2, gl.FLOAT),
      paint: this.#attribute("paint", 4, gl.UNSIGNED_BYTE),
      level: this.#attribute("level", 1, gl.UNSIGNED_BYTE),
    };
  }

  /**
   * @param {string} name
   * @param {number} size
   * @param {number} kind
   */
  #attribute(name, size, kind) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    const location = gl.getAttribLocation(this.marks, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, kind, name === "paint", 0, 0);
    return buffer;
  }

  /**
   * Draw shapes, the layers one above the other; the faint ones are faint as a whole: marks that lie on each other are
   * then no darker than one.
   * @param {{ x: ArrayLike<number>, y: ArrayLike<number> }} places in the plane
   * @param {Uint8Array} levels of the shapes: each is drawn with the layer of its level
   * @param {Layer[]} layers
   * @param {Paint} paint
   * @param {string} outline
   * @param {Lay} lay
   */
  draw({ x, y }, levels, layers, paint, outline, { scale, left, top, width, height }) {
    const { gl, node, places } = this;
    const density = window.devicePixelRatio || 1;
    const [wide, high] = [Math.round(width * density), Math.round(height * density)];
    if (node.width !== wide || node.height !== high) Object.assign(node, { width: wide, height: high });
    for (let index = 0; index < this.count; index += 1) {
      places[2 * index] = x[index];
      places[2 * index + 1] = y[index];
    }
    this.#fill(this.buffers.place, places);
    this.#fill(this.buffers.level, levels);
    if (this.#paint !== paint) {
      this.#fill(this.buffers.paint, paint.paint);
      this.#paint = paint;
    }
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendColor(0, 0, 0, FADED);
    for (const { level, radius, faint } of layers) {
      gl.useProgram(this.marks);
      const { texture, side } = this.#sheetOf(paint.symbols, radius, density);
      // A mark whose middle is outside may still reach into the drawing.
      gl.viewport(-side, -side, wide + 2 * side, high + 2 * side);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      const at = (/** @type {string} */ name) => gl.getUniformLocation(this.marks, name);
      gl.uniform3f(at("lay"), scale, left + side / density, top + side / density);
      gl.uniform2f(at("size"), wide + 2 * side, high + 2 * side);
      gl.uniform1f(at("density"), density);
      gl.uniform1f(at("side"), side);
      gl.uniform1f(at("shown"), level);
      gl.uniform4fv(
        at("outline"),
        radius < SMALLEST_OUTLINED ? [0, 0, 0, 0] : Array.from(rgbaOf(outline), (part) => part / 255),
      );
      gl.uniform1f(at("opacity"), faint ? 1 : FULL);
      gl.drawArrays(gl.POINTS, 0, this.count);
      if (!faint) continue;
      gl.useProgram(this.veil);
      gl.viewport(0, 0, wide, high);
      gl.blendFunc(gl.ZERO, gl.CONSTANT_ALPHA);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
  }

  /**
   * @param {WebGLBuffer} buffer
   * @param {ArrayBufferView} values
   */
  #fill(buffer, values) {
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
  }

  /**
   * The symbols beside each other, of a size: how far each pixel is filled, and how far its outline covers it.
   * @param {string[]} symbols
   * @param {number} radius
   * @param {number} density
   */
  #sheetOf(symbols, radius, density) {
    // In steps that nobody sees, or marks that grow would need a sheet for every frame.
    const size = Math.max(Math.round(4 * radius * density), 1) / 4;
    const key = [size, density, ...symbols].join(" ");
    const known = this.#sheets.get(key);
    if (known) return known;
    const { gl } = this;
    if (this.#sheets.size > MOST_SHEETS) {
      for (const { texture } of this.#sheets.values()) gl.deleteTexture(texture);
      this.#sheets.clear();
    }
    const side = 2 * Math.ceil(REACH * size + 1);
    const width = side * symbols.length;
    const stamps = coverage(symbols, size, side, OUTLINE * density);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG8, width, side, 0, gl.RG, gl.UNSIGNED_BYTE, stamps);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    const sheet = { texture, side };
    this.#sheets.set(key, sheet);
    return sheet;
  }
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {string} vertices
 * @param {string} fragments
 */
function programOf(gl, vertices, fragments) {
  const program = gl.createProgram();
  for (const [kind, source] of /** @type {const} */ ([
    [gl.VERTEX_SHADER, vertices],
    [gl.FRAGMENT_SHADER, fragments],
  ])) {
    const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`marks cannot be set up: ${gl.getProgramInfoLog(program)}`);
  return program;
}
