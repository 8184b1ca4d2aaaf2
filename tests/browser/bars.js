// The painter of the bars, for tests that look at its pixels.

import { paintBars, paintRows } from "../../site/scripts/bin-bars.js";

window.bars = { paintBars, paintRows };
