// The search among the meshes.

import { grouped } from "../base/words.js";
import { holding } from "../database/search.js";

export function watchMeshes() {
  const meshes = document.getElementById("meshes");
  const field = document.getElementById("find-mesh");
  const status = meshes.querySelector("[role=status]");
  const rows = [...meshes.querySelectorAll("tbody tr")];
  /** @type {Found} */ (field.closest("p")).hidden = false;
  field.addEventListener("input", () => {
    const holds = holding(field.value);
    let found = 0;
    for (const row of rows) {
      row.hidden = !holds(row.textContent);
      if (!row.hidden) found += 1;
    }
    status.textContent = field.value.trim() === "" ? "" : `${grouped(found)} of ${grouped(rows.length)}`;
  });
}
