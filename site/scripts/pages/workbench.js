// The Workbench.

import { watchTheme } from "../theme.js";

watchTheme(() => {});
document.documentElement.dataset.ready = "";
