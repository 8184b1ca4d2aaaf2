// The feature types in use, in their colours.

import { element, focused } from "../base/dom.js";
import { grouped } from "../base/words.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Bins } from "../database/bins.js" */

export class FeatureList {
  /**
   * @param {Bins} bins
   * @param {WorkState} state
   * @param {() => Chunk.FeatureMarks} marks
   * @param {(features: Set<number>) => void} change takes others into use
   */
  constructor(bins, state, marks, change) {
    this.bins = bins;
    this.state = state;
    this.marks = marks;
    this.change = change;
    this.list = document.getElementById("feature-list");
    this.everything = new Set(bins.features.keys());
    document.getElementById("features-all").addEventListener("click", () => change(this.everything));
    state.listen((changed) => {
      if (["features", "bins", "theme"].some((name) => changed.has(name))) this.render();
    });
    this.render();
  }

  render() {
    const kept = focused()?.dataset.key;
    this.list.replaceChildren(
      ...this.bins.features.map((feature, index) =>
        element("li", {}, this.#button(feature, index), this.#only(feature, index)),
      ),
    );
    if (kept !== undefined) this.list.querySelector(`[data-key="${kept}"]`)?.focus({ preventScroll: true });
  }

  /**
   * @param {Chunk.Feature} feature
   * @param {number} index
   */
  #button({ name, title, start, dimensions, bins, hue }, index) {
    const used = this.state.get("features");
    const last = used.has(index) && used.size === 1;
    const width = dimensions * bins;
    const chosen = [...this.state.get("bins")].filter((column) => column >= start && column < start + width).length;
    const mark = element("i", { class: "hued" });
    mark.style.background = this.marks().features[hue];
    return element(
      "button",
      {
        type: "button",
        class: "use",
        "data-key": `feature ${index}`,
        "aria-pressed": String(used.has(index)),
        "aria-disabled": last ? "true" : null,
        title: last ? `${title}\nA map needs at least one feature.` : `${title}\nClick takes it into use or out of it.`,
        onclick: (event) => (event.altKey ? this.change(new Set([index])) : this.#toggle(index, last)),
      },
      mark,
      element("span", { class: "name", dir: "auto" }, name),
      element(
        "span",
        { class: "size" },
        chosen > 0 ? element("b", { title: "bins chosen" }, grouped(chosen)) : "",
        chosen > 0 && " of ",
        grouped(width),
      ),
    );
  }

  /**
   * @param {Chunk.Feature} feature
   * @param {number} index
   */
  #only({ name }, index) {
    const used = this.state.get("features");
    const attributes = {
      "data-key": `only feature ${index}`,
      "aria-label": `Only ${name}`,
      title: "Only this feature",
      disabled: used.size === 1 && used.has(index),
    };
    return element(
      "button",
      { type: "button", class: "only", ...attributes, onclick: () => this.change(new Set([index])) },
      "only",
    );
  }

  /**
   * @param {number} index
   * @param {boolean} last
   */
  #toggle(index, last) {
    if (last) return;
    const features = new Set(this.state.get("features"));
    if (!features.delete(index)) features.add(index);
    this.change(features);
  }
}
