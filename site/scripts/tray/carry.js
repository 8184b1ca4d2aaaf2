// What a reader has chosen goes along: by whichever link to a page of the site, the shapes stay selected there; by the
// menu, the view goes too, as far as the page knows it.

import { commonTo } from "../base/address.js";
import { element } from "../base/dom.js";
import { linkedPage, pageAddress } from "../base/place.js";
import { isSelection } from "../database/selection.js";

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

/**
 * Let all links of a page carry what its address holds.
 * @param {() => URLSearchParams} written the address as it is now
 */
export function carryView(written) {
  /** Addresses that were written here, by link: any other selection in a link is the link's own business. */
  /** @type {WeakMap<Element, string>} */
  const known = new WeakMap();
  /** @param {Event & Targeted} event */
  const write = ({ target }) => {
    const link = target.closest?.("a[href]:not([download])");
    const address = link?.getAttribute("href") ?? "";
    const page = linkedPage(address);
    if (!link || page === null) return;
    const common = commonTo(written());
    const all = [...page.query];
    let carrying;
    if (link.closest(".masthead nav")) carrying = common;
    else {
      const own = all.filter(([name]) => !isSelection(name));
      if (own.length < all.length && known.get(link) !== address) return;
      carrying = [...own, ...common.filter(([name]) => isSelection(name))];
    }
    const carried = pageAddress(page.file, carrying);
    link.setAttribute("href", carried);
    known.set(link, carried);
  };
  // At the last moment, not with every change: a brush changes the selection many times a second.
  for (const name of /** @type {const} */ (["pointerdown", "keydown", "click"]))
    document.addEventListener(name, write, { capture: true });
}
