// The name of a bin, to point at and to click: what it means shows beside it, and what it looks like below.

import { element } from "../base/dom.js";
import { inWords } from "../bins-kit/bin-name.js";

/** @import { BinsState } from "../addresses/bins.js" */
/** @import { BinCard } from "../bins-kit/bin-card.js" */
/** @import { Bins } from "../database/bins.js" */

const LONGEST = 18;

export class BinChips {
  /**
   * @param {Bins} bins
   * @param {BinCard} card
   * @param {BinsState} state
   * @param {{ look: (column: number, group: number | null) => void }} ways what a click does
   */
  constructor(bins, card, state, { look }) {
    this.bins = bins;
    this.card = card;
    this.state = state;
    this.look = look;
    state.listen((changed) => {
      if (!changed.has("bin")) return;
      for (const chip of document.querySelectorAll(".bin-chip")) mark(chip, state.get("bin"));
    });
  }

  /**
   * A chip; the card sets a class apart from the others where one is named.
   * @param {number} column
   * @param {{ group?: number | null, added?: boolean }} [how]
   */
  chip(column, { group = null, added = false } = {}) {
    const { bins } = this;
    const hue = element("i", { class: "hued" });
    hue.style.background = bins.color(column);
    /** @param {PointerEvent & Targeted | FocusEvent & Targeted} event */
    const show = (event) => this.#show(column, group, event.currentTarget);
    const chip = element(
      "button",
      {
        type: "button",
        class: added ? "bin-chip added" : "bin-chip",
        "data-column": column,
        onclick: () => this.look(column, group),
        onpointerenter: (event) => event.pointerType === "mouse" && show(event),
        onpointerleave: () => this.card.hide(),
        onfocus: (event) => event.currentTarget.matches(":focus-visible") && show(event),
        onblur: () => this.card.hide(),
      },
      hue,
      element("bdi", {}, bins.shortName(column, LONGEST)),
      inWords(bins, column),
    );
    mark(chip, this.state.get("bin"));
    return chip;
  }

  /**
   * @param {number} column
   * @param {number | null} group
   * @param {Element} node
   */
  #show(column, group, node) {
    const { database } = this.card;
    const groups = database.labelled ? [...database.sizes.keys()].sort((a, b) => a - b) : [];
    this.card.know({
      scores: this.#none,
      scorer: "",
      separated: group === null ? [] : [group],
      others: groups.filter((other) => other !== group),
    });
    const { left, top, width, height } = node.getBoundingClientRect();
    this.card.show(column, { left, top, width, height, free: top });
  }

  /** @type {Float64Array | null} */
  #kept = null;

  get #none() {
    this.#kept ??= new Float64Array(this.bins.count).fill(NaN);
    return this.#kept;
  }
}

/**
 * @param {HTMLElement} chip
 * @param {number} bin
 */
function mark(chip, bin) {
  chip.setAttribute("aria-pressed", String(Number(chip.dataset.column) === bin));
}
