// One question the page keeps asking: what it asked last counts, earlier work is cancelled, answers are kept.

import { Cancelled } from "../engine/client.js";

const MOST_KEPT = 60;

export class Inquiry {
  #answers = new Map();
  #job = null;

  /**
   * `tell` hears how the question stands: { kind, progress, message }, where kind is "none", "working", "answered",
   * "stopped" or "failed".
   */
  constructor(tell) {
    this.tell = tell;
    this.key = null;
  }

  /**
   * Ask. `start` begins the work where no answer is kept, and returns { done, cancel }.
   *
   * `answered` gets the answer, unless another question was asked meanwhile.
   */
  async ask(key, start, answered) {
    if (key === this.key && this.#job !== null) return;
    this.#drop();
    this.key = key;
    if (this.#answers.has(key)) {
      this.tell({ kind: "answered" });
      answered(this.#answers.get(key));
      return;
    }
    const report = ({ progress }) => this.#job === job && this.tell({ kind: "working", progress });
    const job = start(report);
    this.#job = job;
    this.tell({ kind: "working", progress: 0 });
    try {
      const answer = await job.done;
      if (this.#job !== job) return;
      this.#job = null;
      this.#keep(key, answer);
      this.tell({ kind: "answered" });
      answered(answer);
    } catch (error) {
      if (this.#job !== job) return;
      this.#job = null;
      this.key = null;
      this.tell(error instanceof Cancelled ? { kind: "stopped" } : { kind: "failed", message: error.message });
    }
  }

  /** Nothing is asked any more. */
  rest() {
    this.#drop();
    this.key = null;
    this.tell({ kind: "none" });
  }

  /** Give up what is being worked on; true if there was such work. */
  stop() {
    if (this.#job === null) return false;
    this.#drop();
    this.key = null;
    this.tell({ kind: "stopped" });
    return true;
  }

  #drop() {
    const job = this.#job;
    this.#job = null;
    job?.cancel();
  }

  #keep(key, answer) {
    this.#answers.set(key, answer);
    if (this.#answers.size > MOST_KEPT) this.#answers.delete(this.#answers.keys().next().value);
  }
}
