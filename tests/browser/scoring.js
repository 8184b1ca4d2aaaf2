// What the tests of the scorers need: the task itself, without a worker around it.

import { score } from "../../site/scripts/engine/scoring.js";

/** Take all steps of the task; returns how far each said it was, and the scores. */
window.walkScore = ({ values, rows, columns }, parameters) => {
  const steps = score({ values: Float32Array.from(values), rows, columns }, parameters);
  const progress = [];
  let step = steps.next();
  while (!step.done) {
    progress.push(step.value.progress);
    step = steps.next();
  }
  return { progress, scores: [...step.value.scores] };
};
