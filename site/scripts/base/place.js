// Where things are: the state of a view in the address, the other pages, and the files of the site.
//
// A site is a folder, or it is one file. In one file all pages and files stand in the document, and an address names
// the page before the state of its view: `#/shapes?find=x` where a folder has `shapes.html#find=x`. Only this module
// knows the difference.

// Tests read addresses where there is no document.
const singleFile = globalThis.document?.documentElement.hasAttribute("data-single-file") ?? false;
const PAGE = /^#\/([a-z-]*)\??/;
const LINK = /^([a-z-]+\.html)(?:#(.*))?$/;

/** The page that a site of one file was opened on: one load of the document shows one page. */
const opened = singleFile ? addressedFile() : "";

/** In a site of one file: the file that the page in the address would be in a folder. */
export function addressedFile() {
  return `${PAGE.exec(window.location.hash)?.[1] || "index"}.html`;
}

/** The state of the view, as the address has it. */
export function readHash() {
  const { hash } = window.location;
  return new URLSearchParams((singleFile ? hash.replace(PAGE, "") : hash).replace(/^#/, ""));
}

/** Scroll to what a link like `about.html#clusters` names, which is a place on the page and no state of a view. */
export function goToPlace() {
  const [[name, value] = ["", null]] = readHash();
  const place = value === "" ? document.getElementById(name) : null;
  const folded = place?.closest("details");
  if (folded) folded.open = true;
  place?.scrollIntoView();
}

/**
 * Write the state of the view into the address, in place of what was there. Where that is the place before once more, the
 * next step takes its place too: it is none that one would come back to.
 * @param {URLSearchParams} query
 */
export function replaceHash(query) {
  if (leaving()) return;
  idle = query.toString() === before;
  window.history.replaceState(window.history.state, "", hashAddress(query));
}

/**
 * The same as a new place, from which the browser's way back leads to the last one.
 * @param {URLSearchParams} query
 */
export function pushHash(query) {
  if (leaving()) return;
  if (idle) {
    replaceHash(query);
    return;
  }
  const steps = here.steps + 1;
  here = { steps, last: steps, way: here.way + 1 };
  before = readHash().toString();
  window.history.pushState({ steps }, "", hashAddress(query));
}

/**
 * The first of two clicks was meant otherwise: what comes next takes the place of the step that it made.
 */
export function unstep() {
  idle = true;
}

/** @type {Whereabouts} */
let here = { steps: -1, last: -1, way: 0 };
/** Whether this place is there for the next one. */
let idle = false;
/** @type {string | null} the state of the view one step before, where that step was the last thing that was done */
let before = null;

/**
 * How many steps lead to a place from the one on which the page was opened first, and to the last one known; and a number
 * that is another where the reader took a new way.
 * @typedef {{ readonly steps: number, readonly last: number, readonly way: number }} Whereabouts
 */

/** Where the reader is; the same object as long as that is the same place. */
export function whereabouts() {
  return here;
}

/**
 * The reader came here: on the browser's ways, or by a link or an address written by hand, and so for the first time; then
 * it is a further step.
 */
export function arriveHere() {
  const first = window.history.state?.steps === undefined;
  idle = false;
  before = null;
  if (first) window.history.replaceState({ steps: here.steps + 1 }, "");
  const { steps } = window.history.state;
  here = { steps, last: first ? steps : Math.max(here.last, steps), way: here.way + Number(first) };
}

/**
 * Go some steps on, or with a number below zero back, as the browser's own ways do, but not to another page.
 * @param {number} number
 */
export function walk(number) {
  const place = here.steps + number;
  if (place >= 0 && place <= here.last) window.history.go(number);
}

/**
 * The address of a page of this site, by its file, in some state.
 *
 * @param {string} file
 * @param {string | Record<string, string> | URLSearchParams | string[][]} query parameters, or pairs of name and value
 */
export function pageAddress(file, query = []) {
  const state = new URLSearchParams(query).toString();
  if (singleFile) return `#/${file.replace(/\.html$/, "")}${state === "" ? "" : `?${state}`}`;
  return state === "" ? file : `${file}#${state}`;
}

/**
 * The page of this site that an address leads to, `{ file, query }`; null where it leads elsewhere.
 * @param {string} address
 */
export function linkedPage(address) {
  const found = /^(?:([a-z-]+)\.html|#\/([a-z-]+))(?:[#?](.*))?$/.exec(address);
  return found && { file: `${found[1] ?? found[2]}.html`, query: new URLSearchParams(found[3]) };
}

/**
 * The address of a file of this site, by its path.
 * @param {string} path
 */
export function resource(path) {
  const block = singleFile ? document.getElementById(path) : null;
  return block === null ? path : `data:${block.dataset.type};base64,${block.textContent}`;
}

/**
 * Make the links and pictures of a template lead where they do in a site of one file.
 * @param {ParentNode} content
 */
export function settle(content) {
  for (const link of content.querySelectorAll("a[href]")) {
    const path = link.getAttribute("href") ?? "";
    const [, file, state] = LINK.exec(path) ?? [];
    link.href = file === undefined ? resource(path) : pageAddress(file, state);
    if (link.hasAttribute("download")) link.download = path.split("/").at(-1);
  }
  for (const picture of content.querySelectorAll("img[src]")) picture.src = resource(picture.getAttribute("src") ?? "");
}

/** Whether the address names another page already, which is about to be loaded. */
function leaving() {
  return singleFile && addressedFile() !== opened;
}

/** @param {URLSearchParams} query */
function hashAddress(query) {
  if (singleFile) return pageAddress(opened, query);
  const hash = query.toString();
  return hash === "" ? window.location.pathname + window.location.search : `#${hash}`;
}
