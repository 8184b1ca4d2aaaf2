// What NH can be, on `window.ranges`, with maps as pairs.

import { hitRange, shareOfRange } from "../../site/scripts/database/hit-range.js";

window.ranges = {
  hitRange(groups, k) {
    const { highest, highestOfClass, chanceOfClass } = hitRange(groups, k);
    return { highest, highestOfClass: [...highestOfClass], chanceOfClass: [...chanceOfClass] };
  },
  shareOfRange,
};
