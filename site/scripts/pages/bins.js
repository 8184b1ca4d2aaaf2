// The Bins page (paper, 4.4 and Fig. 6, 7, 8): the few bins that separate a class, or all, and how they look on shapes.

import { readBinsAddress, workbenchAddress, writeBinsAddress } from "../addresses/bins.js";
import { chunks } from "../base/chunks.js";
import { calm } from "../base/dom.js";
import { delayed, openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { BinCard } from "../bins-kit/bin-card.js";
import { Look } from "../bins-kit/look.js";
import { BinChips } from "../bins/bin-chip.js";
import { chooseSet, ClassCards } from "../bins/class-cards.js";
import { PathPlayer } from "../bins/path-player.js";
import { binsTables } from "../bins/tables.js";
import { Turntable } from "../bins/turntable.js";
import { Bins } from "../database/bins.js";
import { Database } from "../database/database.js";
import { Pointing } from "../map/pointing.js";
import { carrySelection } from "../tray/carry.js";
import { clearOnEscape, Tray } from "../tray/tray.js";

async function main() {
  const [overview, selection, data, bytes] = await chunks("overview", "selection", "workbench", "bins");
  const bins = new Bins(data, bytes);
  const database = new Database(overview, currentTheme);
  const first = firstBin(selection);
  const { state, announce, ready } = await openPage({ read: () => readBinsAddress(database, bins, selection, first) });
  const card = new BinCard(bins, database);
  const chips = new BinChips(bins, card, state, {
    look: (bin, group) => {
      card.hide();
      state.set({ bin, group });
      goToLook();
    },
  });
  const pointing = new Pointing(database);
  const choose = (shape) => {
    state.set({ shape });
    goToLook();
  };
  const open = (columns) => workbenchAddress(columns, data.features);
  if (selection.minimal.length > 0) new ClassCards(database, selection, state, chips, { open }).render();
  if (selection.path.length > 0)
    new PathPlayer(database, selection, bins, state, chips, { open, pointing, choose, announce }).start();
  new Look(database, bins, selection, state, card).render();
  new Turntable(database, bins, selection, state, { pointing, announce }).start();
  new Tray(database, state, { open: choose });
  carrySelection(database, state);
  watchTables(() => binsTables(database, bins, selection, state, card));
  document.querySelector(".lead a")?.addEventListener("click", (event) => {
    // The address holds the state of the view, not a place on the page.
    event.preventDefault();
    goToLook();
  });
  const write = () => writeBinsAddress(database, bins, selection, state, first);
  const later = delayed(write);
  state.listen((changed) => {
    if (["size", "step", "bin", "group", "shape", "reading"].some((name) => changed.has(name))) write();
    if (changed.has("selection")) later();
  });
  clearOnEscape(state);
  ready();
}

/** The bin to look at first, and its class: one that separates a class alone, if any does, the best of these. */
function firstBin({ minimal }) {
  const found = minimal.map((separated) => ({
    group: separated.group,
    highest: separated.highest,
    ...chooseSet(separated, "fewest"),
  }));
  if (found.length === 0) return { bin: 0, group: null };
  const best = found.reduce((a, b) =>
    (b.bins.length - a.bins.length || a.nh / (a.highest || 1) - b.nh / (b.highest || 1)) < 0 ? b : a,
  );
  return { bin: best.bins[0], group: best.group };
}

function goToLook() {
  const look = document.getElementById("look");
  look.focus({ preventScroll: true });
  look.scrollIntoView({ behavior: calm() ? "instant" : "smooth", block: "start" });
}

main();
