// How the worker works: tasks in slices, with messages let in between.
//
// A task is a generator function `(table, parameters)` that yields `{ progress, partial }` every few milliseconds and
// returns its result. It never looks at a clock, so its result does not depend on how its time was cut.

/**
 * A task at work, and when the page last heard of it.
 * @typedef {{ id: number, steps: Steps<any>, reported: number }} Running
 * @typedef {{ id: number, name: string, parameters: { table?: FeatureValues } }} Order
 */

/** @typedef {(table: FeatureValues, parameters: any) => Steps<any>} Task */

/** How long a task runs before messages are let in, in milliseconds. */
const SLICE = 15;

/** The page hears of a task's progress this often, in milliseconds: twice as often as a reader could follow. */
const REPORT = 30;

/** Runs several tasks at once, each a slice in turn, and posts what becomes of them. */
export class TaskLoop {
  /**
   * @param {Record<string, Task>} tasks generator functions by name
   * @param {(message: object) => void} post sends a message to the page
   */
  constructor(tasks, post) {
    this.tasks = tasks;
    this.post = post;
    /** @type {FeatureValues | null} */
    this.table = null;
    /** @type {Running[]} */
    this.running = [];
    // A message to oneself is the one way to give way without the four milliseconds that timers wait at least.
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => this.turn();
    this.continue = () => port2.postMessage(null);
  }

  /**
   * Take a message of the page: the table to work on, a task to run, or one to cancel.
   * @param {{ table?: FeatureValues, run?: Order, cancel?: number }} message
   */
  receive({ table, run, cancel }) {
    if (table) this.table = table;
    if (run) this.begin(run);
    if (cancel !== undefined) this.cancel(cancel);
  }

  /** @param {Order} order */
  begin({ id, name, parameters }) {
    const task = this.tasks[name] ?? unknown(name);
    this.running.push({
      id,
      steps: task(/** @type {FeatureValues} */ (parameters.table ?? this.table), parameters),
      reported: performance.now(),
    });
    if (this.running.length === 1) this.continue();
  }

  /** @param {number} id */
  cancel(id) {
    const place = this.running.findIndex((task) => task.id === id);
    if (place < 0) return;
    const [{ steps }] = this.running.splice(place, 1);
    steps.return(undefined);
  }

  /** One slice of the task whose turn it is. */
  turn() {
    const task = this.running.shift();
    if (!task) return;
    if (this.advance(task)) this.running.push(task);
    if (this.running.length) this.continue();
  }

  /**
   * Whether the task has more to do.
   * @param {Running} task
   */
  advance(task) {
    const { id, steps } = task;
    const start = performance.now();
    try {
      let step;
      do step = steps.next();
      while (!step.done && performance.now() - start < SLICE);
      if (step.done) {
        this.post({ id, result: step.value });
        return false;
      }
      if (performance.now() - task.reported >= REPORT) {
        task.reported = performance.now();
        this.post({ id, report: step.value });
      }
      return true;
    } catch (caught) {
      const error = /** @type {Error} */ (caught);
      this.post({ id, error: { message: error.message, stack: error.stack } });
      return false;
    }
  }
}

/**
 * @param {string} name
 * @returns {Task}
 */
function unknown(name) {
  // biome-ignore lint/correctness/useYield: it fails as tasks do, at its first step
  return function* () {
    throw new Error(`the engine has no task '${name}'`);
  };
}

/**
 * Serve the page that started this worker.
 * @param {Record<string, Task>} tasks
 */
export function serve(tasks) {
  const loop = new TaskLoop(tasks, (message) => postMessage(message));
  self.onmessage = (event) => loop.receive(event.data);
  postMessage({ ready: true });
}
