// Small pictures on sheets, for maps of very many shapes.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Sheets } from "../../site/scripts/database/sheets.js";

const sheets = new Sheets(
  {
    grids: [4, 8],
    across: 2,
    maps: {
      tsne: { rows: Int32Array.of(7, 2, 5, 0, 3, 9), ends: [3, 6], sheets: ["a.webp", "b.webp"] },
      pca: { rows: Int32Array.of(1, 7), ends: [1, 2], sheets: ["c.webp"] },
    },
  },
  10,
);

test("a grid is used down to where its cells would be too small", () => {
  assert.deepEqual([...sheets.shapes("tsne")], [7, 2, 5]);
  assert.deepEqual(
    [1, 0.3, 0.25, 0.001].map((cell) => sheets.grid(cell)),
    [0, 0, 1, 1],
  );
  assert.deepEqual([...sheets.shapes("tsne", 0)], [7, 2, 5]);
  assert.deepEqual([...sheets.shapes("tsne", 1)], [7, 2, 5, 0, 3, 9]);
  assert.deepEqual([...sheets.shapes("pca", 1)], [1, 7]);
});

test("a picture is where the build put it", () => {
  assert.deepEqual(sheets.cut("tsne", 5), { address: "sheets/a.webp", column: 0, line: 1 });
  assert.deepEqual(sheets.cut("tsne", 9), { address: "sheets/b.webp", column: 1, line: 0 });
  assert.deepEqual(sheets.cut("pca", 7), { address: "sheets/c.webp", column: 1, line: 0 });
});

test("a map without sheets has those of the first", () => {
  assert.deepEqual([...sheets.shapes("tsne:Gc+Sc")], [7, 2, 5]);
  assert.equal(sheets.cut("tsne:Gc+Sc", 7).address, "sheets/a.webp");
});
