// Runs in the head of every page, before anything is painted.

import { openReception } from "../base/chunks.js";
import { applyStoredTheme } from "../base/theme.js";
import { watchAnchors } from "./anchors.js";
import { startWorker, trustOnlyOurselves } from "./trusted.js";

trustOnlyOurselves();
applyStoredTheme();
openReception();
watchAnchors();
// Only the script in the head may make a worker; pages ask it to.
window.shapeviz.startWorker = startWorker;
