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

const colors = new Map();

/** A colour of the style sheet, for marks that are drawn and not styled. */
export function styleColor(name) {
  const key = `${name} ${currentTheme()}`;
  if (!colors.has(key)) colors.set(key, computedColor(`var(--${name})`));
  return colors.get(key);
}

/** What a colour comes to in the theme in use; asked of an element, which knows the theme. */
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
