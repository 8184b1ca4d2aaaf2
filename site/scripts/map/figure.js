// A map as a drawing of SVG: the marks that it shows, each as its own shape, and the names beside them, with a legend.

import { svg } from "../base/dom.js";
import { snapshot, styled } from "../base/snapshot.js";
import { count, isolated } from "../base/words.js";
import { classNaming } from "./coloring.js";
import { FADED, FULL } from "./marks.js";
import { CHOSEN, FAINT, NORMAL } from "./scene.js";

/** @import { Held } from "../base/snapshot.js" */
/** @import { MapView } from "./map.js" */
/** @import { Emphasis } from "./scene.js" */

/** @type {Emphasis[]} */
const LEVELS = [FAINT, NORMAL, CHOSEN];

/** Marks of so many shapes at the most are shapes of a drawing. */
export const MOST_SHAPES = 10_000;

/** A legend has rows of so many pixels, and as much beside a name as the mark before it takes. */
const ROW = 20;
const INDENT = 16;

/**
 * @param {MapView} view
 * @param {Held} picture
 */
export function mapFigure(view, picture) {
  const { scene, width, height } = view;
  const placeOf = view.placing();
  // Of very many marks each as its own shape, a drawing would be dozens of megabytes.
  const dots = scene.x.length > MOST_SHAPES ? (view.dots?.image() ?? null) : null;
  const layers = LEVELS.map((level) => {
    // Pictures lie above the dots of what has no room for one.
    const pictures = svg("g");
    const layer = svg("g", { opacity: level === FAINT ? FADED : FULL });
    for (let index = 0; index < scene.x.length; index += 1) {
      if (scene.emphasis[index] !== level) continue;
      const [x, y] = placeOf(index);
      if (!(x > 0 && y > 0 && x < width && y < height) || (dots !== null && !view.pictured[index])) continue;
      const mark = markOf(view, index, [x, y], picture);
      (mark.length > 1 ? pictures : layer).append(...mark);
    }
    layer.append(pictures);
    return layer;
  });
  return {
    node: svg(
      "svg",
      { viewBox: `0 0 ${width} ${height}` },
      dots && svg("image", { width, height, href: dots }),
      layers,
      namesOf(view, picture),
    ),
    below: legendOf(view, picture),
  };
}

/**
 * What a map shows, in sentences.
 * @param {MapView} view
 */
export function mapWords({ scene, database, chosenColoring, name }) {
  const { title, features, neighbours } = database.methods[scene.target];
  const { subsets, standIn, methods } = database.data;
  const kind = standIn ? "cluster" : "class";
  const brought = features.length === 0;
  const by = subsets?.bins && !brought && scene.target < methods.length ? [count(subsets.bins, "bin")] : features;
  /** @param {(level: number) => boolean} is */
  const shapes = (is) => scene.emphasis.filter(is).length;
  const [shown, chosen] = [shapes((level) => level >= FAINT), shapes((level) => level === CHOSEN)];
  const colored =
    name === "hit"
      ? `Colour: how many of a shape’s ${count(neighbours, "nearest neighbour")} are of its ${kind}, from none (red) to all (yellow).`
      : chosenColoring !== null
        ? `Colour: ${isolated(chosenColoring.title)}.`
        : database.labelled && `${name === "thumbnail" ? "Colour" : "Colour and mark"}: ${kind}.`;
  return [
    `${title} map of ${count(shown, "shape")}${brought ? ", brought along" : `, compared by ${by.map(isolated).join(", ")}`}.`,
    colored,
    chosen > 0 && `${count(chosen, "shape")} ${chosen === 1 ? "stands" : "stand"} out.`,
    shown < database.count && `${count(database.count - shown, "shape")} left out.`,
    scene.camera().zoom > 1 && "Shown is a part of it.",
  ]
    .filter(Boolean)
    .join(" ");
}

/**
 * Names, rings and lines over the marks.
 * @param {MapView} view
 * @param {Held} picture
 */
function namesOf({ overlay, width, height }, picture) {
  const names = styled(overlay, picture);
  for (const [name, value] of Object.entries({ x: 0, y: 0, width, height })) names.setAttribute(name, `${value}`);
  return names;
}

/**
 * @param {MapView} view
 * @param {number} index
 * @param {number[]} place
 * @param {Held} picture
 */
function markOf({ database, coloring, pictured, pictureSize, markRadius }, index, [x, y], picture) {
  const { symbol, color } = coloring.look(coloring.kindOf(index));
  const held = pictured[index] ? picture(index) : null;
  if (held === null) return [markAt(symbol, color, [x, y], markRadius, database.marks.outline)];
  const [radius, side] = [pictureSize / 2, pictureSize * 0.86];
  const line = Math.max(1.5, pictureSize * 0.035);
  return [
    svg("circle", { cx: x, cy: y, r: radius, fill: database.marks.ground }),
    svg("circle", { cx: x, cy: y, r: radius, fill: color, "fill-opacity": 0.16 }),
    svg("circle", { cx: x, cy: y, r: radius - line / 2, fill: "none", stroke: color, "stroke-width": line }),
    svg("image", { x: x - side / 2, y: y - side / 2, width: side, height: side, href: held }),
  ];
}

/**
 * A mark as its own shape.
 * @param {string} symbol
 * @param {string} color
 * @param {number[]} place
 * @param {number} radius
 * @param {string | null} outline
 */
export function markAt(symbol, color, [x, y], radius, outline) {
  return svg("path", {
    d: symbol,
    transform: `translate(${x} ${y}) scale(${radius})`,
    fill: color,
    stroke: outline,
    "stroke-width": outline && 0.6 / radius,
  });
}

/**
 * What colours say: as the page has it, where its reader chose them; else the groups that the marks are of, those that
 * have a name, in rows below the map.
 * @param {MapView} view
 * @param {Held} picture
 */
function legendOf({ scene, database, coloring, width, name, figure }, picture) {
  const own = document.getElementById(figure.dataset.legend ?? "");
  // Within the figure it is drawn with it.
  if (own?.checkVisibility()) return figure.contains(own) ? undefined : snapshot(own, picture);
  const naming = coloring.naming ?? classNaming(database);
  const shown = [...scene.x.keys()].filter((index) => scene.visible(index));
  const groups = [...new Set(shown.map((index) => naming.groupOf(index)))].filter((group) => group >= 0);
  if (name === "hit" || groups.length === 0) return undefined;
  const node = svg("g", { "font-family": "system-ui, sans-serif", "font-size": "12px", fill: "#1c1d1f" });
  let [x, y] = [0, ROW / 2];
  for (const group of groups.sort((one, other) => one - other)) {
    const { symbol, color } = naming.lookOf(group);
    const words = naming.nameOf(group);
    const wide = INDENT + 7.2 * words.length + INDENT;
    if (x > 0 && x + wide > width) [x, y] = [0, y + ROW];
    node.append(markAt(symbol, color, [x + 6, y], 5, null), svg("text", { x: x + INDENT, y: y + 4 }, words));
    x += wide;
  }
  return { node, width, height: y + ROW / 2 };
}
