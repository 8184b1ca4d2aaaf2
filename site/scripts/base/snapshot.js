// A part of a page as one drawing of SVG: texts as texts, boxes as boxes, and drawings as they are. What is drawn on a
// canvas is drawn again, by who drew it.

import { svg } from "./dom.js";
import { shownPicture } from "./pictures.js";

/**
 * @typedef {{ node: SVGElement, width: number, height: number }} Drawing
 * @typedef {{ x: number, y: number }} Corner
 */

/** What a drawing inherits or is given by style sheets, and has to say itself where there are none. */
const LOOKS = [
  "fill",
  "fill-opacity",
  "stroke",
  "stroke-width",
  "stroke-opacity",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "opacity",
  "font-family",
  "font-size",
  "font-weight",
  "font-style",
  "letter-spacing",
  "text-anchor",
  "dominant-baseline",
  "paint-order",
  "unicode-bidi",
];

/**
 * How an element is drawn, and what belongs below the figure that it stands in; `picture` gives the content of a picture
 * as an address that holds it all.
 * @typedef {(picture: number | string) => string | null} Held a shape's by its number, another one by its address
 * @typedef {(picture: Held) => { node: SVGElement, below?: Drawing } | null} Draw
 */

/** @type {WeakMap<Element, Draw>} */
const drawings = new WeakMap();

/**
 * Say how an element that draws on a canvas is drawn with SVG, in its own pixels; with null, as what stands in it.
 * @param {Element} node
 * @param {Draw} draw
 */
export function drawnAs(node, draw) {
  drawings.set(node, draw);
}

/**
 * What a figure is called and what it shows; whether it says so on paper too, where its page does not.
 * @typedef {{ title?: string, words: string, onPaper?: boolean }} Told
 */

/** @type {WeakMap<Element, () => string | Told>} */
const tellings = new WeakMap();

/**
 * Say in a sentence what a figure shows, for who sees it without the page about it, and how it is called where that
 * changes. A sentence alone stands on paper too.
 * @param {Element | null} figure
 * @param {() => string | Told} tell
 */
export function toldAs(figure, tell) {
  if (figure !== null) tellings.set(figure, tell);
}

/**
 * The title and the caption of a figure: as it was told, else as its page has them.
 * @param {Found} figure
 * @returns {{ title: string, words: string }}
 */
export function toldOf(figure) {
  const told = tellings.get(figure)?.();
  const { title, words } = typeof told === "object" ? told : { title: undefined, words: told };
  return { title: title ?? figure.dataset.figure ?? "", words: words ?? captionOf(figure) };
}

/**
 * What stands below a figure on paper and nowhere else.
 * @param {Element} figure
 */
export function toldOnPaper(figure) {
  const told = tellings.get(figure)?.();
  return typeof told === "object" ? (told.onPaper ? told.words : "") : (told ?? "");
}

/** @param {Element} figure */
function captionOf(figure) {
  const caption = [...figure.querySelectorAll(".caption")].find((node) => node.closest("[data-figure]") === figure);
  if (caption === undefined) return "";
  const copy = /** @type {Element} */ (caption.cloneNode(true));
  for (const node of copy.querySelectorAll(".on-screen, .save-figure")) node.remove();
  for (const node of copy.querySelectorAll("sub")) node.prepend("_");
  return (copy.textContent ?? "").replace(/\s+/g, " ").trim();
}

/**
 * The elements within another that are drawn in a way of their own, each with its drawing.
 * @param {Element} root
 */
export function drawnWithin(root) {
  return [...root.querySelectorAll("*")].flatMap((node) => {
    const drawing = node.clientWidth > 0 ? drawings.get(node)?.(shownPicture)?.node : undefined;
    return drawing === undefined ? [] : [{ node, drawing }];
  });
}

/**
 * The part of the page within an element.
 * @param {HTMLElement} root
 * @param {Held} picture
 * @returns {Drawing}
 */
export function snapshot(root, picture) {
  const { left, top } = root.getBoundingClientRect();
  const taker = new Taker({ x: left, y: top }, picture);
  const node = svg("g");
  taker.take(root, node);
  let { width, height } = taker;
  for (const below of taker.below) {
    below.node.setAttribute("transform", `translate(0 ${height + GAP})`);
    node.append(below.node);
    [width, height] = [Math.max(width, below.width), height + GAP + below.height];
  }
  return { node, width, height };
}

/** Between a figure and its legend. */
const GAP = 12;

class Taker {
  width = 0;
  height = 0;
  /** @type {Drawing[]} */
  below = [];

  /**
   * @param {Corner} origin
   * @param {Held} picture
   */
  constructor(origin, picture) {
    this.origin = origin;
    this.picture = picture;
  }

  /**
   * Where a rectangle of the page is in the drawing.
   * @param {DOMRect} rect
   */
  #placeOf(rect) {
    return { x: rect.left - this.origin.x, y: rect.top - this.origin.y, width: rect.width, height: rect.height };
  }

  /**
   * The same for what is drawn there: the drawing is as large as what is in it.
   * @param {DOMRect} rect
   */
  #place(rect) {
    const place = this.#placeOf(rect);
    this.width = Math.max(this.width, place.x + place.width);
    this.height = Math.max(this.height, place.y + place.height);
    return place;
  }

  /**
   * @param {Element} node
   * @param {SVGElement} into
   */
  take(node, into) {
    const style = getComputedStyle(node);
    if (style.display === "none") return;
    const own = style.opacity === "1" ? into : svg("g", { opacity: style.opacity });
    if (own !== into) into.append(own);
    const seen = style.visibility === "visible";
    const drawn = drawings.get(node)?.(this.picture) ?? null;
    if (drawn || node.localName === "svg") {
      if (!seen) return;
      if (drawn) this.#box(node, style, own);
      if (drawn?.below) this.below.push(drawn.below);
      this.#nest(node, drawn?.node ?? styled(/** @type {SVGElement} */ (node), this.picture), own);
      return;
    }
    if (seen) this.#box(node, style, own);
    if (node instanceof HTMLImageElement || node instanceof HTMLCanvasElement) {
      if (seen) this.#image(node, own);
      return;
    }
    for (const child of node.childNodes) {
      if (child instanceof Element) this.take(child, own);
      else if (seen && child instanceof Text) this.#text(child, node, style, own);
    }
  }

  /**
   * @param {Element} node
   * @param {SVGElement} drawing
   * @param {SVGElement} into
   */
  #nest(node, drawing, into) {
    const place = this.#place(node.getBoundingClientRect());
    if (place.width === 0 || place.height === 0) return;
    for (const [name, value] of Object.entries(place)) drawing.setAttribute(name, String(value));
    into.append(drawing);
  }

  /**
   * Ground and borders.
   * @param {Element} node
   * @param {CSSStyleDeclaration} style
   * @param {SVGElement} into
   */
  #box(node, style, into) {
    const rect = node.getBoundingClientRect();
    if (rect.width === 0 || rect.height === 0) return;
    const place = this.#placeOf(rect);
    const ramp = [...style.backgroundImage.matchAll(/(?:rgba?|color)\([^)]*\)/g)].map(([color]) => color);
    let fill = style.backgroundColor;
    // One gradient over all of it is a ramp; several are the shades of what scrolls.
    const gradients = style.backgroundImage.match(/gradient\(/g) ?? [];
    if (style.backgroundImage.startsWith("linear-gradient") && gradients.length === 1 && ramp.length > 1) {
      const id = `ramp-${Math.random().toString(36).slice(2)}`;
      const stops = ramp.map((color, at) => svg("stop", { offset: at / (ramp.length - 1), "stop-color": color }));
      into.append(svg("linearGradient", { id }, stops));
      fill = `url(#${id})`;
    }
    if (!transparent(fill))
      into.append(svg("rect", { ...this.#place(rect), rx: parseFloat(style.borderTopLeftRadius) || 0, fill }));
    const { x, y, width, height } = place;
    /** @type {Record<string, number[]>} */
    const sides = {
      top: [x, y, x + width, y],
      right: [x + width, y, x + width, y + height],
      bottom: [x, y + height, x + width, y + height],
      left: [x, y, x, y + height],
    };
    for (const [side, [x1, y1, x2, y2]] of Object.entries(sides)) {
      const line = parseFloat(style.getPropertyValue(`border-${side}-width`));
      const color = style.getPropertyValue(`border-${side}-color`);
      const kind = style.getPropertyValue(`border-${side}-style`);
      if (line === 0 || kind === "none" || transparent(color)) continue;
      const dashes = kind === "dotted" ? line : kind === "dashed" ? 3 * line : null;
      into.append(svg("line", { x1, y1, x2, y2, stroke: color, "stroke-width": line, "stroke-dasharray": dashes }));
    }
  }

  /**
   * @param {HTMLImageElement | HTMLCanvasElement} node
   * @param {SVGElement} into
   */
  #image(node, into) {
    const place = this.#place(node.getBoundingClientRect());
    const href = node instanceof HTMLImageElement ? this.picture(pictureOf(node)) : canvasAddress(node);
    if (href !== null && place.width > 0) into.append(svg("image", { ...place, href }));
  }

  /**
   * A text, line by line. One that its box cuts off is narrowed until all of it is there.
   * @param {Text} text
   * @param {Element} node
   * @param {CSSStyleDeclaration} style
   * @param {SVGElement} into
   */
  #text(text, node, style, into) {
    if (text.data.trim() === "") return;
    const cut = style.overflowX === "hidden" && node.scrollWidth > node.clientWidth;
    const { ascent, height } = fontOf(style);
    const font = {
      fill: style.color,
      "font-family": style.fontFamily,
      "font-size": style.fontSize,
      "font-weight": style.fontWeight,
      "font-style": style.fontStyle === "normal" ? null : style.fontStyle,
      "letter-spacing": style.letterSpacing === "normal" ? null : style.letterSpacing,
    };
    if (style.writingMode.startsWith("vertical")) {
      const { x, y, width, height: length } = this.#place(node.getBoundingClientRect());
      const upwards = readsUpwards(node);
      const attributes = {
        ...font,
        y: ascent - height / 2,
        transform: `translate(${x + width / 2} ${upwards ? y + length : y}) rotate(${upwards ? -90 : 90})`,
        textLength: node.scrollHeight > node.clientHeight ? length : null,
        lengthAdjust: node.scrollHeight > node.clientHeight ? "spacingAndGlyphs" : null,
      };
      into.append(svg("text", attributes, text.data.trim()));
      return;
    }
    for (const { words, rect } of linesOf(text, style.whiteSpaceCollapse === "preserve")) {
      const { x, y, width } = this.#place(rect);
      const attributes = {
        ...font,
        x,
        y: y + (rect.height - height) / 2 + ascent,
        textLength: cut ? Math.min(width, node.clientWidth) : null,
        lengthAdjust: cut ? "spacingAndGlyphs" : null,
      };
      into.append(svg("text", attributes, style.textTransform === "uppercase" ? words.toUpperCase() : words));
    }
  }
}

/**
 * Whether a vertical text is turned round, so that it begins at its foot.
 * @param {Element | null} node
 */
function readsUpwards(node) {
  for (let own = node; own !== null; own = own.parentElement) {
    const { transform, writingMode } = getComputedStyle(own);
    if (!writingMode.startsWith("vertical")) break;
    if (transform !== "none") return new DOMMatrix(transform).a < 0;
  }
  return false;
}

/** @param {HTMLImageElement} image */
function pictureOf({ dataset, src }) {
  return dataset.picture === undefined ? src : Number(dataset.picture);
}

/** @param {string} color */
function transparent(color) {
  return color === "transparent" || /[,/]\s*0(?:\.0*)?\)$/.test(color);
}

/**
 * The lines in which a text stands on the page.
 * @param {Text} text
 * @param {boolean} whole whether all its spaces count
 */
function linesOf(text, whole) {
  const range = document.createRange();
  /** @type {{ words: string, rect: DOMRect }[]} */
  const lines = [];
  for (const { index, 0: word } of text.data.matchAll(/\S+\s*/g)) {
    range.setStart(text, index);
    range.setEnd(text, index + word.trimEnd().length);
    // A word that is broken counts to the line where it begins.
    const rect = range.getClientRects()[0];
    if (!rect) continue;
    const line = lines.at(-1);
    if (line && Math.abs(line.rect.top - rect.top) < rect.height / 2 && rect.left >= line.rect.left) {
      line.words += word;
      line.rect = new DOMRect(line.rect.x, line.rect.y, rect.right - line.rect.left, line.rect.height);
    } else lines.push({ words: word, rect });
  }
  return lines.map(({ words, rect }) => ({ words: whole ? words : words.replace(/\s+/g, " ").trim(), rect }));
}

/** @type {CanvasRenderingContext2D | null} */
let pen = null;

/**
 * How high the letters of a font stand above and below their line.
 * @param {CSSStyleDeclaration} style
 */
function fontOf({ fontStyle, fontWeight, fontSize, fontFamily }) {
  pen ??= /** @type {CanvasRenderingContext2D} */ (document.createElement("canvas").getContext("2d"));
  pen.font = `${fontStyle} ${fontWeight} ${fontSize} ${fontFamily}`;
  const { fontBoundingBoxAscent: ascent, fontBoundingBoxDescent: descent } = pen.measureText("x");
  return { ascent, height: ascent + descent };
}

/**
 * A copy of a drawing that says itself how it looks.
 * @template {SVGElement} Node
 * @param {Node} node
 * @param {Held} picture
 * @returns {Node}
 */
export function styled(node, picture) {
  const copy = /** @type {Node} */ (node.cloneNode(true));
  const originals = [node, ...node.querySelectorAll("*")];
  const copies = [copy, ...copy.querySelectorAll("*")];
  for (const [place, original] of originals.entries()) {
    const own = copies[place];
    const style = getComputedStyle(original);
    if (style.display === "none" || style.visibility !== "visible") {
      // Hidden parts may have visible ones.
      if (style.display === "none" || original.childElementCount === 0) own.remove();
    }
    for (const name of LOOKS) own.setAttribute(name, style.getPropertyValue(name));
    for (const name of ["style", "class", "id", "tabindex", "role"]) own.removeAttribute(name);
    const href = original.getAttribute("href") ?? original.getAttributeNS("http://www.w3.org/1999/xlink", "href");
    if (original.localName === "image" && href !== null) {
      const held = picture(new URL(href, document.baseURI).href);
      if (held === null) own.remove();
      else own.setAttribute("href", held);
      own.removeAttributeNS("http://www.w3.org/1999/xlink", "href");
    }
  }
  return copy;
}

/** @param {HTMLCanvasElement} canvas */
function canvasAddress(canvas) {
  try {
    return canvas.toDataURL();
  } catch {
    // A canvas that has drawn pictures from files tells nobody what is on it.
    return null;
  }
}
