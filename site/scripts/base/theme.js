// Light or dark: as the system says, unless the reader chose otherwise.

const KEY = "shapeviz-theme";
const system = window.matchMedia("(prefers-color-scheme: dark)");

// Pages opened by double-click may be refused storage; then the choice lasts as long as the page.
function stored() {
  try {
    return window.localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function store(theme) {
  try {
    window.localStorage.setItem(KEY, theme);
  } catch {
    return;
  }
}

export function currentTheme() {
  return document.documentElement.dataset.theme ?? (system.matches ? "dark" : "light");
}

/** A colour of the style sheet, for marks that are drawn and not styled. */
export function styleColor(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function applyStoredTheme() {
  const theme = stored();
  if (theme === "light" || theme === "dark") document.documentElement.dataset.theme = theme;
}

/** Make the theme button work; `changed` is called after every change of theme, the system's included. */
export function watchTheme(changed) {
  document.getElementById("theme").addEventListener("click", () => {
    const theme = currentTheme() === "dark" ? "light" : "dark";
    document.documentElement.dataset.theme = theme;
    store(theme);
    changed();
  });
  system.addEventListener("change", changed);
}
