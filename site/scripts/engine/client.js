// The page's side of the engine: start the worker, hand it work, hear of progress, cancel.

/**
 * What a task tells of itself: how far it is, from 0 to 1, and what there is to see already.
 * @typedef {{ progress: number, partial?: any }} Progress
 * @typedef {(report: Progress) => void} Listener
 * @typedef {{ resolve: (result: any) => void, reject: (error: Error) => void, onProgress: Listener }} Waiting
 *
 * A task at work; `done` rejects with Cancelled after `cancel()`, else with the error that ended the task.
 * @template [Result=any]
 * @typedef {{ done: Promise<Result>, cancel: () => void }} Job
 */

/** What a job that was cancelled ends with. */
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
    this.name = "Cancelled";
  }
}

/** Tasks that need no table. */
const WITHOUT_TABLE = new Set(["hit", "contrast"]);

/**
 * Start the engine. What it works on is made for the first task that needs it, and is the engine's from then on: it would
 * be many megabytes for who only looks, and a copy as many again.
 *
 * @param {() => FeatureValues | null} [makeTable] where tasks do not bring their own
 * @returns {Promise<Engine>}
 */
export async function startEngine(makeTable = () => null) {
  const start = /** @type {() => Promise<Worker>} */ (window.shapeviz.startWorker);
  const engine = new Engine(await start(), makeTable);
  await engine.ready;
  return engine;
}

export class Engine {
  /**
   * @param {Worker} worker
   * @param {() => FeatureValues | null} makeTable
   */
  constructor(worker, makeTable) {
    this.worker = worker;
    /** @type {(() => FeatureValues | null) | null} null once it was asked */
    this.makeTable = makeTable;
    /** @type {Map<number, Waiting>} */
    this.jobs = new Map();
    this.started = 0;
    this.ready = /** @type {Promise<void>} */ (
      new Promise((resolve, reject) => {
        worker.onmessage = ({ data }) => (data.ready ? resolve() : this.receive(data));
        worker.onerror = (event) => {
          const error = new Error(`the engine failed: ${event.message ?? "its worker could not be started"}`);
          reject(error);
          this.end(() => error);
        };
      })
    );
  }

  /**
   * Run a task: "layout", "hit", "faith" or "score".
   *
   * @param {string} name
   * @param {{ table?: FeatureValues | null, [name: string]: unknown }} parameters copied to the worker; a table that a task
   *   brings along goes there; null where this one needs none
   * @param {Listener} onProgress called a few dozen times a second at most
   * @param {{ buffer: ArrayBufferLike }[]} moved what else of the parameters goes there
   * @returns {Job}
   */
  run(name, parameters, onProgress = (_) => {}, moved = []) {
    const { table } = parameters;
    if (!WITHOUT_TABLE.has(name) && table === undefined) this.#giveTable();
    const id = this.started++;
    const done = new Promise((resolve, reject) => this.jobs.set(id, { resolve, reject, onProgress }));
    const all = table ? [...moved, table.steps] : moved;
    const buffers = all.map(({ buffer }) => /** @type {ArrayBuffer} */ (buffer));
    this.worker.postMessage({ run: { id, name, parameters } }, buffers);
    return { done, cancel: () => this.cancel(id) };
  }

  #giveTable() {
    const table = this.makeTable?.() ?? null;
    this.makeTable = null;
    if (table !== null) this.worker.postMessage({ table }, [table.steps.buffer]);
  }

  /** @param {number} id */
  cancel(id) {
    if (!this.jobs.has(id)) return;
    this.worker.postMessage({ cancel: id });
    this.settle(id).reject(new Cancelled());
  }

  /** Stop the worker; what it was working on is cancelled. */
  close() {
    this.worker.terminate();
    this.end(() => new Cancelled());
  }

  /** @param {{ id: number, report?: Progress, result?: any, error?: { message: string, stack?: string } }} message */
  receive({ id, report, result, error }) {
    // A cancelled job may have had a message under way.
    if (!this.jobs.has(id)) return;
    if (report) this.jobs.get(id)?.onProgress(report);
    else if (error) this.settle(id).reject(Object.assign(new Error(error.message), { stack: error.stack }));
    else this.settle(id).resolve(result);
  }

  /**
   * @param {number} id
   * @returns {Waiting}
   */
  settle(id) {
    const job = /** @type {Waiting} */ (this.jobs.get(id));
    this.jobs.delete(id);
    return job;
  }

  /** @param {() => Error} reason */
  end(reason) {
    for (const id of [...this.jobs.keys()]) this.settle(id).reject(reason());
  }
}
