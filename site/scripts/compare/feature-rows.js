// Feature by feature: how much of what the shapes differ in goes with the group, beside what chance would make of it.

import { element } from "../base/dom.js";
import { percent } from "../base/words.js";

/** @import { View } from "./groups-view.js" */

/** @param {View} view */
export function featureRows(view) {
  const { contrast, bins } = view;
  const rows = bins.features
    .map((feature, index) => ({ feature, index, ...contrast.apart.features[index] }))
    .sort((a, b) => b.share - a.share || a.index - b.index);
  const longest = Math.max(...rows.map((row) => Math.max(row.share, row.limit)), 1e-9);
  return rows.map((row) => {
    const best = contrast.ranked.find((column) => bins.featureOf(column) === row.index);
    const beyond = row.share > row.limit * (1 + 1e-9);
    const fill = element("i", { class: "filled" });
    fill.style.width = `${(100 * row.share) / longest}%`;
    fill.style.background = bins.colorOf(row.index);
    const chance = element("i", { class: "chance" });
    chance.style.width = `${(100 * row.limit) / longest}%`;
    return element(
      "li",
      { class: beyond ? null : "within" },
      element(
        "span",
        { class: "feature" },
        element("bdi", { title: row.feature.name }, row.feature.name),
        row.feature.title !== row.feature.name && element("span", { class: "quiet" }, row.feature.title),
      ),
      element("span", { class: "share-bar" }, fill, chance),
      element(
        "span",
        { class: "figure" },
        percent(row.share),
        element("span", { class: "quiet" }, beyond ? "" : " within chance"),
      ),
      element(
        "span",
        { class: "best" },
        best === undefined
          ? ""
          : element(
              "button",
              {
                type: "button",
                class: "bin-chip",
                "data-column": best,
                "aria-pressed": String(best === view.bin),
                title: "Its bin that differs most: show it on shapes",
                onclick: () => view.look(best),
              },
              element("bdi", {}, bins.shortName(best, 14)),
            ),
      ),
      element("span", { class: "quiet measures" }, row.feature.measures),
    );
  });
}
