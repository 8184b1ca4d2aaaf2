// Elements from data. Text is only ever set as text.

import { resource } from "./place.js";

const SVG = "http://www.w3.org/2000/svg";

/** An HTML element with attributes and children (strings become text; null and false are left out). */
export function element(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** The same in SVG. */
export function svg(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return node;
}

/** The mark of a class, as the maps draw it. */
export function swatch(path, color) {
  const mark = svg("path", { d: path });
  mark.style.fill = color;
  return svg("svg", { class: "swatch", viewBox: "-1.1 -1.1 2.2 2.2", "aria-hidden": "true" }, mark);
}

/** A thumbnail; `name` is said where the picture is all there is to read. */
export function picture(database, index, size, name = "") {
  return element("img", {
    src: database.picture(index),
    alt: name,
    width: size,
    height: size,
    loading: "lazy",
    decoding: "async",
    draggable: "false",
  });
}

/** A link to a file of the site's data, by its path. */
export function dataLink(path) {
  return element("a", { href: resource(path), download: path.split("/").at(-1) }, path);
}

/** Whether the reader asked for less movement. */
export function calm() {
  return window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** The element that has the focus. */
export function focused() {
  return /** @type {HTMLElement} */ (document.activeElement);
}

/** Whether readers point with fingers. */
export function coarse() {
  return window.matchMedia("(pointer: coarse)").matches;
}
