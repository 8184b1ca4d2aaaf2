// The part of a map in view, in the address of a page with one map.

import { LARGEST_ZOOM } from "../map/scene.js";

/** @import { Usage } from "../base/address.js" */
/** @import { Camera } from "../map/scene.js" */

/** Maps lie between -1 and 1. */
const FARTHEST = 1;

/** @type {Usage & { name: string, key: string, kind: import("../base/address.js").Kind }} */
export const CAMERA = {
  name: "camera",
  key: "at",
  standard: null,
  often: true,
  words: "the zoom",
  kind: {
    read([word = ""], miss) {
      const numbers = word.split(",").map(Number);
      const [x, y, zoom] = numbers;
      const inside = Math.abs(x) <= FARTHEST && Math.abs(y) <= FARTHEST && zoom >= 1 && zoom <= LARGEST_ZOOM;
      if (numbers.length === 3 && inside) return { x, y, zoom };
      if (word !== "") miss("part of a map", word);
      return undefined;
    },
    /** @param {Camera} camera */
    write: ({ x, y, zoom }) => [[x, y, zoom].map((value) => Number(value.toPrecision(5))).join(",")],
  },
};
