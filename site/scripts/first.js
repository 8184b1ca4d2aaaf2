// Runs in the head of every page, before anything is painted.

import { applyStoredTheme } from "./theme.js";
import { openReception } from "./chunks.js";
import { trustOnlyOurselves } from "./trusted.js";

trustOnlyOurselves();
applyStoredTheme();
openReception();
