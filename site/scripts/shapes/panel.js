// The filters on a phone: a sheet over the page, in place of the column beside the gallery.

import { watchSize } from "../base/dom.js";
import { count } from "../base/words.js";

/** @import { GalleryState } from "../addresses/shapes.js" */
/** @import { Sieve } from "./sieve.js" */

export class Panel {
  /**
   * @param {Sieve} sieve
   * @param {GalleryState} state
   */
  constructor(sieve, state) {
    this.sieve = sieve;
    this.state = state;
    this.node = document.getElementById("filters");
    this.opener = document.getElementById("open-filters");
    this.closer = document.getElementById("close-filters");
    this.opener.addEventListener("click", () => this.#open());
    this.closer.addEventListener("click", () => this.#close());
    this.node.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !this.shown) return;
      event.stopPropagation();
      this.#close();
    });
    // A window that becomes wide has room for the column.
    watchSize([document.body], () => {
      if (this.shown && this.opener.offsetParent === null) this.#close();
    });
  }

  get shown() {
    return this.node.classList.contains("shown");
  }

  #open() {
    this.#cover(true);
    this.node.querySelector("summary, button").focus();
  }

  #close() {
    this.#cover(false);
    this.opener.focus();
  }

  /** @param {boolean} shown */
  #cover(shown) {
    this.node.classList.toggle("shown", shown);
    this.opener.setAttribute("aria-expanded", String(shown));
    document.documentElement.classList.toggle("sheet-open", shown);
    // Nothing behind the sheet is to be reached.
    for (const other of document.querySelectorAll(".masthead, .gallery > :not(#filters)")) other.inert = shown;
  }

  show() {
    const used = this.state.get("filters").size;
    this.opener.textContent = used === 0 ? "Filters" : `Filters (${used})`;
    this.closer.textContent =
      this.sieve.size === 0 ? "No shape has all of this" : `Show ${count(this.sieve.size, "shape")}`;
  }
}
