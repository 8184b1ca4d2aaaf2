// The page of one shape: what it is, where it lies, and which shapes are most like it.

import { Pointing } from "../bins-page/pointing.js";
import { chunk } from "../chunks.js";
import { Model } from "../model.js";
import { Facts } from "../shape-page/facts.js";
import { goToShape, readShapeAddress, writeShapeAddress } from "../shape-page/address.js";
import { Heading } from "../shape-page/heading.js";
import { ShapeLinks } from "../shape-page/links.js";
import { Portrait } from "../shape-page/portrait.js";
import { Surroundings } from "../shape-page/surroundings.js";
import { State } from "../state.js";
import { currentTheme, watchTheme } from "../theme.js";

async function main() {
  const model = new Model(await chunk("overview"), currentTheme);
  const page = document.getElementById("content");
  const live = document.getElementById("live");
  const state = new State({ ...readShapeAddress(model), theme: currentTheme() });
  let opened = false;
  const links = new ShapeLinks(model, state, { opened: () => (opened = true) });
  const go = (shape) => {
    opened = true;
    goToShape(model, state, shape);
  };
  const views = [
    new Heading(model, state, { links, go, site: page.dataset.site }),
    new Portrait(model, state, { models: page.dataset.models !== undefined }),
    new Facts(model, state),
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
    } else if (["method", "features", "bins", "bin", "selection"].some((name) => changed.has(name))) writeShapeAddress(model, state);
  });
  window.addEventListener("hashchange", () => state.set(readShapeAddress(model)));
  watchTheme(() => state.set({ theme: currentTheme() }));
  document.documentElement.dataset.ready = "";
}

main();
