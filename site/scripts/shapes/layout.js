// Where every row of the gallery lies. Numbers only: nothing is drawn here.

const GAP = 12;
/** The height of a head and of a line of text, in sizes of the reader's text. */
const HEAD = 2.5;
const LINE = 1.1875;

/** The width from which on there is room for a caption below a picture. */
const CAPTIONED = 92;

/**
 * Lay groups of shapes out in rows below each other.
 *
 * `rows` holds, from top to bottom, heads `{ block, head: true, top, height }` and rows of shapes
 * `{ block, head: false, top, height, start, end }`; `start` and `end` count within `sequence`, all shapes that are not
 * folded away; `rowOf` has the row of each of them. `blocks` holds a group each, with its `top` and `height`.
 */
export function layOut(groups, closed, { width, size, lines, text }) {
  const gap = size < CAPTIONED ? GAP / 2 : GAP;
  const columns = Math.max(Math.floor((width + gap) / (size + gap)), 1);
  const cell = Math.floor((width - gap * (columns - 1)) / columns);
  const pitch = cell + (size < CAPTIONED ? 0 : lines * LINE * text + 4) + gap;
  const [rows, blocks, sequence, rowOf] = [[], [], [], []];
  let top = 0;
  for (const [block, { key, title, rows: members }] of groups.entries()) {
    const start = top;
    const folded = title !== null && closed.has(key);
    if (title !== null) {
      rows.push({ block, head: true, top, height: HEAD * text });
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
