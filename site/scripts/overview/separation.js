// Whether the features tell classes apart at all, before the map in view is blamed.

import { element } from "../base/dom.js";
import { count, figure, wholePercent } from "../base/words.js";

/** @import { Database, Method } from "../database/database.js" */

/**
 * @param {Database} database
 * @param {Method} method
 */
export function tellSeparation({ data }, method) {
  const found = data.separation;
  // Of the map of a subset nobody asked what the features of the subset know.
  const map = found?.maps[method.key];
  if (!found || !map) return [];
  return [
    element("h3", {}, "Is it the map, or the features?"),
    element(
      "p",
      { class: "headline" },
      element("output", { class: "share" }, wholePercent(found.ofAll)),
      element("span", { class: "of" }, "by features"),
      element(
        "span",
        { class: "beside" },
        element("b", {}, wholePercent(map.ofAll)),
        " on this map",
        element("br"),
        element("b", {}, wholePercent(found.chance)),
        " with labels dealt at random",
      ),
    ),
    element(
      "p",
      {},
      "For so many shapes the nearest one is of the same class. ",
      element("b", {}, map.verdict),
      map.lost && lostOf(map.lost),
      found.hardest && hardestOf(found.hardest),
    ),
    element(
      "p",
      { class: "quiet" },
      `By features, the ${count(found.neighbours, "nearest neighbour")} elect the right class of ${wholePercent(found.elected)}, and the silhouette of the classes is ${signed(found.silhouette)} (with labels at random ${signed(found.silhouetteByChance)}). `,
      element("a", { href: "features.html#separation" }, "Each class"),
    ),
  ];
}

/** @param {number} value */
function signed(value) {
  return figure(value).replace("-", "−");
}

/** @param {Chunk.ClassCounts} counts */
function lostOf({ name, shapes, features, map }) {
  return [
    " It does worst by ",
    element("bdi", {}, name),
    `: the nearest shape is of this class for ${features} of its ${count(shapes, "shape")} by features, but for only ${map} on this map.`,
  ];
}

/** @param {Chunk.ClassCounts} counts */
function hardestOf({ name, shapes, features, mistaken }) {
  return [
    " Hardest to tell by features is ",
    element("bdi", {}, name),
    `: the nearest shape is of this class for ${features || "none"} of its ${count(shapes, "shape")}`,
    mistaken !== null && [
      `; ${features > 0 ? "for the others " : ""}it is most often of `,
      element("bdi", {}, mistaken),
    ],
    ".",
  ];
}
