// The Bins page.

import { watchTheme } from "../theme.js";

watchTheme(() => {});
