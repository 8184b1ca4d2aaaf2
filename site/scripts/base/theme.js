// Light or dark: as the system says, unless the reader chose otherwise.

import { entry } from "./entry.js";

/** @typedef {"light" | "dark"} Theme */

const KEY = "shapeviz-theme";

/** @type {MediaQueryList | null} asked for when a page first needs it, so that what computes runs without a window too */
let query = null;

function system() {
  return (query ??= window.matchMedia("(prefers-color-scheme: dark)"));
}

// Pages opened by double-click may be refused storage; then the choice lasts as long as the page.
function stored() {
  try {
    return window.localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

/** @param {Theme} theme */
function store(theme) {
  try {
    window.localStorage.setItem(KEY, theme);
  } catch {
    return;
  }
}

let changed = () => {};

/** The theme in use is another: draw in its colours. */
export function restyle() {
  changed();
}

/** @returns {Theme} */
export function currentTheme() {
  const chosen = /** @type {Theme | undefined} */ (document.documentElement.dataset.theme);
  if (document.documentElement.dataset.paper !== undefined) return "light";
  return chosen ?? (system().matches ? "dark" : "light");
}

/** @type {Map<string, string>} */
const colors = new Map();

/**
 * A colour of the style sheet, for marks that are drawn and not styled.
 * @param {string} name
 * @returns {string}
 */
export function styleColor(name) {
  const key = `${name} ${currentTheme()} ${document.documentElement.dataset.paper ?? ""}`;
  return entry(colors, key, () => computedColor(`var(--${name})`));
}

/**
 * What a colour comes to in the theme in use; asked of an element, which knows the theme.
 * @param {string} color
 */
function computedColor(color) {
  const node = document.createElement("i");
  node.style.color = color;
  document.body.append(node);
  const { color: computed } = getComputedStyle(node);
  node.remove();
  return computed;
}

export function applyStoredTheme() {
  const theme = stored();
  if (theme === "light" || theme === "dark") document.documentElement.dataset.theme = theme;
}

/**
 * Make the theme button work; `work` is called after every change of theme, the system's included.
 * @param {() => void} work
 */
export function watchTheme(work) {
  changed = work;
  document.getElementById("theme").addEventListener("click", () => {
    const theme = currentTheme() === "dark" ? "light" : "dark";
    document.documentElement.dataset.theme = theme;
    store(theme);
    restyle();
  });
  system().addEventListener("change", restyle);
  // A page in another tab goes along.
  window.addEventListener("storage", ({ key }) => {
    if (key !== KEY) return;
    applyStoredTheme();
    restyle();
  });
}
