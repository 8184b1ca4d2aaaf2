// How a piece of work stands: after a moment a bar of progress and a way to stop it, and what went wrong.

import { element } from "../base/dom.js";

/** @import { Standing } from "../engine/inquiry.js" */

/** What is done sooner shows no progress. */
const PATIENCE = 300;

export class StatusLine {
  /** @type {number | undefined} */
  #waiting;

  /**
   * @param {Found} node
   * @param {{ again: () => void, stop: () => void }} ways
   */
  constructor(node, { again, stop }) {
    this.node = node;
    this.bar = element("progress", { max: 1, "aria-label": "Progress" });
    this.working = [
      this.bar,
      element("button", { type: "button", class: "plain", title: "Stop (Escape)", onclick: stop }, "Stop"),
    ];
    /** @param {string} words */
    this.again = (words) => element("button", { type: "button", class: "plain", onclick: again }, words);
  }

  /** @param {number} progress of work, from 0 to 1 */
  move(progress) {
    this.bar.value = progress;
  }

  /** @param {Standing} standing */
  show({ kind, message }) {
    if (kind === "working") {
      this.#waiting ??= setTimeout(() => this.#put(...this.working), PATIENCE);
      return;
    }
    clearTimeout(this.#waiting);
    this.#waiting = undefined;
    if (kind === "stopped") this.#put("Stopped.", this.again("Continue"));
    else if (kind === "failed")
      this.#put(element("span", { role: "alert" }, `That did not work: ${message}`), this.again("Try again"));
    else if (kind === "beyond") this.#put(element("span", { role: "status" }, message));
    else this.#put();
  }

  /** @param {...(string | HTMLButtonElement | HTMLSpanElement)} children */
  #put(...children) {
    this.node.hidden = children.length === 0;
    this.node.replaceChildren(...children);
  }
}
