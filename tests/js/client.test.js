// The page's side of the engine.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Engine } from "../../site/scripts/engine/client.js";

/** An engine, and what it posts to its worker: numbers of buffers that go there, by message. */
function posted() {
  const messages = [];
  const worker = { postMessage: (message, moved) => messages.push([Object.keys(message)[0], moved.length]) };
  const table = { steps: new Uint16Array(4) };
  return { engine: new Engine(worker, () => table), messages, table };
}

test("the table goes to the engine for the first task that needs it", () => {
  const { engine, messages, table } = posted();
  engine.run("hit", {});
  engine.run("beside", { table: null });
  engine.run("layout", { table });
  assert.deepEqual(messages, [
    ["run", 0],
    ["run", 0],
    ["run", 1],
  ]);
  messages.length = 0;
  engine.run("faith", {});
  engine.run("score", {});
  assert.deepEqual(messages, [
    ["table", 1],
    ["run", 0],
    ["run", 0],
  ]);
});
