// Trusted Types: no text can become markup on these pages, and no script but the site's own can be added.

import { chunk } from "../base/chunks.js";

const OWN = /^((assets\/(chunk-[a-z-]+|vega)|chunks\/[a-z]+-\d+)\.js\?[0-9a-f]{8}|models\/[0-9a-f]{20}\.js)$/;

/** The address of the one worker that is being started at this moment. */
/** @type {string | null} */
let starting = null;

export function trustOnlyOurselves() {
  if (!window.trustedTypes) return;
  window.trustedTypes.createPolicy("default", {
    // Vega empties its container by assigning an empty string.
    createHTML: (/** @type {string} */ text) => (text === "" ? "" : null),
    createScriptURL: (/** @type {string} */ address) => (OWN.test(address) || address === starting ? address : null),
  });
}

/**
 * Start the engine's worker. Pages from file:// can start one only from text; that text is always the site's own
 * chunk, and its address is trusted for just this call.
 */
export async function startWorker() {
  const address = URL.createObjectURL(new Blob([await chunk("engine")], { type: "text/javascript" }));
  starting = address;
  try {
    const worker = new Worker(address);
    worker.addEventListener("message", () => URL.revokeObjectURL(address), { once: true });
    return worker;
  } finally {
    starting = null;
  }
}
