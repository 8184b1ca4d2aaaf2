// Where things are: the state of a view in the address, the other pages, and the files of the site.

/** The state of the view, as the address has it. */
export function readHash() {
  return new URLSearchParams(window.location.hash.slice(1));
}

/** Write the state of the view into the address, in place of what was there. */
export function replaceHash(query) {
  window.history.replaceState(null, "", hashAddress(query));
}

/** The same as a new place, from which the browser's way back leads to the last one. */
export function pushHash(query) {
  window.history.pushState(null, "", hashAddress(query));
}

/** The address of a page of this site, by its file, in some state: parameters, or pairs of name and value. */
export function pageAddress(file, query = []) {
  const hash = new URLSearchParams(query).toString();
  return hash === "" ? file : `${file}#${hash}`;
}

/** The address of a file of this site, by its path. */
export function resource(path) {
  return path;
}

function hashAddress(query) {
  const hash = query.toString();
  return hash === "" ? window.location.pathname + window.location.search : `#${hash}`;
}
