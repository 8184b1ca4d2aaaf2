// The About page is plain HTML; only the theme button needs a script.

import { watchTheme } from "../theme.js";

watchTheme(() => {});
