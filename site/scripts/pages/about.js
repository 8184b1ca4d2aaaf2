// The About page is plain HTML; scripts serve the theme button, what is copied, and the search among the meshes.

import { watchCopying } from "../about/copying.js";
import { watchMeshes } from "../about/meshes.js";
import { openPage } from "../base/page.js";
import { carryView } from "../tray/carry.js";

async function main() {
  const { written, ready } = await openPage();
  watchCopying();
  watchMeshes();
  carryView(written);
  ready();
}

main();
