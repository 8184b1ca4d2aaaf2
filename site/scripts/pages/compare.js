// The Compare page: what sets two groups apart, what they share, outliers, and classes that are alike.

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
