// What an address names and the site does not have, in one line above the page: a link from elsewhere, or from before, else
// shows something other than it promises without a word.

import { element } from "./dom.js";
import { grouped, shortened } from "./words.js";

/** @typedef {(noun: string, name: string) => void} Miss is told what would be called so, and is not there */

/** Of each kind of things, so many are named. */
const MOST_NAMED = 3;

/** In letters. */
const LONGEST = 40;

/** What more than one of a kind is called, where that is not its name with an "s". */
const MANY = new Map([
  ["class", "classes"],
  ["part of a map", "parts of a map"],
]);

/** What is no part of a database, or may be one that shapes cannot be told apart by. */
const OF_PAGE = new Set(["column", "map", "measure", "part of a map", "range", "scorer", "setting", "step", "view"]);

/** What stands for a selection that is of no names. */
export const SELECTION = "selection";

/**
 * The places of names among others, of those that are there.
 * @template Place
 * @param {string[]} names
 * @param {(name: string) => Place | undefined} find
 * @param {string} noun what one of them is
 * @param {Miss} miss
 */
export function lookUp(names, find, noun, miss) {
  /** @type {Place[]} */
  const places = [];
  for (const name of names) {
    const place = find(name);
    if (place !== undefined) places.push(place);
    else if (name !== "") miss(noun, name);
  }
  return places;
}

export class Missing {
  /** @type {Map<string, Set<string>>} */
  #missed = new Map();

  /**
   * Begin anew with another address. What it names in vain is told to the answer, at any time.
   * @returns {Miss}
   */
  begin() {
    /** @type {Map<string, Set<string>>} */
    const missed = new Map();
    this.#missed = missed;
    this.#show();
    let due = false;
    return (noun, name) => {
      if (!missed.has(noun)) missed.set(noun, new Set());
      missed.get(noun)?.add(name);
      if (due) return;
      due = true;
      queueMicrotask(() => {
        due = false;
        if (this.#missed === missed) this.#show();
      });
    };
  }

  #show() {
    const words = missingWords(this.#missed);
    document.getElementById("missing").replaceChildren(
      ...(words.length === 0
        ? []
        : [
            element(
              "p",
              { class: "stand-in" },
              words.map((word) => (typeof word === "string" ? word : ["“", element("bdi", {}, word.name), "”"])),
            ),
          ]),
    );
  }
}

/**
 * The sentence, with the names in it apart; nothing where nothing is missing.
 * @param {Map<string, Set<string>>} missed names by what would be called so
 * @returns {(string | { name: string })[]}
 */
export function missingWords(missed) {
  if (missed.size === 0) return [];
  const several = [...missed.values()].some(({ size }) => size > 1);
  /** @type {(string | { name: string })[]} */
  const words = ["This link names "];
  for (const [place, [noun, names]] of [...missed].entries()) {
    const last = place === missed.size - 1;
    if (place > 0) words.push(last ? (several ? ", and " : " and ") : ", ");
    words.push(...namesOf(noun, [...names]));
  }
  const one = missed.size === 1 && !several;
  const where = [...missed.keys()].some((noun) => OF_PAGE.has(noun))
    ? "this page does not offer"
    : `${one ? "is" : "are"} not in this database`;
  return [...words, `, which ${where}.`];
}

/**
 * "the classes “a”, “b” and 7 more".
 * @param {string} noun
 * @param {string[]} names
 */
function namesOf(noun, names) {
  if (noun === SELECTION) return ["a selection of other shapes"];
  const shown = names.slice(0, MOST_NAMED);
  const more = names.length - shown.length;
  /** @type {(string | { name: string })[]} */
  const words = [`the ${names.length === 1 ? noun : (MANY.get(noun) ?? `${noun}s`)} `];
  for (const [place, name] of shown.entries()) {
    if (place > 0) words.push(more === 0 && place === shown.length - 1 ? " and " : ", ");
    words.push({ name: shortened(name, LONGEST) });
  }
  if (more > 0) words.push(` and ${grouped(more)} more`);
  return words;
}
