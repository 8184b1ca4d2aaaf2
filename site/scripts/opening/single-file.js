// Opens a page of a site that is one file. It runs at the end of the document: pages stand in templates, scripts have
// been handed over to be run, and files wait as blocks of text.

import { addressedFile, goToPlace, settle } from "../base/place.js";

const opened = addressedFile();

// Before the page's own listeners. Scripts of pages count on a document that is theirs alone, so another page is
// another load of the document; it comes from the disk, and its parts are only unpacked when they are wanted.
window.addEventListener("hashchange", (event) => {
  if (addressedFile() === opened) {
    goToPlace();
    return;
  }
  event.stopImmediatePropagation();
  if (window.name === "shapeviz-framed") {
    // A document without an address of its own cannot be loaded again; who framed it makes a new one.
    window.parent.postMessage(window.location.hash, "*");
    return;
  }
  window.history.scrollRestoration = "manual";
  window.location.reload();
});

const pages = new Map([...document.querySelectorAll("head > template")].map((template) => [template.id, template]));
const template = /** @type {Found} */ (pages.get(opened) ?? pages.get("index.html"));
const content = document.importNode(template.content, true);
const scripts = [...content.querySelectorAll("script")].map((script) => {
  script.remove();
  return script.getAttribute("src") ?? "";
});
settle(content);
document.title = template.dataset.title ?? "";
document.body.className = template.className;
document.body.replaceChildren(content);
// Scripts that only hand over data have nothing to run here.
for (const address of scripts) window.shapeviz.scripts.get(address)?.();
goToPlace();
