// The section of one bin, to which the others lead. It is not a link's business: the address holds the state of the view,
// not a place on the page.

import { calm } from "../base/dom.js";

export function goToLook() {
  const look = document.getElementById("look");
  look.focus({ preventScroll: true });
  look.scrollIntoView({ behavior: calm() ? "instant" : "smooth", block: "start" });
}

/** Let the link in the lead go there. */
export function watchLookLink() {
  document.querySelector(".lead a")?.addEventListener("click", (event) => {
    event.preventDefault();
    goToLook();
  });
}
