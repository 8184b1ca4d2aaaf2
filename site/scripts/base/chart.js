// One Vega-Lite chart, drawn by Vega under a policy without eval: hence the expression interpreter.

import { addScript } from "./chunks.js";
import { pause } from "./dom.js";

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

/** Vega is most of what a page loads: it comes with the first chart, when what the page says can be read. */
async function loadVega() {
  vega ??= addScript(document.getElementById("content").dataset.vega ?? "");
  await vega;
  return window.vega;
}

/**
 * Make a chart in an element; the result is its Vega view, which draws when it runs.
 * @param {HTMLElement} node
 * @param {Record<string, any>} spec
 * @param {Record<string, any>} config
 * @param {"svg" | "canvas"} renderer
 */
export function drawChart(node, spec, config, renderer) {
  const drawn = embed(node, spec, config, renderer);
  underWay.add(drawn);
  drawn.finally(() => underWay.delete(drawn));
  return drawn;
}

/** @type {Set<Promise<any>>} */
const underWay = new Set();

/** Resolved when no chart is being drawn, and what followed from that is on the page. */
export async function chartsAtRest() {
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  do {
    await Promise.all(underWay);
    // A chart that is there is then given its values.
    for (let waited = 0; waited < 3; waited += 1) await frame();
  } while (underWay.size > 0);
}

/**
 * @param {HTMLElement} node
 * @param {Record<string, any>} spec
 * @param {Record<string, any>} config
 * @param {"svg" | "canvas"} renderer
 */
async function embed(node, spec, config, renderer) {
  const { compile, parse, View, expressionInterpreter } = await loadVega();
  // Each step takes as long as a page may keep its reader waiting.
  await pause();
  const { spec: compiled } = compile(spec, { config });
  await pause();
  const runtime = parse(compiled, {}, { ast: true });
  await pause();
  return new View(runtime, { expr: expressionInterpreter, loader, logLevel: 1, renderer }).initialize(node);
}
