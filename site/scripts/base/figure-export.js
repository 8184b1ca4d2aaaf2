// Figures to take away: what an element with `data-figure` shows, as SVG and as PNG, with its title, and where it is from.
//
// There is one way for all of them: the element is drawn as it stands on the page, by day, in texts, boxes and lines that a
// program for drawings can change. Nothing in the file leads out of it.

import { element, said, svg } from "./dom.js";
import { drawnSymbols } from "./figures.js";
import { onPaper } from "./paper.js";
import { heldPictures } from "./pictures.js";
import { fileName, saveFile, xmlText } from "./saving.js";
import { snapshot, toldOf } from "./snapshot.js";

/** @import { Held } from "./snapshot.js" */

/** Around a figure, and between its parts, in pixels. */
const MARGIN = 20;
const LINE = 18;
/** The size of what is said of a figure, in pixels. */
const TOLD = 12;
/** Pixels of a PNG for one of the page, and the most on a side that browsers draw. */
const DENSITY = 3;
const LONGEST = 8000;

/** Where the menu of a figure stands, if there is such a place in it; else in its corner. */
const HEADS = ["figcaption", ".section-head", ".part-head", ".ranking-head", ".retrieval-head", ".class-head"]
  .map((head) => `:scope > ${head}`)
  .join();

const FONT = { "font-family": "system-ui, sans-serif", fill: "#1c1d1f" };

/** Give every figure of the page a menu; called once, when all of them are there. */
export function offerFigures() {
  for (const root of document.querySelectorAll("[data-figure]")) {
    /** @param {"SVG" | "PNG"} kind */
    const way = (kind) =>
      element(
        "button",
        {
          type: "button",
          class: "plain",
          title: kind === "SVG" ? "A drawing of lines and texts, for papers" : "A picture, for slides and messages",
          onclick: () => {
            menu.open = false;
            saveFigure(root, kind);
          },
        },
        kind,
      );
    const menu = element(
      "details",
      { class: "save-figure" },
      element(
        "summary",
        { title: "Save this figure", "aria-label": `Save the figure: ${root.dataset.figure}` },
        "Save",
      ),
      element("div", {}, way("SVG"), way("PNG")),
    );
    menu.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !menu.open) return;
      event.stopPropagation();
      menu.open = false;
      menu.querySelector("summary").focus();
    });
    const head = root.querySelector(HEADS);
    menu.classList.toggle("in-head", head !== null);
    (head ?? root).append(menu);
  }
  document.addEventListener("pointerdown", (event) => {
    for (const menu of document.querySelectorAll(".save-figure[open]"))
      if (!menu.contains(event.target)) menu.removeAttribute("open");
  });
}

/**
 * @param {Found} root
 * @param {"SVG" | "PNG"} kind
 */
async function saveFigure(root, kind) {
  const { text, width, height } = await figureText(root);
  const name = `${fileName(said("database"), toldOf(root).title)}.${kind.toLowerCase()}`;
  const drawing = new Blob([text], { type: "image/svg+xml" });
  saveFile(name, kind === "SVG" ? drawing : await pixels(drawing, width, height));
}

/** @param {Found} root */
async function figureText(root) {
  const { node, width, height } = await drawn(root);
  const { title, words } = toldOf(root);
  const wide = Math.max(width, 320) + 2 * MARGIN;
  const source = wrapped(said("source"), (wide - 2 * MARGIN) / 5.6);
  const heading = wrapped(title, (wide - 2 * MARGIN) / 8.6);
  const told = wrapped(words, (wide - 2 * MARGIN) / 6.6);
  const below = MARGIN + heading.length * LINE + 8;
  const top = below + (told.length > 0 ? told.length * 16 + 8 : 0);
  const high = top + height + 14 + source.length * 14 + MARGIN;
  node.setAttribute("transform", `translate(${MARGIN} ${top})`);
  const drawing = svg(
    "svg",
    { width: Math.ceil(wide), height: Math.ceil(high), viewBox: `0 0 ${Math.ceil(wide)} ${Math.ceil(high)}` },
    svg("title", {}, title),
    svg("desc", {}, said("source")),
    svg("rect", { width: "100%", height: "100%", fill: "#ffffff" }),
    heading.map((line, place) =>
      svg(
        "text",
        { ...FONT, x: MARGIN, y: MARGIN + 13 + LINE * place, "font-size": "15px", "font-weight": "650" },
        line,
      ),
    ),
    told.map((line, place) =>
      svg(
        "text",
        { ...FONT, x: MARGIN, y: below + 10 + 16 * place, "font-size": `${TOLD}px` },
        drawnSymbols(line, TOLD),
      ),
    ),
    node,
    source.map((line, place) =>
      svg(
        "text",
        { ...FONT, x: MARGIN, y: top + height + 24 + 14 * place, "font-size": "11px", fill: "#5f6368" },
        line,
      ),
    ),
  );
  const text = `<?xml version="1.0" encoding="UTF-8"?>\n${xmlText(new XMLSerializer().serializeToString(drawing))}\n`;
  return { text, width: Math.ceil(wide), height: Math.ceil(high) };
}

/**
 * Do something while an element holds no more than its figure: without its heading, the words of the page about it, and
 * what is to be pressed or read on a screen. Its maps keep their sizes.
 * @template Result
 * @param {Found} root
 * @param {() => Result} work
 */
function alone(root, work) {
  const maps = [...root.querySelectorAll(".surface")].map((node) => ({
    node,
    style: node.style.cssText,
    box: node.getBoundingClientRect(),
  }));
  for (const { node, box } of maps)
    Object.assign(node.style, { flex: "none", width: `${box.width}px`, height: `${box.height}px` });
  root.dataset.saved = "";
  try {
    return work();
  } finally {
    delete root.dataset.saved;
    for (const { node, style } of maps) node.style.cssText = style;
  }
}

/**
 * A text in lines of some letters.
 * @param {string} text
 * @param {number} most
 */
function wrapped(text, most) {
  /** @type {string[]} */
  const lines = [];
  for (const word of text.split(/\s+/).filter(Boolean)) {
    if (lines.length > 0 && `${lines.at(-1)} ${word}`.length <= most) lines.push(`${lines.pop()} ${word}`);
    else lines.push(word);
  }
  return lines;
}

/**
 * The figure with the pictures in it, which are only known, and then loaded, once it has been drawn.
 * @param {Found} root
 */
async function drawn(root) {
  /** @type {Set<number | string>} */
  const wanted = new Set();
  /** @param {Held} picture */
  const draw = (picture) => onPaper(() => alone(root, () => snapshot(root, picture)));
  const first = await draw((picture) => {
    wanted.add(picture);
    return null;
  });
  if (wanted.size === 0) return first;
  const held = await heldPictures(wanted);
  return draw((picture) => held.get(picture) ?? null);
}

/**
 * A drawing as a picture of many pixels.
 * @param {Blob} drawing
 * @param {number} width
 * @param {number} height
 * @returns {Promise<Blob>}
 */
async function pixels(drawing, width, height) {
  const density = Math.min(DENSITY, LONGEST / Math.max(width, height));
  const canvas = element("canvas", { width: Math.round(width * density), height: Math.round(height * density) });
  const address = URL.createObjectURL(drawing);
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  } finally {
    URL.revokeObjectURL(address);
  }
  return new Promise((done, failed) =>
    canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("the browser made no picture of the figure")))),
  );
}
