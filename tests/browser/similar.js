// Similar shapes as the pages of a site find them, for tests.

import { Bins } from "../../site/scripts/database/bins.js";
import { chunk } from "../../site/scripts/base/chunks.js";
import { Similarity } from "../../site/scripts/database/similarity.js";

/** The answers to cases of similar_cases.py, and the typical distance by each of their choices. */
async function answer(cases) {
  const bins = new Bins(await chunk("workbench"), await chunk("bins"));
  const similarity = new Similarity(bins);
  const features = bins.features.map(({ name }) => name);
  return cases.map(({ row, features: named, bins: chosen }) => {
    const choice = chosen
      ? { columns: chosen.map((name) => bins.names.indexOf(name)) }
      : { features: (named ?? features).map((name) => features.indexOf(name)) };
    return { found: similarity.rank(row, choice, bins.rows), typical: similarity.typical(choice) };
  });
}

window.similar = { answer };
