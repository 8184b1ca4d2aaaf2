// A map laid beside another of the same shapes: turned, and mirrored where that helps, until shapes lie about where they do
// on the other; what lies near what stays.

/** @typedef {{ x: ArrayLike<number>, y: ArrayLike<number> }} Places no numbers where a shape has none */

/**
 * @param {Places} map about its middle, as all maps are
 * @param {Places} towards
 */
export function turned(map, towards) {
  const plain = turnOf(map, towards, 1);
  const mirrored = turnOf(map, towards, -1);
  const { cos, sin, mirror } = mirrored.gain > plain.gain ? mirrored : plain;
  const { x, y } = map;
  return {
    x: Float64Array.from(x, (value, row) => cos * value - sin * mirror * y[row]),
    y: Float64Array.from(x, (value, row) => sin * value + cos * mirror * y[row]),
  };
}

/**
 * The turn that brings a map, mirrored or not, closest to another, and how close (Kabsch 1976, in the plane).
 * @param {Places} map
 * @param {Places} towards
 * @param {1 | -1} mirror
 */
function turnOf({ x, y }, towards, mirror) {
  let [along, across] = [0, 0];
  for (let row = 0; row < x.length; row += 1) {
    const own = mirror * y[row];
    along += x[row] * towards.x[row] + own * towards.y[row] || 0;
    across += x[row] * towards.y[row] - own * towards.x[row] || 0;
  }
  const gain = Math.hypot(along, across);
  return gain > 0
    ? { cos: along / gain, sin: across / gain, mirror, gain }
    : { cos: 1, sin: 0, mirror: /** @type {1 | -1} */ (1), gain };
}
