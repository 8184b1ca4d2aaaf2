// One Vega-Lite chart, drawn by Vega under a policy without eval: hence the expression interpreter.

const loader = {
  load: () => Promise.reject(new Error("charts load nothing")),
  // Pictures lie beside the page. Without a CORS mode they load from file:// too.
  /** @param {string} address */
  sanitize: (address) => Promise.resolve({ href: address, crossOrigin: null }),
  http: null,
  file: null,
};

/**
 * Draw a chart into an element; the result is its Vega view.
 * @param {HTMLElement} node
 * @param {Record<string, any>} spec
 * @param {Record<string, any>} config
 * @param {"svg" | "canvas"} renderer
 */
export async function drawChart(node, spec, config, renderer) {
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
