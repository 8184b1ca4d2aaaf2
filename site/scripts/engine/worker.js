// The engine: scores bins and lays out shapes in a worker, so that the page stays free.

import { serve } from "./loop.js";
import { measureHit } from "./hit.js";
import { layOut } from "./layout.js";
import { score } from "./scoring.js";

serve({ hit: measureHit, layout: layOut, score });
