// The page's side of the engine: start the worker, hand it work, hear of progress, cancel.

/** What a job that was cancelled ends with. */
export class Cancelled extends Error {
  constructor() {
    super("cancelled");
    this.name = "Cancelled";
  }
}

/**
 * Start the engine on a table of features.
 *
 * @param {FeatureValues} table
 * @returns {Promise<Engine>}
 */
export async function startEngine(table) {
  const engine = new Engine(await window.shapeviz.startWorker());
  await engine.ready;
  engine.worker.postMessage({ table });
  return engine;
}

class Engine {
  constructor(worker) {
    this.worker = worker;
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
   * Run a task: "layout", "hit" or "score".
   *
   * @param {string} name
   * @param {object} parameters copied to the worker
   * @param {(report: { progress: number, partial: any }) => void} onProgress called a few dozen times a second at most
   * @returns {{ done: Promise<any>, cancel: () => void }}
   *   done rejects with Cancelled after cancel(), else with the error that ended the task
   */
  run(name, parameters, onProgress = (_) => {}) {
    const id = this.started++;
    const done = new Promise((resolve, reject) => this.jobs.set(id, { resolve, reject, onProgress }));
    this.worker.postMessage({ run: { id, name, parameters } });
    return { done, cancel: () => this.cancel(id) };
  }

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

  receive({ id, report, result, error }) {
    // A cancelled job may have had a message under way.
    if (!this.jobs.has(id)) return;
    if (report) this.jobs.get(id).onProgress(report);
    else if (error) this.settle(id).reject(Object.assign(new Error(error.message), { stack: error.stack }));
    else this.settle(id).resolve(result);
  }

  settle(id) {
    const job = this.jobs.get(id);
    this.jobs.delete(id);
    return job;
  }

  end(reason) {
    for (const id of [...this.jobs.keys()]) this.settle(id).reject(reason());
  }
}
