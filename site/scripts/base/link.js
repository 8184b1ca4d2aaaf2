// The link to a view: it holds what one sees, and says so.

import { listed } from "./words.js";

/** How long it stays said, in milliseconds. */
const SAID = 6000;

/** @type {number | undefined} */
let timer;

/**
 * Make the button that copies a link work.
 * @param {() => string[]} held what is in the address beside the page, in words
 */
export function watchLink(held) {
  const button = document.getElementById("copy-link");
  const said = document.getElementById("copied");
  button.addEventListener("click", async () => {
    const copied = await copy(window.location.href);
    const words = held();
    said.textContent = copied
      ? `Link copied. It holds ${words.length === 0 ? "this page as it opens" : listed(words)}.`
      : "Your browser does not let the page copy: the address above is the link.";
    said.hidden = false;
    clearTimeout(timer);
    timer = setTimeout(() => (said.hidden = true), SAID);
  });
}

/** @param {string} text */
async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
