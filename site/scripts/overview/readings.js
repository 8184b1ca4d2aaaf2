// How to read a map, beside its title. The note of every projection takes its room, so that nothing moves with another.

import { element } from "../base/dom.js";
import { count } from "../base/words.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */
/** @import { MapView } from "../map/map.js" */

/**
 * @param {MapView} view
 * @param {Database} database
 * @param {OverviewState} state
 */
export function tellReading(view, database, state) {
  const pictures = view.name === "thumbnail";
  const notes = database.methods.map(({ note }) => element("span", {}, note, pictures && zoomIn(database.count)));
  const shown = element("span", { class: "shown" }, reading(view, database, state));
  view.figure.querySelector(".reading").replaceChildren(...notes, shown);
}

/**
 * @param {MapView} view
 * @param {Database} database
 * @param {OverviewState} state
 */
function reading(view, database, state) {
  const { name } = view;
  const method = database.methods[state.get("method")];
  if (name === "class") return [method.note];
  if (name === "color") return [method.note];
  if (name === "thumbnail") return [method.note, zoomIn(view.dotted)];
  if (!database.labelled) return ["Without labels there is no neighbourhood hit."];
  const meaning = `Of a shape’s ${method.neighbours} nearest neighbours, this share is of its ${database.data.standIn ? "cluster" : "class"}`;
  const scale = element("span", { class: "ramp", role: "img", "aria-label": "from red to yellow" });
  scale.style.background = `linear-gradient(to right, ${database.marks.hit.join(", ")})`;
  return [
    element("span", { class: "meaning" }, `${meaning}: `),
    element("span", { class: "ends" }, "0 ", scale, " 1"),
    method.sample &&
      element(
        "span",
        { class: "meaning" },
        ` (only of the ${count(method.sample.length, "shape")} that were laid out; the others are grey)`,
      ),
  ];
}

/**
 * What shapes whose pictures have no room ask of a reader.
 * @param {number} dots
 */
function zoomIn(dots) {
  const what = dots === 1 ? "a picture of the dot" : `pictures of the ${count(dots, "dot")}`;
  return dots > 0 && element("span", { class: "on-screen" }, ` Zoom in to see ${what}.`);
}
