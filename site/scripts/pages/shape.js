// The page of one shape: what it is, where it lies, and which shapes are most like it.

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
