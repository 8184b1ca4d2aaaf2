// A field that suggests shapes, with their pictures, as one types what is known of them.

import { element, picture, swatch } from "../base/dom.js";
import { Finder } from "../base/finder.js";
import { findWords, lineOf, plain, searchTexts, textsAtHand } from "./search.js";

/** @import { Database } from "./database.js" */
/** @import { Searchable } from "./search.js" */

const PICTURE = 36;

/**
 * `field` and `list` are the ids of the field and of the list below it; `choose` is told of the shape.
 * @param {Database} database
 * @param {(index: number) => void} choose
 * @param {{ field: string, list: string }} [nodes]
 */
export function findShapes(database, choose, { field, list } = { field: "shape-search", list: "shape-found" }) {
  // Names, ids and classes are at hand; labels and metadata come when somebody is about to search.
  /** @type {Searchable[] | undefined} */
  let texts;
  return new Finder(field, list, {
    find: (text) => {
      texts ??= textsAtHand(database);
      const [names] = texts;
      const whole = plain(text);
      // Whose name is just that, begins with it or has it comes before those of whom something else has the words.
      /** @type {number[][]} */
      const ranks = [[], [], [], []];
      for (const index of findWords(texts, text)) {
        const name = lineOf(names, index);
        const place = name.indexOf(whole);
        ranks[name === whole ? 0 : place === 0 ? 1 : place > 0 ? 2 : 3].push(index);
      }
      return ranks.flat();
    },
    label: (index) =>
      [
        picture(database, index, PICTURE),
        element("bdi", {}, database.names.at(index)),
        database.labelled &&
          element(
            "span",
            { class: "quiet" },
            swatch(database.symbol(database.groups[index]), database.color(database.groups[index])),
            element("bdi", {}, database.className(database.groups[index])),
          ),
      ].filter(Boolean),
    prepare: async () => {
      texts = await searchTexts(database);
    },
    choose,
  });
}
