// Tasks made of parts.

/**
 * Run a part of a task, its progress from `low` to `high` of the whole. Returns what the part returns.
 * @template Result
 * @param {Steps<Result>} steps
 * @param {number} low
 * @param {number} high
 * @returns {Steps<Result>}
 */
export function* part(steps, low, high) {
  for (let step = steps.next(); ; step = steps.next()) {
    if (step.done === true) return step.value;
    yield { ...step.value, progress: low + (high - low) * step.value.progress };
  }
}
