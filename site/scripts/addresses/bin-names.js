// Lists of bins as short text for the address: "FPFH[14]:1-3 Agd:6", a whole dimension as "FPFH[14]", a whole feature
// as "FPFH".

import { asNamed, joinNames, wordsOf } from "./names.js";

/** @import { Miss } from "../base/missing.js" */

const REST = /^(?:\[(\d+)\])?(?::(\d+)(?:-(\d+))?)?$/;

/**
 * Columns as text; they may come in any order.
 * @param {Iterable<number>} columns
 * @param {Chunk.Feature[]} features
 */
export function shortNames(columns, features) {
  const words = [];
  for (const feature of features) {
    const { start, dimensions, bins } = feature;
    const width = dimensions * bins;
    const own = [...columns].filter((column) => column >= start && column < start + width).sort((a, b) => a - b);
    const name = joinNames([feature.name]);
    if (own.length === width) {
      words.push(name);
      continue;
    }
    for (let first = 0, next; first < own.length; first = next) {
      const dimension = Math.floor((own[first] - start) / bins);
      const end = start + (dimension + 1) * bins;
      next = first + 1;
      while (next < own.length && own[next] === own[next - 1] + 1 && own[next] < end) next += 1;
      const [low, high] = [own[first], own[next - 1]].map((column) => ((column - start) % bins) + 1);
      const place = dimensions === 1 ? name : `${name}[${dimension}]`;
      if (high - low + 1 === bins) words.push(place);
      else words.push(low === high ? `${place}:${low}` : `${place}:${low}-${high}`);
    }
  }
  return words.join(" ");
}

/**
 * The columns that such a text names; what names none is passed over.
 * @param {string | null} text
 * @param {Chunk.Feature[]} features
 * @param {Miss} [miss]
 * @returns {Set<number>}
 */
export function readShortNames(text, features, miss = () => {}) {
  const columns = new Set();
  for (const word of wordsOf(text)) {
    const own = features.flatMap((feature) => {
      const name = joinNames([feature.name]);
      const rest = word.startsWith(name) ? REST.exec(word.slice(name.length)) : null;
      return rest === null ? [] : named(feature, rest);
    });
    if (own.length === 0) miss("bin", asNamed(word));
    for (const column of own) columns.add(column);
  }
  return columns;
}

/**
 * @param {Chunk.Feature} feature
 * @param {(string | undefined)[]} rest of the word: dimension, first and last bin
 */
function named({ start, dimensions, bins }, rest) {
  const [, dimension, low, high] = rest;
  if (dimension === undefined && low !== undefined && dimensions > 1) return [];
  if (Number(dimension ?? 0) >= dimensions || Number(high ?? low ?? 1) > bins || Number(low ?? 1) < 1) return [];
  const from = start + Number(dimension ?? 0) * bins;
  const whole = dimension === undefined && low === undefined ? dimensions * bins : bins;
  const [first, last] = low === undefined ? [1, whole] : [Number(low), Number(high ?? low)];
  return Array.from({ length: Math.max(last - first + 1, 0) }, (_, place) => from + first - 1 + place);
}
