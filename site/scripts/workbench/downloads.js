// What a reader takes away: the chosen bins, for a build of their own, and maps and scores for other programs.

import { element } from "../base/dom.js";
import { count, figure } from "../base/words.js";
import { ranked } from "../bins-kit/bin-list.js";
import { highestOf, rangeOf } from "../database/hit-range.js";
import { saveFile } from "../base/saving.js";
import { csvText } from "../tray/export.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database, ShapeMap } from "../database/database.js" */

/**
 * All there is at this moment.
 * @typedef {object} Work
 * @property {Set<number>} chosen
 * @property {Float64Array | null} scores
 * @property {ShapeMap | null} originalMap
 * @property {ShapeMap | null} refinedMap
 * @property {string[]} words what it is made from
 * @property {string} address
 */

const FILE = "bins.txt";

/**
 * Open the dialog of downloads.
 * @param {Database} database
 * @param {Bins} bins
 * @param {() => Work} work
 */
export function watchDownloads(database, bins, work) {
  const dialog = document.getElementById("export");
  document.getElementById("open-export").addEventListener("click", () => {
    dialog.replaceChildren(
      element(
        "div",
        { class: "detail-head" },
        element("h2", {}, "Export"),
        element("button", { type: "button", class: "plain", onclick: () => dialog.close() }, "Close"),
      ),
      ...content(database, bins, work()),
    );
    dialog.showModal();
  });
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
}

/**
 * @param {Database} database
 * @param {Bins} bins
 * @param {Work} work
 */
function content(database, bins, work) {
  const { chosen, originalMap, refinedMap, scores } = work;
  /**
   * @param {string} words
   * @param {string} name
   * @param {string} type
   * @param {() => string} text
   */
  const save = (words, name, type, text) =>
    element(
      "button",
      {
        type: "button",
        class: "plain strong",
        "data-file": name,
        onclick: () => saveFile(name, new Blob([text()], { type })),
      },
      words,
    );
  const command = `shapeviz-report build DATABASE -o OUT --bins ${FILE}`;
  return [
    element("h3", {}, "Chosen bins"),
    chosen.size === 0
      ? element("p", {}, "None is chosen yet.")
      : element(
          "p",
          {},
          `${count(chosen.size, "bin")}, one name a line. The command below builds a site whose maps compare shapes by these bins alone.`,
        ),
    chosen.size > 0 && element("pre", {}, command),
    chosen.size > 0 &&
      element(
        "p",
        { class: "row" },
        save("Save the bins", FILE, "text/plain", () => binsText(bins, work)),
      ),
    element("h3", {}, "Maps and scores"),
    element(
      "p",
      { class: "row" },
      save("Maps as CSV", "maps.csv", "text/csv", () => mapsCsv(database, originalMap, refinedMap)),
      scores && save("Scores as CSV", "scores.csv", "text/csv", () => scoresCsv(bins, scores, chosen)),
      save("All as JSON", "workbench.json", "application/json", () => allJson(database, bins, work)),
    ),
  ].filter(Boolean);
}

/**
 * One name a line, best first, under a header that says where they come from.
 * @param {Bins} bins
 * @param {Work} work
 */
function binsText(bins, { chosen, scores, words, refinedMap, address }) {
  const order =
    scores === null ? [...chosen].sort((a, b) => a - b) : [...ranked(scores)].filter((column) => chosen.has(column));
  const header = [
    `${chosen.size} ${chosen.size === 1 ? "bin" : "bins"} chosen on the Workbench of ${document.title.split(" · ").at(-1)}`,
    ...words,
    ...(refinedMap?.hitOfAll ? [`NH_s of their map ${figure(refinedMap.hitOfAll)}`] : []),
    address,
  ];
  return `${header.map((line) => `# ${line.replace(/\s+/g, " ")}`).join("\n")}\n${order.map((column) => bins.names[column]).join("\n")}\n`;
}

/**
 * @param {Database} database
 * @param {ShapeMap | null} original
 * @param {ShapeMap | null} refined
 */
function mapsCsv(database, original, refined) {
  const maps = Object.entries({ original, refined }).flatMap(([name, map]) => (map === null ? [] : [{ name, map }]));
  const header = [
    "id",
    "class",
    ...maps.flatMap(({ name }) => [`${name}:x`, `${name}:y`, `${name}:nh`, `${name}:nh_max`]),
  ];
  /** @param {number | null} value */
  const number = (value) => (value === null || Number.isNaN(value) ? "" : value);
  const rows = Array.from(database.ids, (id, index) => [
    id,
    database.groups[index] < 0 ? "" : database.className(database.groups[index]),
    ...maps.flatMap(({ map }) => [
      number(map.x[index]),
      number(map.y[index]),
      number(map.hit[index]),
      number(map.hit[index] === null ? null : highestOf(database, map, index)),
    ]),
  ]);
  return csvText([header, ...rows]);
}

/**
 * @param {Bins} bins
 * @param {Float64Array} scores
 * @param {Set<number>} chosen
 */
function scoresCsv(bins, scores, chosen) {
  const rows = [...ranked(scores)].map((column, place) => [
    bins.names[column],
    place + 1,
    scores[column],
    chosen.has(column) ? 1 : 0,
  ]);
  return csvText([["bin", "rank", "score", "chosen"], ...rows]);
}

/**
 * @param {Database} database
 * @param {Bins} bins
 * @param {Work} work
 */
function allJson(database, bins, { chosen, scores, words, originalMap, refinedMap }) {
  /** @param {number | null} value */
  const number = (value) => (value === null || Number.isNaN(value) ? null : value);
  /** @param {ShapeMap | null} one */
  const map = (one) =>
    one && {
      nh_s: one.hitOfAll,
      nh_max: rangeOf(database, one).highest,
      nh_c: Object.fromEntries(
        database.classes.map((name, group) => [name, one.hitOfClass[group]]).filter(([, hit]) => hit !== null),
      ),
      nh_c_max: Object.fromEntries(
        [...rangeOf(database, one).highestOfClass].map(([group, highest]) => [database.classes[group], highest]),
      ),
      shapes: Array.from(database.ids, (id, index) => ({
        id,
        x: number(one.x[index]),
        y: number(one.y[index]),
        nh: number(one.hit[index]),
      })).filter(({ x }) => x !== null),
    };
  const names = [...chosen].sort((a, b) => a - b).map((column) => bins.names[column]);
  const scored = scores && [...ranked(scores)].map((column) => ({ bin: bins.names[column], score: scores[column] }));
  return `${JSON.stringify({ about: words, bins: names, original: map(originalMap), refined: map(refinedMap), scores: scored }, null, 1)}\n`;
}
