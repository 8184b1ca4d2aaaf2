// Class names at their places on the map: each beside the densest part of its class, none over another.

import { svg } from "../base/dom.js";
import { shortened } from "../base/words.js";

const CELL = 8;
const HEIGHT = 18;
const CLOSE = 14;
const LONGEST = 26;
const DIRECTIONS = 12;
const DISTANCES = [0, 16, 28, 42, 58];

/** Measures texts. */
let pen = null;

export class Labels {
  #layer = svg("g", { class: "labels" });
  #placed = [];
  #widths = new Map();

  constructor(database, overlay) {
    this.database = database;
    overlay.append(this.#layer);
  }

  clear() {
    this.#placed = [];
    this.#layer.replaceChildren();
  }

  /**
   * Choose places anew.
   *
   * `points` are the visible shapes as {index, group, x, y} in pixels; `radius` is that of a mark.
   */
  place(points, width, height, radius) {
    const crowd = new Crowd(points);
    const groups = new Map();
    for (const point of points) {
      if (point.group < 0) continue;
      if (!groups.has(point.group)) groups.set(point.group, []);
      groups.get(point.group).push(point);
    }
    // Large classes first: where there is room for some names only, these help most.
    const order = [...groups].sort((a, b) => b[1].length - a[1].length || a[0] - b[0]);
    const boxes = [];
    this.#placed = [];
    for (const [group, members] of order) {
      const anchor = densest(members);
      const text = shortened(this.database.className(group), LONGEST);
      const box = this.#best(anchor, this.#width(text), crowd, group, boxes, width, height, radius);
      if (box === null) continue;
      boxes.push(box);
      this.#placed.push({ group, text, anchor: anchor.index, dx: box.x - anchor.x, dy: box.y - anchor.y });
    }
    this.#layer.replaceChildren(
      ...this.#placed.map((label) => {
        label.node = svg("text", { "text-anchor": "middle", "dominant-baseline": "central" }, label.text);
        return label.node;
      }),
    );
  }

  /** Let the names follow their shapes; `screen(index)` is where a shape is in pixels. */
  follow(screen) {
    for (const { node, anchor, dx, dy } of this.#placed) {
      const [x, y] = screen(anchor);
      node.setAttribute("x", x + dx);
      node.setAttribute("y", y + dy);
    }
  }

  #best(anchor, textWidth, crowd, group, boxes, width, height, radius) {
    let best = null;
    for (const distance of DISTANCES) {
      for (let step = 0; step < (distance === 0 ? 1 : DIRECTIONS); step += 1) {
        const angle = (2 * Math.PI * step) / DIRECTIONS - Math.PI / 2;
        const reach = distance === 0 ? 0 : distance + radius;
        const x =
          anchor.x + Math.cos(angle) * (reach + ((Math.abs(Math.cos(angle)) * textWidth) / 2) * Math.sign(reach));
        const y = anchor.y + Math.sin(angle) * reach;
        const box = {
          x,
          y,
          left: x - textWidth / 2,
          right: x + textWidth / 2,
          top: y - HEIGHT / 2,
          bottom: y + HEIGHT / 2,
        };
        if (box.left < 2 || box.right > width - 2 || box.top < 2 || box.bottom > height - 2) continue;
        if (boxes.some((other) => overlap(box, other))) continue;
        const [own, others] = crowd.within(box, group, 0);
        const [ownAround, othersAround] = crowd.within(box, group, CLOSE);
        // Covering a point costs most, a stranger's more than one's own. A name that stands among strangers would be
        // read as theirs. Distance costs a little.
        const cost = own * 4 + others * 6 + (othersAround - others) * 1.5 + (ownAround === 0 ? 6 : 0) + reach / 10;
        if (best === null || cost < best.cost) best = { ...box, cost };
      }
    }
    return best;
  }

  #width(text) {
    if (!this.#widths.has(text)) {
      const context = (pen ??= document.createElement("canvas").getContext("2d"));
      context.font = `600 13px ${getComputedStyle(document.body).fontFamily}`;
      this.#widths.set(text, context.measureText(text).width + 10);
    }
    return this.#widths.get(text);
  }
}

/** Counts of points by class in cells of the screen. */
class Crowd {
  #cells = new Map();

  constructor(points) {
    for (const { x, y, group } of points) {
      const key = cellKey(Math.floor(x / CELL), Math.floor(y / CELL));
      if (!this.#cells.has(key)) this.#cells.set(key, []);
      this.#cells.get(key).push(group);
    }
  }

  /** How many of a group and how many others lie in a box, or closer to it than a margin. */
  within(box, group, margin) {
    let [own, others] = [0, 0];
    const cell = (value) => Math.floor(value / CELL);
    for (let row = cell(box.top - margin); row <= cell(box.bottom + margin); row += 1) {
      for (let column = cell(box.left - margin); column <= cell(box.right + margin); column += 1) {
        for (const found of this.#cells.get(cellKey(column, row)) ?? []) {
          if (found === group) own += 1;
          else others += 1;
        }
      }
    }
    return [own, others];
  }
}

function cellKey(column, row) {
  return row * 100000 + column;
}

/** The member with most others of its class around it, so a name does not float between two halves of a class. */
function densest(members) {
  const size = 40;
  const counts = new Map();
  const key = (point) => cellKey(Math.floor(point.x / size), Math.floor(point.y / size));
  for (const point of members) counts.set(key(point), (counts.get(key(point)) ?? 0) + 1);
  const around = (point) => {
    const [column, row] = [Math.floor(point.x / size), Math.floor(point.y / size)];
    let sum = 0;
    for (let i = -1; i <= 1; i += 1)
      for (let j = -1; j <= 1; j += 1) sum += counts.get(cellKey(column + i, row + j)) ?? 0;
    return sum;
  };
  let [best, most] = [members[0], -1];
  for (const point of members) {
    const sum = around(point);
    if (sum > most) [best, most] = [point, sum];
  }
  // Of the crowd around it, the one nearest to its middle.
  const crowd = members.filter(
    (point) => Math.abs(point.x - best.x) < 1.5 * size && Math.abs(point.y - best.y) < 1.5 * size,
  );
  const mean = (pick) => crowd.reduce((sum, point) => sum + pick(point), 0) / crowd.length;
  const [x, y] = [mean((point) => point.x), mean((point) => point.y)];
  return crowd.reduce((a, b) => ((a.x - x) ** 2 + (a.y - y) ** 2 <= (b.x - x) ** 2 + (b.y - y) ** 2 ? a : b));
}

function overlap(a, b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}
