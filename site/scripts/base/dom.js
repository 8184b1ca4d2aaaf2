// Elements from data. Text is only ever set as text.

import { resource } from "./place.js";

/**
 * What stands in an element: text, or elements; what is null, undefined or false is left out.
 * @typedef {Node | string | number | null | undefined | false} Child
 * @typedef {Child | readonly Children[]} Children
 */

const SVG = "http://www.w3.org/2000/svg";

/**
 * An HTML element with attributes and children (strings become text; null and false are left out).
 * @template {string} Tag
 * @param {Tag} tag
 * @param {Attributes} attributes
 * @param {...Children} children
 * @returns {Tag extends keyof HTMLElementTagNameMap ? HTMLElementTagNameMap[Tag] : HTMLElement}
 */
export function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/**
 * The same in SVG.
 * @template {keyof SVGElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Attributes} attributes
 * @param {...Children} children
 * @returns {SVGElementTagNameMap[Tag]}
 */
export function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

/**
 * @param {any} node
 * @param {Attributes} attributes
 * @param {Children[]} children
 */
function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(
    .../** @type {any[]} */ (children)
      .flat(Infinity)
      .filter((child) => child !== null && child !== undefined && child !== false),
  );
  return node;
}

/**
 * The mark of a class, as the maps draw it.
 * @param {string} path
 * @param {string} color
 */
export function swatch(path, color) {
  const mark = svg("path", { d: path });
  mark.style.fill = color;
  return svg("svg", { class: "swatch", viewBox: "-1.1 -1.1 2.2 2.2", "aria-hidden": "true" }, mark);
}

/**
 * A thumbnail; `name` is said where the picture is all there is to read.
 * @param {{ pictures: { show(image: HTMLImageElement, index: number): void } }} database
 * @param {number} index
 * @param {number} size
 * @param {string} [name]
 */
export function picture(database, index, size, name = "") {
  const image = element("img", {
    alt: name,
    width: size,
    height: size,
    loading: "lazy",
    decoding: "async",
    draggable: "false",
  });
  database.pictures.show(image, index);
  return image;
}

/**
 * A link to a file of the site's data, by its path.
 * @param {string} path
 */
export function dataLink(path) {
  return element("a", { href: resource(path), download: path.split("/").at(-1) }, path);
}

/**
 * What draws on a canvas.
 * @param {HTMLCanvasElement} canvas
 * @param {CanvasRenderingContext2DSettings} [settings]
 */
export function penOf(canvas, settings) {
  return /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", settings));
}

/** Whether nothing is to move: the reader asked for that, or it is on paper. */
export function calm() {
  if (document.documentElement.dataset.paper !== undefined) return true;
  return window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/**
 * What a page says of itself in its head.
 * @param {string} name
 */
export function said(name) {
  return document.querySelector(`meta[name="${name}"]`)?.content ?? "";
}

/** The element that has the focus. */
export function focused() {
  return /** @type {Found} */ (document.activeElement);
}

/** Whether readers point with fingers. */
export function coarse() {
  return window.matchMedia("(pointer: coarse)").matches;
}

/** @type {{ nodes: WeakRef<Element>[], work: () => void }[]} */
const watched = [];

/**
 * Do what is done where elements have another size, now: a browser tells of a new size too late for a sheet of paper.
 */
export function remeasure() {
  for (const { nodes, work } of watched) if (nodes.some((node) => node.deref()?.isConnected)) work();
}

/**
 * Do `work` when elements are first laid out, and whenever one of them has another size: with the next frame, for what it
 * lays out may change a watched size again, and a browser complains of that where it happens within one.
 * @param {Element[]} nodes
 * @param {() => void} work
 */
export function watchSize(nodes, work) {
  watched.push({ nodes: nodes.map((node) => new WeakRef(node)), work });
  let asked = false;
  const observer = new ResizeObserver(() => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      work();
    });
  });
  for (const node of nodes) observer.observe(node);
}

/**
 * Let the browser draw, and hear its reader, between two pieces of work; a sheet of paper waits for nothing. By a message to
 * oneself: a timer that follows another waits for four milliseconds.
 */
export function pause() {
  if (document.documentElement.dataset.paper === "page") return Promise.resolve();
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve(undefined);
    };
    port2.postMessage(null);
  });
}

/**
 * Scroll a row, and nothing but the row, until one of its items is in its middle.
 * @param {Found} row
 * @param {Found} item
 */
export function bringIntoRow(row, item) {
  const [outer, inner] = [row.getBoundingClientRect(), item.getBoundingClientRect()];
  row.scrollLeft += inner.left + inner.width / 2 - (outer.left + outer.width / 2);
}
