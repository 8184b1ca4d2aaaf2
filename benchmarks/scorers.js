// Time the task "score" as the worker of a page would run it.

import { score } from "../site/scripts/engine/scoring.js";

/** Milliseconds of each of several runs, and the longest that one step of them took. */
window.timeScore = (parameters, runs) => {
  const times = [];
  let longest = 0;
  for (let run = 0; run < runs; run += 1) {
    const start = performance.now();
    const steps = score(window.table, parameters);
    for (let before = start, done = false; !done; ) {
      done = steps.next().done;
      const now = performance.now();
      if (run > 0) longest = Math.max(longest, now - before);
      before = now;
    }
    times.push(performance.now() - start);
  }
  return { times, longest };
};
