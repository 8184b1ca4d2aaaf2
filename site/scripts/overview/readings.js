// How to read a map, beside its title. The note of every projection takes its room, so that nothing moves with another.

import { element } from "../base/dom.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database } from "../database/database.js" */

/**
 * @param {HTMLElement} figure
 * @param {Database} database
 * @param {OverviewState} state
 */
export function tellReading(figure, database, state) {
  const pictures = figure.dataset.view === "thumbnail";
  const notes = database.methods.map(({ note }) => element("span", {}, note, pictures && zoomIn()));
  const shown = element("span", { class: "shown" }, reading(figure.dataset.view ?? "", database, state));
  figure.querySelector(".reading").replaceChildren(...notes, shown);
}

/**
 * @param {string} name
 * @param {Database} database
 * @param {OverviewState} state
 */
function reading(name, database, state) {
  const method = database.methods[state.get("method")];
  if (name === "class") return [method.note];
  if (name === "color") return [method.note];
  if (name === "thumbnail") return [method.note, zoomIn()];
  if (!database.labelled) return ["Without labels there is no neighbourhood hit."];
  const meaning = `Of a shape’s ${method.neighbours} nearest neighbours, this share is of its ${database.data.standIn ? "cluster" : "class"}`;
  const scale = element("span", { class: "ramp", role: "img", "aria-label": "from red to yellow" });
  scale.style.background = `linear-gradient(to right, ${database.marks.hit.join(", ")})`;
  return [element("span", { class: "meaning" }, `${meaning}: `), element("span", { class: "ends" }, "0 ", scale, " 1")];
}

/** What pictures that have no room ask of a reader. */
function zoomIn() {
  return element("span", { class: "on-screen" }, " Zoom in to see pictures of the dots.");
}
