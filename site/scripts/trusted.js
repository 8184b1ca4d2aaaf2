// Trusted Types: no text can become markup on these pages, and no script but the site's own data can be added.

const OWN_DATA = /^assets\/chunk-[a-z-]+\.js\?[0-9a-f]{8}$/;

export function trustOnlyOurselves() {
  if (!window.trustedTypes) return;
  window.trustedTypes.createPolicy("default", {
    // Vega empties its container by assigning an empty string.
    createHTML: (text) => (text === "" ? "" : null),
    createScriptURL: (address) => (OWN_DATA.test(address) ? address : null),
  });
}
