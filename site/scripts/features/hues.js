// The colours of the Features page.

import { currentTheme, styleColor } from "../base/theme.js";

/** @import { Database } from "../database/database.js" */

/**
 * Gives the colours in the theme in use: of the features, of charts, and of what is drawn beside them.
 * @param {Chunk.Search} search
 * @param {Database} database
 */
export function hues(search, database) {
  return () => ({
    ...search.marks[currentTheme()],
    config: database.marks.config,
    ink: styleColor("ink"),
    accent: styleColor("accent"),
    ground: styleColor("paper"),
  });
}

/**
 * Colour what the template marks as of a feature.
 * @param {{ features: string[] }} hues
 */
export function paintHues({ features }) {
  for (const mark of document.querySelectorAll("[data-hue]"))
    mark.style.background = features[Number(mark.dataset.hue)];
}
