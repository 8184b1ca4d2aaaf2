// What benchmarks/browser.py needs of the engine, on `window.engine`: a worker of its text, filled with arrays.

import { startEngine } from "../site/scripts/engine/client.js";

let engine = null;

function floats(base64) {
  return new Float32Array(Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0)).buffer);
}

window.engine = {
  async start(text, { rows, columns, values, blocks, weights }) {
    const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    window.shapeviz = { startWorker: async () => new Worker(address) };
    engine?.close();
    const table = {
      rows,
      columns,
      values: floats(values),
      blocks: Int32Array.from(blocks),
      weights,
      scaling: "balanced",
    };
    engine = await startEngine(table);
  },

  async layOut(method, count, columns, by, start, seed) {
    const rows = Int32Array.from({ length: count }, (_, row) => row);
    const parameters = {
      method,
      rows,
      columns: Int32Array.from(columns),
      by,
      start: start && Float32Array.from(start),
      seed,
    };
    const { xy } = await engine.run("layout", parameters).done;
    return Array.from(xy);
  },

  async measureHit(xy, groups) {
    await engine.run("hit", { xy: Float32Array.from(xy), groups: Int32Array.from(groups), k: 10 }).done;
  },
};
