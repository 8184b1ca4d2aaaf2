// Where every row of the gallery lies. Numbers only: nothing is drawn here.

/**
 * A group of shapes as the gallery shows it; without a title where there is only one.
 * @typedef {object} Group
 * @property {string} key
 * @property {string | null} title
 * @property {string} [note]
 * @property {number | null} [group] the class that it is
 * @property {number[]} rows its shapes
 *
 * A row: the head of a group, or shapes, which count from `start` to `end` within the sequence.
 * @typedef {{ block: number, top: number, height: number, head: boolean, start: number, end: number }} Row
 *
 * @typedef {object} Layout
 * @property {Row[]} rows from top to bottom
 * @property {{ top: number, height: number, folded: boolean }[]} blocks a group each
 * @property {number[]} sequence all shapes that are not folded away
 * @property {number[]} rowOf the row of each of them
 * @property {number} columns
 * @property {number} cell
 * @property {number} gap
 * @property {boolean} captioned
 * @property {number} head
 * @property {number} height
 */

const GAP = 12;
/** The height of a head and of a line of text, in sizes of the reader's text. */
const HEAD = 2.5;
const LINE = 1.1875;

/** The width from which on there is room for a caption below a picture. */
const CAPTIONED = 92;

/**
 * Lay groups of shapes out in rows below each other.
 * @param {Group[]} groups
 * @param {Set<string>} closed keys of those that are folded away
 * @param {{ width: number, size: number, lines: number, text: number }} measures
 * @returns {Layout}
 */
export function layOut(groups, closed, { width, size, lines, text }) {
  const gap = size < CAPTIONED ? GAP / 2 : GAP;
  const columns = Math.max(Math.floor((width + gap) / (size + gap)), 1);
  const cell = Math.floor((width - gap * (columns - 1)) / columns);
  const pitch = cell + (size < CAPTIONED ? 0 : lines * LINE * text + 4) + gap;
  /** @type {Pick<Layout, "rows" | "blocks" | "sequence" | "rowOf">} */
  const { rows, blocks, sequence, rowOf } = { rows: [], blocks: [], sequence: [], rowOf: [] };
  let top = 0;
  for (const [block, { key, title, rows: members }] of groups.entries()) {
    const start = top;
    const folded = title !== null && closed.has(key);
    if (title !== null) {
      rows.push({ block, head: true, top, height: HEAD * text, start: sequence.length, end: sequence.length });
      top += HEAD * text;
    }
    for (let first = 0; first < members.length && !folded; first += columns) {
      const next = members.slice(first, first + columns);
      rows.push({ block, head: false, top, height: pitch, start: sequence.length, end: sequence.length + next.length });
      for (const member of next) {
        sequence.push(member);
        rowOf.push(rows.length - 1);
      }
      top += pitch;
    }
    if (title !== null && !folded) top += GAP;
    blocks.push({ top: start, height: top - start, folded });
  }
  return {
    rows,
    blocks,
    sequence,
    rowOf,
    columns,
    cell,
    gap,
    captioned: size >= CAPTIONED,
    head: HEAD * text,
    height: top,
  };
}

/**
 * The first row that ends below a place.
 * @param {{ top: number, height: number }[]} rows
 * @param {number} place
 */
export function rowAt(rows, place) {
  let [low, high] = [0, rows.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (rows[middle].top + rows[middle].height > place) high = middle;
    else low = middle + 1;
  }
  return low;
}
