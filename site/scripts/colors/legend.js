// The legend of a map's colours: a ramp for numbers, a line for each look, and a line is a way to select its shapes. And
// the classes in such colours.

import { element, swatch } from "../base/dom.js";
import { grouped, isolated } from "../base/words.js";
import { stripesOf } from "../map/coloring.js";

/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Coloring, Legend, Line } from "../map/coloring.js" */
/** @import { MapValues } from "../map/scene.js" */

/**
 * @param {Coloring | null} coloring
 * @param {State<MapValues & Shared>} state
 */
export function showLegend(coloring, state) {
  const node = document.getElementById("color-legend");
  const legend = coloring?.legend;
  node.hidden = !legend;
  node.replaceChildren();
  if (!coloring || !legend) return;
  node.append(
    element("h2", { dir: "auto" }, coloring.title),
    coloring.note ? element("p", { class: "note" }, coloring.note) : "",
    ...rampOf(legend),
    element(
      "ul",
      {},
      legend.lines.map((line) => element("li", {}, buttonOf(line, state))),
    ),
  );
}

/**
 * @param {Line} line
 * @param {State<MapValues & Shared>} state
 */
function buttonOf({ name, look, shapes }, state) {
  /** @param {number[] | null} pointedShapes */
  const point = (pointedShapes) => () => state.set({ pointedShapes });
  return element(
    "button",
    {
      type: "button",
      title: `Select ${isolated(name)}`,
      onclick: () => state.set({ selection: new Set(shapes), pointedShapes: null }),
      onpointerenter: point(shapes),
      onpointerleave: point(null),
    },
    swatch(look.symbol, look.color),
    element("span", { class: "name", dir: "auto" }, name),
    element("span", { class: "size" }, grouped(shapes.length)),
  );
}

/** @param {Legend} legend */
function rampOf({ ramp }) {
  if (ramp === null || ramp.texts.length === 0) return [];
  const scale = element("span", { class: "ramp", role: "img", "aria-label": "from low to high" });
  scale.style.background = `linear-gradient(to right, ${ramp.colors.join(", ")})`;
  return [
    element(
      "div",
      { class: "scale" },
      scale,
      element(
        "p",
        { class: "ramp-texts" },
        ramp.texts.map((text) => element("span", {}, text)),
      ),
    ),
  ];
}

/**
 * The mark of a class in a list of classes, as it is on maps of these colours: in no colour where these are numbers, and
 * none where symbols say something else too.
 * @param {Database} database
 * @param {Coloring | null} coloring
 * @param {number} group
 */
export function classMark(database, coloring, group) {
  if (coloring !== null && !coloring.ofClasses) return "";
  return swatch(database.symbol(group), coloring === null ? database.color(group) : database.marks.ink);
}

/**
 * Which colours the shapes of a class have, as a strip of them in their order.
 * @param {Database} database
 * @param {Coloring} coloring
 * @param {number} group
 */
export function makeupOf(database, coloring, group) {
  const shapes = [...database.groups.keys()].filter((index) => database.groups[index] === group);
  const strip = element("span", { class: "makeup", role: "img", "aria-label": `${coloring.title} of its shapes` });
  strip.style.background = `linear-gradient(to right, ${stripesOf(coloring, shapes).join(", ")})`;
  return strip;
}
