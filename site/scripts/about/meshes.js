// The search among the meshes.

import { grouped } from "../base/words.js";

export function watchMeshes() {
  const meshes = document.getElementById("meshes");
  const field = document.getElementById("find-mesh");
  const status = meshes.querySelector("[role=status]");
  const rows = [...meshes.querySelectorAll("tbody tr")].map((row) => ({
    row,
    text: row.textContent.toLocaleLowerCase(),
  }));
  /** @type {Found} */ (field.closest("p")).hidden = false;
  field.addEventListener("input", () => {
    const words = field.value.toLocaleLowerCase().split(/\s+/);
    let found = 0;
    for (const { row, text } of rows) {
      row.hidden = !words.every((/** @type {string} */ word) => text.includes(word));
      if (!row.hidden) found += 1;
    }
    status.textContent = field.value.trim() === "" ? "" : `${grouped(found)} of ${grouped(rows.length)}`;
  });
}
