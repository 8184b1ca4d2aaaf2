// Time the task "score", all its steps in a row.

import { score } from "../site/scripts/engine/scoring.js";

/** Milliseconds by the clock. */
window.timeScore = (parameters) => {
  const start = performance.now();
  const steps = score(window.table, parameters);
  while (!steps.next().done);
  return performance.now() - start;
};
