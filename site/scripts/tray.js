// The selected shapes as pictures, to look through, export, or drop.

import { element, picture, swatch } from "./dom.js";
import { saveCsv, saveJson } from "./export.js";
import { count, shortened } from "./words.js";

const PAGE = 200;
const MOST_CLASSES = 8;

export class Tray {
  constructor(model, state, scene, { open, point }) {
    this.model = model;
    this.scene = scene;
    this.state = state;
    this.open = open;
    this.point = point;
    this.node = document.getElementById("tray");
    state.listen((changed) => {
      if (["selection", "brushing", "theme"].some((name) => changed.has(name))) this.#fillSoon();
      if (changed.has("opened")) this.#markOpened();
    });
    this.overlap = 0;
    this.#fill();
  }

  #pending = null;

  // A brush changes the selection with every movement of the pointer; once a frame is enough.
  #fillSoon() {
    this.#pending ??= requestAnimationFrame(() => {
      this.#pending = null;
      this.#fill();
    });
  }

  #fill() {
    const chosen = [...this.state.get("selection")].sort((a, b) => this.model.groups[a] - this.model.groups[b] || a - b);
    // The tray unfolds when the brush is let go, not under it.
    const unfolded = chosen.length > 0 && !this.state.get("brushing");
    this.node.classList.toggle("filled", unfolded);
    if (chosen.length === 0) this.node.replaceChildren(element("p", { class: "hint" }, hint()));
    else this.node.replaceChildren(this.#head(chosen), unfolded ? this.#strip(chosen) : "");
    const overlap = unfolded ? Math.max(-parseFloat(getComputedStyle(this.node).marginTop), 0) : 0;
    if (overlap !== this.overlap) this.scene.cover(overlap);
    this.overlap = overlap;
    this.node.parentElement.style.setProperty("--covered", `${overlap}px`);
    this.#markOpened();
  }

  #head(chosen) {
    const { model } = this;
    const census = model.census(chosen);
    return element(
      "div",
      { class: "tray-head" },
      element("h2", {}, `${count(chosen.length, "shape")} selected`),
      model.labelled && element(
        "p",
        { class: "census" },
        census.slice(0, MOST_CLASSES).map(([group, number]) => element("span", {}, swatch(model.symbol(group), model.color(group)), `${shortened(model.className(group), 20)} `, element("b", {}, String(number)))),
        census.length > MOST_CLASSES && element("span", {}, `and ${census.length - MOST_CLASSES} more`),
      ),
      element("button", { type: "button", class: "plain", onclick: () => saveCsv(model, chosen) }, "CSV"),
      element("button", { type: "button", class: "plain", onclick: () => saveJson(model, chosen) }, "JSON"),
      element("button", { type: "button", class: "plain", onclick: () => this.state.set({ selection: new Set() }) }, "Clear"),
    );
  }

  #strip(chosen) {
    const strip = element("div", { class: "strip", role: "group", "aria-label": "Selected shapes; arrow keys go through them", onkeydown: (event) => this.#key(event) });
    const more = element("button", { type: "button", class: "plain more" });
    let shown = 0;
    const extend = () => {
      const next = chosen.slice(shown, shown + PAGE);
      more.before(...next.map((index) => this.#item(index)));
      shown += next.length;
      more.hidden = shown >= chosen.length;
      more.textContent = `${chosen.length - shown} more`;
    };
    more.addEventListener("click", extend);
    strip.append(more);
    extend();
    strip.firstElementChild.tabIndex = 0;
    return strip;
  }

  #item(index) {
    const { model } = this;
    const name = model.labelled ? `${model.names[index]}, ${model.className(model.groups[index])}` : model.names[index];
    return element(
      "button",
      {
        type: "button",
        class: "shape",
        tabindex: "-1",
        "data-index": index,
        "aria-label": name,
        title: name,
        onclick: () => this.open(index),
        onpointerenter: () => this.point(index),
        onpointerleave: () => this.point(null),
      },
      picture(model, index, 72),
    );
  }

  #key(event) {
    const steps = { ArrowRight: 1, ArrowLeft: -1, Home: -Infinity, End: Infinity };
    if (!(event.key in steps)) return;
    event.preventDefault();
    const items = [...event.currentTarget.querySelectorAll(".shape")];
    const here = items.indexOf(document.activeElement);
    const next = Math.min(Math.max(here + steps[event.key], 0), items.length - 1);
    for (const item of items) item.tabIndex = -1;
    items[next].tabIndex = 0;
    items[next].focus();
  }

  #markOpened() {
    const opened = String(this.state.get("opened"));
    for (const item of this.node.querySelectorAll(".shape")) item.classList.toggle("opened", item.dataset.index === opened);
  }
}

function hint() {
  return window.matchMedia("(pointer: coarse)").matches
    ? "Tap a shape to see what is known of it. With Select, drag a box to collect shapes here."
    : "Drag a box on a map to collect shapes here. Click a shape to see what is known of it.";
}
