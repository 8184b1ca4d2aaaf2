// The Shapes page: all shapes as pictures, to search, filter, group and sort.

import { chunk } from "../chunks.js";
import { Model } from "../model.js";
import { currentTheme, watchTheme } from "../theme.js";

async function main() {
  const model = new Model(await chunk("overview"), currentTheme);
  document.getElementById("live").textContent = `${model.count} shapes`;
  watchTheme(() => {});
  document.documentElement.dataset.ready = "";
}

main();
