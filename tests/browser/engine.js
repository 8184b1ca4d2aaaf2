// What the tests of the engine need from its page side, on `window.engine`.

import { Cancelled, startEngine } from "../../site/scripts/engine/client.js";
import { scaledPoints, squaredDistances } from "../../site/scripts/engine/distances.js";
import { layOut } from "../../site/scripts/engine/layout.js";
import { TaskLoop } from "../../site/scripts/engine/loop.js";
import { Quadtree } from "../../site/scripts/engine/quadtree.js";

const KINDS = { float32: Float32Array, float64: Float64Array, int32: Int32Array };

/** Arrays travel between Python and the page as base64 of their bytes, so that no digit is lost. */
function receive(value) {
  if (value === null || typeof value !== "object") return value;
  if (value.kind) return new KINDS[value.kind](Uint8Array.from(atob(value.bytes), (c) => c.charCodeAt(0)).buffer);
  if (Array.isArray(value)) return value.map(receive);
  return Object.fromEntries(Object.entries(value).map(([name, item]) => [name, receive(item)]));
}

function send(value) {
  if (value === null || typeof value !== "object") return value;
  const kind = Object.keys(KINDS).find((name) => value instanceof KINDS[name]);
  if (kind) {
    const bytes = new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
    let text = "";
    for (let start = 0; start < bytes.length; start += 4096) {
      text += String.fromCharCode(...bytes.subarray(start, start + 4096));
    }
    return { kind, bytes: btoa(text) };
  }
  if (Array.isArray(value)) return value.map(send);
  return Object.fromEntries(Object.entries(value).map(([name, item]) => [name, send(item)]));
}

/** Run a task's generator to its end, here and without pause. */
function exhaust(steps) {
  const reports = [];
  for (let step = steps.next(); ; step = steps.next()) {
    if (step.done) return { result: step.value, reports };
    // A partial result may change after it was handed over.
    reports.push(structuredClone(step.value));
  }
}

let open = null;

window.engine = {
  startEngine,
  Cancelled,
  TaskLoop,
  get open() {
    return open;
  },
  async start(table) {
    open?.close();
    open = await startEngine(() => receive(table));
  },
  async run(name, parameters) {
    const reports = [];
    const result = await open.run(name, receive(parameters), (report) => reports.push(report)).done;
    return send({ result, reports });
  },
  layOutHere(table, parameters) {
    return send(exhaust(layOut(receive(table), receive(parameters))));
  },
  distances(table, { rows, columns, by }) {
    return send(exhaust(squaredDistances(scaledPoints(receive(table), receive(rows), receive(columns), by))).result);
  },
  pushByTree(xy) {
    const points = receive(xy);
    const push = new Float64Array(points.length);
    const normaliser = new Quadtree(points.length / 2).push(points, push);
    return send({ normaliser, push });
  },
};
