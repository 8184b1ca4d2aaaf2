// The Bins page (paper, 4.4 and Fig. 6, 7, 8): the few bins that separate a class, or all, and how they look on shapes.

import { binsAddress, workbenchAddress } from "../addresses/bins.js";
import { chunks } from "../base/chunks.js";
import { openPage } from "../base/page.js";
import { watchTables } from "../base/tables.js";
import { currentTheme } from "../base/theme.js";
import { BinCard } from "../bins-kit/bin-card.js";
import { Look } from "../bins-kit/look.js";
import { BinChips } from "../bins/bin-chip.js";
import { ClassCards, firstBin } from "../bins/class-cards.js";
import { goToLook, watchLookLink } from "../bins/look-section.js";
import { PathPlayer } from "../bins/path-player.js";
import { binsTables } from "../bins/tables.js";
import { Turntable } from "../bins/turntable.js";
import { loadBins } from "../database/bins.js";
import { Database } from "../database/database.js";
import { Pointing } from "../map/pointing.js";
import { carryView } from "../tray/carry.js";
import { clearOnEscape, Tray } from "../tray/tray.js";

async function main() {
  const [overview, selection] = await chunks("overview", "selection");
  const bins = await loadBins();
  const database = new Database(overview, currentTheme);
  const { state, written, announce, ready } = await openPage({
    address: binsAddress(database, bins, selection, firstBin(selection, database, bins)),
  });
  const card = new BinCard(bins, database);
  const chips = new BinChips(bins, card, state, {
    look: (bin, group) => {
      card.hide();
      state.set({ bin, group });
      goToLook();
    },
  });
  const pointing = new Pointing(database);
  /** @param {number} shape */
  const choose = (shape) => {
    state.set({ shape });
    goToLook();
  };
  /** @param {number[]} columns */
  const open = (columns) => workbenchAddress(columns, bins.features);
  if (selection.minimal.length > 0) new ClassCards(database, selection, state, chips, { open }).render();
  if (selection.path.length > 0)
    new PathPlayer(database, selection, bins, state, chips, { open, pointing, choose, announce }).start();
  new Look(database, bins, selection, state, card).render();
  new Turntable(database, bins, selection, state, { pointing, announce }).start();
  new Tray(database, state, { open: choose });
  carryView(written);
  watchTables(() => binsTables(database, bins, selection, state, card));
  watchLookLink();
  clearOnEscape(state);
  ready();
}

main();
