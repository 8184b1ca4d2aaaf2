// The map of a subset of the features where the search laid out a sample: all other shapes stand beside those that they are
// most like.

import { chunk } from "../base/chunks.js";
import { element } from "../base/dom.js";
import { count } from "../base/words.js";
import { numbersOfFeatures } from "../database/levels.js";
import { startEngine } from "../engine/client.js";

/** @import { Database, ShapeMap } from "../database/database.js" */

/**
 * @param {Database} database
 * @param {ShapeMap} map of the shapes that the search laid out
 * @param {number[]} rows those
 * @returns {Promise<ShapeMap>}
 */
export async function withOthers(database, map, rows) {
  const shapes = Int32Array.from(rows).sort();
  const others = Int32Array.from(database.groups.keys()).filter((shape) => Number.isNaN(map.x[shape]));
  const { features } = await chunk("workbench");
  const numbers = await numbersOfFeatures(
    [...features.keys()].filter((feature) => map.features.includes(features[feature].name)),
    database.count,
  );
  const xy = Float64Array.from(
    { length: 2 * shapes.length },
    (_, place) => (place % 2 === 0 ? map.x : map.y)[shapes[place >> 1]],
  );
  const placed = await watched(others.length, async (report) => {
    const engine = await startEngine();
    const { done } = engine.run("beside", { compared: { numbers }, shapes, xy, others }, report);
    return done.finally(() => engine.close());
  });
  const [x, y] = [Float64Array.from(map.x), Float64Array.from(map.y)];
  for (const [place, shape] of others.entries()) [x[shape], y[shape]] = placed.xy.subarray(2 * place, 2 * place + 2);
  return {
    ...map,
    x,
    y,
    sample: shapes,
    note: `${map.note} Laid out were ${count(shapes.length, "shape")}, of which the figures are too; each of the others stands beside the one of these that it is most like.`,
  };
}

/**
 * Work on the places of so many shapes, which the map tells of meanwhile: of very many it takes seconds.
 * @template T
 * @param {number} placed
 * @param {(report: (state: { progress: number }) => void) => Promise<T>} work
 */
async function watched(placed, work) {
  const bar = element("progress", { max: 1, "aria-label": "Progress" });
  const words = `The search laid out a sample. Finding a place for each of the ${count(placed, "other shape")}`;
  const told = element("p", { class: "placing", role: "status" }, words, bar);
  document.querySelector("figure[data-slot=large] .surface").append(told);
  try {
    return await work(({ progress }) => {
      bar.value = progress;
    });
  } finally {
    told.remove();
  }
}
