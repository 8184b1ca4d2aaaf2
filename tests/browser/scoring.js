// What the tests of the scorers need: the task itself, without a worker around it.

import { score } from "../../site/scripts/engine/scoring.js";

/** Take all steps of the task; returns how far each said it was, and the scores. */
window.walkScore = ({ values, rows, columns }, parameters) => {
  const blocks = new Int32Array(columns);
  const table = { steps: Float32Array.from(values), most: 1, low: [0], high: [1], rows, columns, blocks };
  const steps = score(table, parameters);
  const progress = [];
  let step = steps.next();
  while (!step.done) {
    progress.push(step.value.progress);
    step = steps.next();
  }
  return { progress, scores: [...step.value.scores] };
};
