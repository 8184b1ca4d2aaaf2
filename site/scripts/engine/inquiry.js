// One question the page keeps asking: what it asked last counts, earlier work is cancelled, answers are kept.

import { Cancelled } from "./client.js";

/** @import { Job, Listener } from "./client.js" */

/**
 * How a question stands.
 * @typedef {object} Standing
 * @property {"none" | "working" | "answered" | "stopped" | "failed" | "beyond"} kind
 * @property {number} [progress] of work, from 0 to 1
 * @property {string} [message] of a failure, or why there is no answer
 */

const MOST_KEPT = 60;

export class Inquiry {
  /** @type {Map<string, any>} */
  #answers = new Map();
  /** @type {Job | null} */
  #job = null;

  /** @param {(standing: Standing) => void} tell hears how the question stands */
  constructor(tell) {
    this.tell = tell;
    /** @type {string | null} */
    this.key = null;
  }

  /**
   * Ask. `start` begins the work where no answer is kept, and returns { done, cancel }.
   *
   * `answered` gets the answer, unless another question was asked meanwhile.
   * @param {string} key
   * @param {(report: Listener) => Job} start
   * @param {(answer: any) => void} answered
   */
  async ask(key, start, answered) {
    if (key === this.key && this.#job !== null) return;
    this.#drop();
    this.key = key;
    if (this.#answers.has(key)) {
      answered(this.#answers.get(key));
      this.tell({ kind: "answered" });
      return;
    }
    /** @type {Listener} */
    const report = ({ progress }) => {
      if (this.#job === job) this.tell({ kind: "working", progress });
    };
    const job = start(report);
    this.#job = job;
    this.tell({ kind: "working", progress: 0 });
    const ending = await job.done.then(
      (answer) => ({ answer, error: null }),
      (error) => ({ answer: null, error }),
    );
    if (this.#job !== job) return;
    this.#job = null;
    if (ending.error) {
      this.key = null;
      this.tell(
        ending.error instanceof Cancelled ? { kind: "stopped" } : { kind: "failed", message: ending.error.message },
      );
      return;
    }
    this.know(key, ending.answer);
    answered(ending.answer);
    this.tell({ kind: "answered" });
  }

  /**
   * Nothing is asked any more.
   * @param {string} [message] why there is no answer to what was asked last
   */
  rest(message) {
    this.#drop();
    this.key = null;
    this.tell(message === undefined ? { kind: "none" } : { kind: "beyond", message });
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

  /**
   * Keep an answer that came on another way.
   * @param {string} key
   * @param {any} answer
   */
  know(key, answer) {
    this.#answers.set(key, answer);
    if (this.#answers.size > MOST_KEPT) this.#answers.delete([...this.#answers.keys()][0]);
  }
}
