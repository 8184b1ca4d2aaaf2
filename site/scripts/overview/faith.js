// How far the map in view shows who is like whom, whatever labels say: in words, in a few figures, and in a diagram.

import { element, svg } from "../base/dom.js";
import { count, grouped, numberWord } from "../base/words.js";
import { measuresOf } from "../map/measures.js";

/** @import { OverviewState } from "../addresses/overview.js" */
/** @import { Database, Faith, Method } from "../database/database.js" */

/** A shape that keeps no more of its neighbours than this share is in the wrong place. */
const FEW = 0.2;

/** The units of a diagram: what is the largest distance in the features, and what stands beside it. */
const SIDE = 240;
const TEXT = 15;

/**
 * @param {Database} database
 * @param {Method} method
 * @param {OverviewState} state
 */
export function tellFaith(database, method, state) {
  const { faith, neighbours } = method;
  if (!faith) return [];
  // Of all others any map keeps all.
  if (faith.chance === 1)
    return [
      element("h3", {}, "Does it show who is like whom?"),
      element(
        "p",
        {},
        `${count(database.count, "shape")} are too few to say by their neighbours: each has all others among its ${neighbours} nearest, on any map.`,
      ),
      measuresOf(faith),
    ];
  /** @param {number} share */
  const many = (share) => (share * neighbours).toFixed(1);
  return [
    element("h3", {}, "Does it show who is like whom?"),
    element(
      "p",
      { class: "headline" },
      element("output", { class: "share" }, many(faith.mean)),
      element("span", { class: "of" }, `of ${neighbours}`),
      element("span", { class: "beside" }, element("b", {}, many(faith.chance)), element("br"), "on a map at random"),
    ),
    element(
      "p",
      {},
      `Of the ${count(neighbours, "shape")} most alike by features, so many are among the ${neighbours} nearest on this map, on average. No label has part in it.`,
    ),
    ...lost(database, method),
    colorings(method, state),
    measuresOf(faith),
  ];
}

/**
 * How many shapes keep hardly any of their neighbours, here and on the other maps.
 * @param {Database} database
 * @param {Method} method
 */
function lost(database, { faith, neighbours, base, sample }) {
  const few = Math.floor(FEW * neighbours + 1e-9);
  if (!faith?.kept || few < 1) return [];
  const rated = countOf(faith.kept, (share) => share !== null);
  /** @param {Pick<Faith, "kept"> | null | undefined} of */
  const lostOn = (of) => countOf(of?.kept ?? [], (share) => share !== null && share <= FEW + 1e-9);
  const here = lostOn(faith);
  // What a sample keeps of its neighbours is not to be set beside what all shapes keep of theirs.
  const others = sample ? [] : database.projections.filter((other, index) => index !== base && other.faith);
  const there = others.map((other) => `${numberOrNone(lostOn(other.faith))} on the ${other.title} map`);
  return [
    element(
      "p",
      {},
      `In the wrong place are shapes that keep at most ${numberWord(few)} of them: `,
      element("b", {}, `${numberOrNone(here)} of ${grouped(rated)}`),
      ` on this map${there.map((words, place) => (place === there.length - 1 ? " and " : ", ") + words).join("")}.`,
    ),
  ];
}

/**
 * @param {Exclude<Faith["kept"], null | undefined>} shares
 * @param {(share: number | null) => boolean} counts
 */
function countOf(shares, counts) {
  let sum = 0;
  for (const share of shares) if (counts(share)) sum += 1;
  return sum;
}

/** @param {number} number */
function numberOrNone(number) {
  return number === 0 ? "none" : grouped(number);
}

/**
 * The maps that show it shape by shape.
 * @param {Method} method
 * @param {OverviewState} state
 */
function colorings({ faith }, state) {
  /** @type {[string, string, string][]} */
  const ways = [
    ["map:kept", "neighbours kept", "The share of its neighbours that each shape keeps"],
    ["map:false", "false", "Where shapes stand near each other that are not alike"],
    ["map:missing", "missing", "Where alike shapes stand apart"],
  ];
  const known = faith?.trustworthiness === null ? ways.slice(0, 1) : ways;
  return element(
    "p",
    { class: "ways on-screen" },
    "Colour the map by ",
    known.map(([by, words, title], place) => [
      place > 0 && (place === known.length - 1 ? " or " : ", "),
      element(
        "button",
        { type: "button", class: "link", title, onclick: () => state.set({ view: "color", by }) },
        words,
      ),
    ]),
    known.length > 1 ? " neighbours." : ".",
  );
}

/**
 * Draw every pair of shapes by its distance in the features and on the map, where it is known.
 * @param {Method} method
 */
export function drawShepard({ faith }) {
  const node = document.getElementById("shepard");
  const { shepard = null } = faith ?? {};
  node.hidden = shepard === null;
  node.querySelector("svg")?.remove();
  if (shepard !== null) node.prepend(shepardOf(shepard));
}

/** @param {Chunk.Shepard} shepard */
function shepardOf({ columns, fit, height }) {
  const wide = SIDE / columns.length;
  const unit = SIDE / Math.max(height, 1);
  const high = (unit * height) / columns.length;
  /** @param {number} share */
  const y = (share) => SIDE - share * unit;
  const digits = Array.from({ length: 9 }, (_, place) => String(place + 1));
  const cells = digits.map((digit) => {
    const path = columns.flatMap((column, x) =>
      Array.from(column, (own, row) =>
        own === digit
          ? `M${round(x * wide)} ${round(SIDE - (row + 1) * high)}h${round(wide)}v${round(high)}h${round(-wide)}z`
          : "",
      ),
    );
    return svg("path", { d: path.join(""), "fill-opacity": Number(digit) / 9 });
  });
  const line = fit.flatMap((value, x) => (value === null ? [] : [`${round((x + 0.5) * wide)} ${round(y(value))}`]));
  return svg(
    "svg",
    {
      viewBox: `0 0 ${SIDE + TEXT} ${SIDE + TEXT + 4}`,
      role: "img",
      "aria-label": "Shepard diagram: distances on the map, upwards, against distances in the features, to the right",
    },
    svg(
      "g",
      { transform: `translate(${TEXT} 0)` },
      svg("rect", { class: "frame", x: 0, y: 0, width: SIDE, height: SIDE }),
      svg("g", { class: "cells" }, cells),
      svg("path", { class: "proportion", d: `M0 ${SIDE}L${SIDE} ${round(y(1))}` }),
      svg("polyline", { class: "fit", points: line.join(" ") }),
      svg("text", { x: SIDE / 2, y: SIDE + TEXT, "text-anchor": "middle" }, "distance in features"),
      svg(
        "text",
        { transform: `translate(-5 ${SIDE / 2}) rotate(-90)`, "text-anchor": "middle" },
        "distance on the map",
      ),
    ),
  );
}

/** @param {number} value */
function round(value) {
  return Math.round(value * 100) / 100;
}
