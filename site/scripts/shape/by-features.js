// What is known of a shape by its features: how it differs, and which shapes are like it.

import { chunk } from "../base/chunks.js";
import { grouped } from "../base/words.js";
import { LevelBins, loadAllBins } from "../database/level-bins.js";
import { similarityOf } from "../database/level-similarity.js";
import { Comparison } from "./comparison.js";
import { Histograms } from "./histograms.js";
import { LevelSpread } from "./level-spread.js";
import { kind } from "../database/kind.js";
import { SideBySide } from "./side-by-side.js";
import { SimilarShapes } from "./similar-shapes.js";
import { Spread } from "./spread.js";
import { ValueCard } from "./value-card.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Database } from "../database/database.js" */
/** @import { ShapeLinks } from "./links.js" */
/** @import { Portrait } from "./portrait.js" */

/** How far below the window the features may be when they are loaded. */
const AHEAD = "200px";

/**
 * The features of all shapes are by far the largest data of a site: they come when a reader gets to them.
 * @param {Found} node
 * @param {() => Promise<void>} then
 */
export function whenSeen(node, then) {
  const observer = new IntersectionObserver(
    ([{ isIntersecting }]) => {
      if (!isIntersecting) return;
      observer.disconnect();
      then();
    },
    { rootMargin: AHEAD },
  );
  observer.observe(node);
}

/**
 * @param {Database} database
 * @param {ShapeState} state
 * @param {{ links: ShapeLinks, portrait: Portrait }} parts
 */
export async function showFeatures(database, state, { links, portrait }) {
  const section = document.getElementById("by-features");
  const waiting = document.getElementById("waiting");
  waiting.textContent =
    database.count === 1 ? "Reading its features …" : `Reading the features of all ${grouped(database.count)} shapes …`;
  const [data, bins, selection] = await Promise.all([chunk("workbench"), loadAllBins(), chunk("selection")]);
  const { related } = await database.details(state.get("shape") ?? 0);
  const comparison = new Comparison(data, selection.path.at(-1)?.bins ?? null, related !== null, state);
  const histograms = new Histograms(database, bins, state, {
    spread: bins instanceof LevelBins ? new LevelSpread(database, bins) : new Spread(database, bins),
    dimensions: selection.dimensions,
    card: new ValueCard(bins, kind(database)),
  });
  const similarity = similarityOf(bins);
  const known = { database, bins, state, links, comparison, similarity };
  const similar = new SimilarShapes(known);
  const beside = new SideBySide(known, selection);
  waiting.hidden = true;
  section.removeAttribute("aria-busy");
  document.getElementById("featured").hidden = false;
  await Promise.all([similar, beside, histograms].map((view) => view.render()));
  portrait.know(bins, selection, comparison);
  return { similar, beside, histograms };
}
