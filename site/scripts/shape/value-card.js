// What a bin says of one shape, beside the bar that is pointed at.

import { element } from "../base/dom.js";
import { binName } from "../bins-kit/bin-name.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Told } from "./histograms.js" */

const GAP = 8;

export class ValueCard {
  /**
   * `kind` is what the groups are, a class or a cluster.
   * @param {Bins} bins
   * @param {string} kind
   */
  constructor(bins, kind) {
    this.bins = bins;
    this.kind = kind;
    this.node = element("div", { class: "card value-card", hidden: true });
    document.getElementById("content").append(this.node);
    window.addEventListener("scroll", () => this.hide(), { passive: true });
  }

  /**
   * @param {number} column
   * @param {Told} told
   * @param {Element} bar beside which it stands
   */
  show(column, { own, fellows, all, rank }, bar) {
    const { bins, node } = this;
    /**
     * @param {string} name
     * @param {string | null} value
     */
    const row = (name, value) => value !== null && [element("dt", {}, name), element("dd", {}, value)];
    node.replaceChildren(
      element("p", { class: "name" }, binName(bins, column)),
      element("p", {}, bins.sentence(column)),
      element(
        "dl",
        {},
        row("this shape", own),
        row(`half of its ${this.kind}`, fellows),
        row("half of all shapes", all),
        row("more than", rank),
      ),
    );
    node.hidden = false;
    const box = bar.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = node;
    const left = Math.min(Math.max(box.left + box.width / 2 - width / 2, GAP), window.innerWidth - width - GAP);
    const top =
      box.top - GAP - height >= GAP
        ? box.top - GAP - height
        : Math.min(box.bottom + GAP, window.innerHeight - height - GAP);
    node.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
  }

  hide() {
    this.node.hidden = true;
  }
}
