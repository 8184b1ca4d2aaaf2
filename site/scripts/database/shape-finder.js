// A field that finds shapes by name, id or class.

import { element } from "../base/dom.js";
import { Finder } from "../base/finder.js";

/** @import { Database } from "./database.js" */

/**
 * `choose` is told of the shape.
 * @param {Database} database
 * @param {(index: number) => void} choose
 */
export function findShapes(database, choose) {
  const names = database.names.map((name) => name.toLocaleLowerCase());
  const texts = names.map((name, index) =>
    `${name}\n${database.ids[index]}\n${database.className(database.groups[index])}`.toLocaleLowerCase(),
  );
  return new Finder("shape", {
    find: (text) => {
      const whole = text.toLocaleLowerCase();
      const words = whole.split(/\s+/);
      const found = [...texts.keys()].filter((index) => words.every((word) => texts[index].includes(word)));
      // Whose name is just that, or has it, comes before those whose id or class has the words somewhere.
      /** @param {number} index */
      const rank = (index) => (names[index] === whole ? 0 : names[index].includes(whole) ? 1 : 2);
      return found.sort((a, b) => rank(a) - rank(b) || a - b);
    },
    label: (index) =>
      [
        element("bdi", {}, database.names[index]),
        " ",
        database.labelled &&
          element("span", { class: "quiet" }, element("bdi", {}, database.className(database.groups[index]))),
      ].filter(Boolean),
    choose,
  });
}
