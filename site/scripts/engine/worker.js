// The engine: scores bins, sets groups apart and lays out shapes in a worker, so that the page stays free.

import { placeBeside } from "./beside.js";
import { contrast } from "./contrast.js";
import { measureFaith } from "./faith.js";
import { grow } from "./growing.js";
import { measureHit } from "./hit.js";
import { layOut } from "./layout.js";
import { serve } from "./loop.js";
import { score } from "./scoring.js";

serve({ beside: placeBeside, contrast, faith: measureFaith, grow, hit: measureHit, layout: layOut, score });
