// The Bins page (paper, 4.4 and Fig. 6, 7, 8): the few bins that separate a class, or all, and how they look on shapes.

import { BinCard } from "../bins-kit/bin-card.js";
import { Bins } from "../database/bins.js";
import { readBinsAddress, workbenchAddress, writeBinsAddress } from "../addresses/bins.js";
import { BinChips } from "../bins/bin-chip.js";
import { binsTables } from "../bins/tables.js";
import { chooseSet, ClassCards } from "../bins/class-cards.js";
import { Look } from "../bins-kit/look.js";
import { PathPlayer } from "../bins/path-player.js";
import { Pointing } from "../map/pointing.js";
import { Turntable } from "../bins/turntable.js";
import { carrySelection } from "../tray/carry.js";
import { chunk } from "../base/chunks.js";
import { calm } from "../base/dom.js";
import { Model } from "../database/model.js";
import { State } from "../base/state.js";
import { watchTables } from "../base/tables.js";
import { currentTheme, watchTheme } from "../base/theme.js";
import { Tray } from "../tray/tray.js";

async function main() {
  const [overview, selection, data, bytes] = await Promise.all(["overview", "selection", "workbench", "bins"].map(chunk));
  const bins = new Bins(data, bytes);
  const model = new Model(overview, currentTheme);
  const live = document.getElementById("live");
  const announce = (text) => {
    live.textContent = text;
  };
  const first = firstBin(selection);
  const state = new State({ ...readBinsAddress(model, bins, selection, first), brushing: false, theme: currentTheme() });
  const card = new BinCard(bins, model);
  const chips = new BinChips(bins, card, state, {
    look: (bin, group) => {
      card.hide();
      state.set({ bin, group });
      goToLook();
    },
  });
  const pointing = new Pointing(model);
  const choose = (shape) => {
    state.set({ shape });
    goToLook();
  };
  const open = (columns) => workbenchAddress(columns, data.features);
  if (selection.minimal.length > 0) new ClassCards(model, selection, state, chips, { open }).render();
  if (selection.path.length > 0) new PathPlayer(model, selection, bins, state, chips, { open, pointing, choose, announce }).start();
  new Look(model, bins, selection, state, card).render();
  new Turntable(model, bins, selection, state, { pointing, announce }).start();
  new Tray(model, state, { open: choose });
  carrySelection(model, state);
  watchTables(() => binsTables(model, bins, selection, state, card));
  document.querySelector(".lead a")?.addEventListener("click", (event) => {
    // The address holds the state of the view, not a place on the page.
    event.preventDefault();
    goToLook();
  });
  const write = () => writeBinsAddress(model, bins, selection, state, first);
  state.listen((changed) => {
    if (["size", "step", "bin", "group", "shape", "reading"].some((name) => changed.has(name))) write();
    if (changed.has("selection")) {
      clearTimeout(main.writing);
      main.writing = setTimeout(write, 250);
    }
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented && !document.querySelector("dialog[open]")) state.set({ selection: new Set() });
  });
  window.addEventListener("hashchange", () => state.set(readBinsAddress(model, bins, selection, first)));
  watchTheme(() => state.set({ theme: currentTheme() }));
  document.documentElement.dataset.ready = "";
}

/** The bin to look at first, and its class: one that separates a class alone, if any does, the best of these. */
function firstBin({ minimal }) {
  const found = minimal.map((separated) => ({ group: separated.group, highest: separated.highest, ...chooseSet(separated, "fewest") }));
  if (found.length === 0) return { bin: 0, group: null };
  const best = found.reduce((a, b) => (b.bins.length - a.bins.length || a.nh / (a.highest || 1) - b.nh / (b.highest || 1)) < 0 ? b : a);
  return { bin: best.bins[0], group: best.group };
}

function goToLook() {
  const look = document.getElementById("look");
  look.focus({ preventScroll: true });
  look.scrollIntoView({ behavior: calm() ? "instant" : "smooth", block: "start" });
}

main();
