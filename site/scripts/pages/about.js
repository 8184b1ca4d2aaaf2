// The About page is plain HTML; scripts serve the theme button, what is copied, and the search among the meshes.

import { watchCopying } from "../about/copying.js";
import { watchMeshes } from "../about/meshes.js";
import { openPage } from "../base/page.js";
import { carryAddress } from "../tray/carry.js";

async function main() {
  const { ready } = await openPage();
  watchCopying();
  watchMeshes();
  carryAddress();
  ready();
}

main();
