// What a page saves as CSV, on `window.csvText`.

import { csvText } from "../../site/scripts/tray/export.js";

window.csvText = csvText;
