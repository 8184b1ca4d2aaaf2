// The painter of the bars and their scale, for tests that look at pixels.

import { paintBars, paintRows } from "../../site/scripts/bins-kit/bin-bars.js";
import { BinScale } from "../../site/scripts/bins-kit/bin-scale.js";

window.bars = { paintBars, paintRows, BinScale };
