// A quadtree over the points of a map: what pushes each point away from all others, with far groups taken as one
// (Barnes and Hut 1986; for t-SNE van der Maaten 2014).

/** A square counts as far if its side is at most this share of its distance. */
const OPENING = 0.7;

/** Squares are divided at most this often; points that still share one lie practically in one place. */
const DEPTH = 24;

export class Quadtree {
  /** @param {number} count number of points */
  constructor(count) {
    this.count = count;
    this.nodes = 0;
    this.room = 0;
    // Four children of each square, 0 for none: the root is nobody's child.
    this.children = new Int32Array(0);
    this.mass = new Float64Array(0);
    this.x = new Float64Array(0);
    this.y = new Float64Array(0);
    this.side = new Float64Array(0);
    this.makeRoom(4 * count);
    this.stack = new Int32Array(4 * DEPTH + 4);
  }

  /** @param {number} nodes */
  makeRoom(nodes) {
    /** @type {<Values extends { set(values: Values): void }>(array: Values, size: number) => Values} */
    const grown = (array, size) => {
      const next = new /** @type {any} */ (array).constructor(size);
      next.set(array);
      return next;
    };
    this.room = nodes;
    this.children = grown(this.children, 4 * nodes);
    this.mass = grown(this.mass, nodes);
    this.x = grown(this.x, nodes);
    this.y = grown(this.y, nodes);
    this.side = grown(this.side, nodes);
  }

  /**
   * Write the push on each point, the sum of k² (point - other) over the others with k = 1 / (1 + distance²); returns the
   * sum of k over all pairs, each counted twice.
   * @param {Float64Array} xy
   * @param {Float64Array} push
   */
  push(xy, push) {
    this.build(xy);
    const { children, mass, x, y, side, stack, count } = this;
    const limit = OPENING * OPENING;
    let normaliser = 0;
    for (let point = 0; point < count; point++) {
      const ownX = xy[2 * point],
        ownY = xy[2 * point + 1];
      let pushX = 0,
        pushY = 0,
        sum = 0;
      let open = 1;
      stack[0] = 0;
      while (open > 0) {
        const node = stack[--open];
        const toX = ownX - x[node],
          toY = ownY - y[node];
        const squared = toX * toX + toY * toY;
        // A leaf has a side of 0.
        if (side[node] * side[node] <= limit * squared || side[node] === 0) {
          const kernel = 1 / (1 + squared);
          const weight = mass[node] * kernel;
          sum += weight;
          pushX += weight * kernel * toX;
          pushY += weight * kernel * toY;
        } else {
          const first = 4 * node;
          for (let child = first; child < first + 4; child++) {
            if (children[child] > 0) stack[open++] = children[child];
          }
        }
      }
      push[2 * point] = pushX;
      push[2 * point + 1] = pushY;
      // The point itself adds 1 and no push.
      normaliser += sum - 1;
    }
    return normaliser;
  }

  /** @param {Float64Array} xy */
  build(xy) {
    let left = Infinity,
      right = -Infinity,
      bottom = Infinity,
      top = -Infinity;
    for (let at = 0; at < xy.length; at += 2) {
      left = Math.min(left, xy[at]);
      right = Math.max(right, xy[at]);
      bottom = Math.min(bottom, xy[at + 1]);
      top = Math.max(top, xy[at + 1]);
    }
    const half = Math.max(right - left, top - bottom) / 2;
    this.nodes = 0;
    const root = this.addNode(xy[0], xy[1]);
    for (let point = 1; point < this.count; point++) {
      this.insert(xy[2 * point], xy[2 * point + 1], root, (left + right) / 2, (bottom + top) / 2, half);
    }
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  addNode(x, y) {
    if (this.nodes === this.room) this.makeRoom(2 * this.room);
    const node = this.nodes++;
    this.children.fill(0, 4 * node, 4 * node + 4);
    this.mass[node] = 1;
    this.x[node] = x;
    this.y[node] = y;
    this.side[node] = 0;
    return node;
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} node
   * @param {number} middleX
   * @param {number} middleY
   * @param {number} half
   */
  insert(x, y, node, middleX, middleY, half) {
    for (let depth = 0; ; depth++) {
      if (this.side[node] === 0 && this.x[node] === x && this.y[node] === y) {
        this.mass[node] += 1;
        return;
      }
      // A leaf that holds another place becomes a square, with what it held as a child.
      if (this.side[node] === 0 && depth < DEPTH) {
        const held = this.addNode(this.x[node], this.y[node]);
        this.mass[held] = this.mass[node];
        this.children[4 * node + quarter(this.x[held], this.y[held], middleX, middleY)] = held;
        this.side[node] = 2 * half;
      }
      const mass = this.mass[node];
      this.x[node] = (this.x[node] * mass + x) / (mass + 1);
      this.y[node] = (this.y[node] * mass + y) / (mass + 1);
      this.mass[node] = mass + 1;
      if (this.side[node] === 0) return;
      const turn = quarter(x, y, middleX, middleY);
      const child = this.children[4 * node + turn];
      if (child === 0) {
        this.children[4 * node + turn] = this.addNode(x, y);
        return;
      }
      node = child;
      half /= 2;
      middleX += turn & 1 ? half : -half;
      middleY += turn & 2 ? half : -half;
    }
  }
}

/**
 * @param {number} x
 * @param {number} y
 * @param {number} middleX
 * @param {number} middleY
 */
function quarter(x, y, middleX, middleY) {
  return (x >= middleX ? 1 : 0) + (y >= middleY ? 2 : 0);
}
