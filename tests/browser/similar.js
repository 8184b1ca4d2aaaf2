// Similar shapes as the pages of a site find them, for tests.

import { loadAllBins } from "../../site/scripts/database/level-bins.js";
import { similarityOf } from "../../site/scripts/database/level-similarity.js";

/** The answers to cases of similar_cases.py, and the typical distance by each of their choices. */
async function answer(cases) {
  const bins = await loadAllBins();
  const similarity = similarityOf(bins);
  const features = bins.features.map(({ name }) => name);
  const answers = cases.map(async ({ row, features: named, bins: chosen, found }) => {
    const choice = chosen
      ? { columns: chosen.map((name) => bins.names.indexOf(name)) }
      : { features: (named ?? features).map((name) => features.indexOf(name)) };
    return { found: await similarity.rank(row, choice, found.length), typical: similarity.typical(choice) };
  });
  return Promise.all(answers);
}

window.similar = { answer };
