// The page of one shape: what it is, where it lies, and which shapes are most like it.

import { Pointing } from "../map/pointing.js";
import { Bins } from "../database/bins.js";
import { carrySelection } from "../tray/carry.js";
import { chunk } from "../base/chunks.js";
import { Model } from "../database/model.js";
import { Similarity } from "../shape/similar.js";
import { Facts } from "../shape/facts.js";
import { goToShape, readShapeAddress, writeShapeAddress } from "../addresses/shape.js";
import { Comparison } from "../shape/comparison.js";
import { Heading } from "../shape/heading.js";
import { Histograms } from "../shape/histograms.js";
import { kind } from "../shape/kind.js";
import { ShapeLinks } from "../shape/links.js";
import { Portrait } from "../shape/portrait.js";
import { shapeTables } from "../shape/tables.js";
import { SimilarShapes } from "../shape/similar-shapes.js";
import { Spread } from "../shape/spread.js";
import { Surroundings } from "../shape/surroundings.js";
import { ValueCard } from "../shape/value-card.js";
import { State } from "../base/state.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, watchTheme } from "../base/theme.js";
import { Tray } from "../tray/tray.js";
import { grouped } from "../base/words.js";

/** How far below the window the features may be when they are loaded. */
const AHEAD = "200px";

async function main() {
  const model = new Model(await chunk("overview"), currentTheme);
  const page = document.getElementById("content");
  const live = document.getElementById("live");
  const state = new State({ ...readShapeAddress(model), brushing: false, theme: currentTheme() });
  carrySelection(model, state);
  let opened = false;
  const links = new ShapeLinks(model, state, { opened: () => (opened = true) });
  const go = (shape) => {
    opened = true;
    goToShape(model, state, shape);
  };
  const portrait = new Portrait(model, state, { models: page.dataset.models !== undefined });
  const facts = new Facts(model, state, { links });
  const views = [
    new Heading(model, state, { links, go, site: page.dataset.site }),
    portrait,
    facts,
    new Surroundings(model, state, { links, pointing: new Pointing(model), go }),
  ];
  for (const view of views) view.render();
  state.listen((changed) => {
    if (changed.has("shape")) {
      live.textContent = state.get("shape") === null ? "No such shape" : model.names[state.get("shape")];
      // The browser's own way back also finds the place on the page again.
      if (opened) {
        window.scrollTo(0, 0);
        page.focus({ preventScroll: true });
      }
      opened = false;
    } else if (["method", "features", "bins", "bin", "parts", "selection"].some((name) => changed.has(name))) writeShapeAddress(model, state);
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented && !document.querySelector("dialog[open]")) state.set({ selection: new Set() });
  });
  window.addEventListener("hashchange", () => state.set(readShapeAddress(model)));
  watchTheme(() => state.set({ theme: currentTheme() }));
  new Tray(model, state, { open: go });
  let byFeatures = { similar: null, histograms: null };
  watchTables(() => shapeTables(model, state, { facts, ...byFeatures }));
  const load = async () => {
    byFeatures = await showFeatures(model, state, { links, portrait });
  };
  // A bin that the address names is to be seen at once.
  if (state.get("bin") !== null) load();
  else whenSeen(document.getElementById("by-features"), load);
  document.documentElement.dataset.ready = "";
}

/** The features of all shapes are by far the largest data of a site: they come when a reader gets to them. */
function whenSeen(node, then) {
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

async function showFeatures(model, state, { links, portrait }) {
  const section = document.getElementById("by-features");
  const waiting = document.getElementById("waiting");
  waiting.textContent = model.count === 1 ? "Reading its features …" : `Reading the features of all ${grouped(model.count)} shapes …`;
  const [data, bytes, selection] = await Promise.all(["workbench", "bins", "selection"].map(chunk));
  const bins = new Bins(data, bytes);
  const comparison = new Comparison(data, selection.path.at(-1)?.bins ?? null, state);
  const histograms = new Histograms(model, bins, state, { spread: new Spread(model, bins), dimensions: selection.dimensions, card: new ValueCard(bins, kind(model)) });
  const similar = new SimilarShapes(model, bins, state, { links, comparison, similarity: new Similarity(bins) });
  waiting.hidden = true;
  section.removeAttribute("aria-busy");
  document.getElementById("featured").hidden = false;
  for (const view of [similar, histograms]) view.render();
  portrait.know(bins, selection, comparison);
  return { similar, histograms };
}

main();
