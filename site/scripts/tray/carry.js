// The selection goes along: whichever link to a page of the site a reader follows, the shapes stay selected there.

import { element } from "../base/dom.js";
import { linkedPage, pageAddress, readHash } from "../base/place.js";
import { isSelection, writeSelection } from "../database/selection.js";

/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */

/**
 * Let all links of a page carry the selection in its state.
 * @param {Database} database
 * @param {State} state
 */
export function carrySelection(database, state) {
  carry(() => {
    const query = new URLSearchParams();
    writeSelection(query, database, state.get("selection"));
    return query;
  });
}

/** The same on a page that knows nothing of shapes: it hands on what its address says. */
export function carryAddress() {
  carry(() => new URLSearchParams([...readHash()].filter(([name]) => isSelection(name))));
}

/**
 * Go to a page of the site as if a link had been followed.
 * @param {string} address
 */
export function follow(address) {
  const link = element("a", { href: address, hidden: true });
  document.body.append(link);
  link.click();
  link.remove();
}

/** @param {() => URLSearchParams} selection */
function carry(selection) {
  /** Addresses that were written here, by link: any other selection in a link is the link's own business. */
  /** @type {WeakMap<Element, string>} */
  const written = new WeakMap();
  /** @param {Event & Targeted} event */
  const write = ({ target }) => {
    const link = target.closest?.("a[href]:not([download])");
    const address = link?.getAttribute("href") ?? "";
    const page = linkedPage(address);
    if (!link || page === null) return;
    const all = [...page.query];
    const own = all.filter(([name]) => !isSelection(name));
    if (own.length < all.length && written.get(link) !== address) return;
    const carrying = pageAddress(page.file, [...own, ...selection()]);
    link.setAttribute("href", carrying);
    written.set(link, carrying);
  };
  // At the last moment, not with every change: a brush changes the selection many times a second.
  for (const name of /** @type {const} */ (["pointerdown", "keydown", "click"]))
    document.addEventListener(name, write, { capture: true });
}
