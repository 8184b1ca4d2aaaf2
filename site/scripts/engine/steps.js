// Tasks made of parts.

/** Run a part of a task, its progress from `low` to `high` of the whole. Returns what the part returns. */
export function* part(steps, low, high) {
  for (let step = steps.next(); ; step = steps.next()) {
    if (step.done) return step.value;
    yield { ...step.value, progress: low + (high - low) * step.value.progress };
  }
}
