// One Vega-Lite chart, drawn by Vega under a policy without eval: hence the expression interpreter.

import { addScript } from "./chunks.js";

const loader = {
  load: () => Promise.reject(new Error("charts load nothing")),
  // Pictures lie beside the page. Without a CORS mode they load from file:// too.
  /** @param {string} address */
  sanitize: (address) => Promise.resolve({ href: address, crossOrigin: null }),
  http: null,
  file: null,
};

/** @type {Promise<any> | null} */
let vega = null;

/** Vega is most of what a page loads: a page that names it, and does not begin with a chart, loads it with the first. */
function loadVega() {
  vega ??= window.vegaEmbed ? Promise.resolve() : addScript(document.getElementById("content").dataset.vega ?? "");
  return vega;
}

/**
 * Draw a chart into an element; the result is its Vega view.
 * @param {HTMLElement} node
 * @param {Record<string, any>} spec
 * @param {Record<string, any>} config
 * @param {"svg" | "canvas"} renderer
 */
export async function drawChart(node, spec, config, renderer) {
  await loadVega();
  const { view } = await window.vegaEmbed(node, spec, {
    actions: false,
    ast: true,
    config,
    defaultStyle: false,
    loader,
    logLevel: 1,
    renderer,
    tooltip: false,
  });
  return view;
}
