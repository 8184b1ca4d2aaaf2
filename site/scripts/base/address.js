// The state of a page in its address, as a table of which both reading and writing are made. A row says of a value of the
// state under which parameter it stands, which texts are valid there, and what holds where none is. Things stand there by
// name, not by number: a link stays good when the database grows. Of names that are not there, who reads is told.

import { lookUp } from "./missing.js";

/** @import { Miss } from "./missing.js" */

/**
 * What stands under a parameter, which may be given several times: `read` makes a value of its texts, undefined where
 * they are none, and tells `miss` of names that are not there; `write` makes texts of a value.
 * @typedef {{ read(texts: string[], miss: Miss): any, write(value: any): string[] }} Kind
 */

/**
 * What is said of every row: `standard` holds where nothing is read, and is not written. A change of a `place` is one
 * that the browser's way back leads to; what changes `often` is written when it has come to rest. What readers call it,
 * `words`, says what a link holds.
 * @typedef {{ standard?: any, place?: boolean, often?: boolean, words?: string }} Usage
 */

/**
 * A value of the state, `name`: of the `kind` of its parameter `key`, or, where one parameter is not enough, with what
 * reads it from all of them and adds it to them, and `keys` that are its own, if any. Several `names` are one value that is an object of them.
 * @typedef {{ keys: RegExp | null, read(query: URLSearchParams, miss: Miss): any, write(query: URLSearchParams, value: any): void }} Ways
 * @typedef {Usage & ({ name: string, key: string, kind: Kind } | Ways & ({ name: string } | { names: string[] }))} Row
 */

/** Parameters that mean the same on every page that has them: they go along from page to page, past those that do not. */
const COMMON =
  /^(map|features|bins|find|color|hide|hide-unlabelled|class|unlabelled|scorer|separate|from|together|select|selected|[ab](-select(ed)?)?|(is|lacks|range)\..+)$/;

/**
 * What of an address goes along to other pages.
 * @param {URLSearchParams} query
 */
export function commonTo(query) {
  return [...query].filter(([name]) => COMMON.test(name));
}

export class Address {
  /** @param {Row[]} rows in the order in which they are written */
  constructor(rows) {
    this.rows = rows;
  }

  /**
   * Whether one of these values stands in the address, in a row that is `marked`.
   * @param {Set<string>} changed
   * @param {(row: Row) => boolean | undefined} marked
   */
  has(changed, marked = (_row) => true) {
    return this.rows.some((row) => marked(row) && namesOf(row).some((name) => changed.has(name)));
  }

  /**
   * What of an address goes along but is not for this page.
   * @param {URLSearchParams} query
   */
  passing(query) {
    return commonTo(query).filter(([key]) => !this.#owns(key));
  }

  /** @param {string} key */
  #owns(key) {
    return this.rows.some((row) => ("kind" in row ? row.key === key : row.keys?.test(key)));
  }

  /**
   * What of a state is not as it is where nothing is said, in words.
   * @param {{ get(name: string): any }} state
   */
  holds(state) {
    return this.rows
      .filter((row) => new Address([row]).write(state).size > 0)
      .map(({ words }) => words)
      .filter(Boolean);
  }

  /**
   * The values of the state that the parameters of an address hold.
   * @param {URLSearchParams} query
   * @param {Miss} [miss]
   */
  read(query, miss = () => {}) {
    /** @type {Record<string, any>} */
    const values = {};
    for (const row of this.rows) {
      const found = "kind" in row ? row.kind.read(query.getAll(row.key), miss) : row.read(query, miss);
      const value = found === undefined ? row.standard : found;
      Object.assign(values, "names" in row ? value : { [row.name]: value });
    }
    for (const key of query.keys())
      if (key !== "" && !this.#owns(key) && !COMMON.test(key) && !isPlace(query, key)) miss("setting", key);
    return values;
  }

  /**
   * The parameters of a state.
   * @param {{ get(name: string): any }} state
   */
  write(state) {
    const query = new URLSearchParams();
    for (const row of this.rows) {
      const value =
        "names" in row ? Object.fromEntries(row.names.map((name) => [name, state.get(name)])) : state.get(row.name);
      if (isStandard(row, value)) continue;
      if ("kind" in row) for (const text of row.kind.write(value)) query.append(row.key, text);
      else row.write(query, value);
    }
    return query;
  }
}

/**
 * Whether an address leads to a place on the page, like `about.html#clusters`, by what may be a parameter.
 * @param {URLSearchParams} query
 * @param {string} key
 */
export function isPlace(query, key) {
  return query.get(key) === "" && query.size === 1 && globalThis.document?.getElementById(key) != null;
}

/** @param {Row} row */
function namesOf(row) {
  return "names" in row ? row.names : [row.name];
}

/**
 * @param {Row} row
 * @param {any} value
 */
function isStandard(row, value) {
  if (row.standard === undefined) return false;
  return "names" in row ? row.names.every((name) => value[name] === row.standard[name]) : value === row.standard;
}

/**
 * One of a few words; of which other ones `noun` says what would be called so, where they are names.
 * @param {string[]} words
 * @param {string} [noun]
 * @returns {Kind}
 */
export function choice(words, noun) {
  return {
    read([word], miss) {
      if (words.includes(word)) return word;
      if (noun !== undefined && word) miss(noun, word);
      return undefined;
    },
    write: (word) => [word],
  };
}

/**
 * Any text but none.
 * @type {Kind}
 */
export const text = { read: ([word]) => word || undefined, write: (word) => [word] };

/**
 * Any texts.
 * @type {Kind}
 */
export const texts = { read: (words) => new Set(words), write: (words) => [...words] };

/**
 * A parameter that says all by being there.
 * @type {Kind}
 */
export const flag = { read: (words) => words.length > 0 || undefined, write: () => [""] };

/**
 * A number between others.
 * @param {number} least
 * @param {number} most
 * @returns {Kind}
 */
export function within(least, most) {
  return {
    read([word], miss) {
      if (Number(word) >= least && Number(word) <= most) return Number(word);
      if (word) miss("setting", word);
      return undefined;
    },
    write: (number) => [String(number)],
  };
}

/**
 * The place of a name among others, from 0.
 * @param {{ indexOf(name: string): number, at(place: number): string | undefined }} names
 * @param {string} noun what each of them is
 * @returns {Kind}
 */
export function named(names, noun) {
  /** @param {string} word */
  const placeOf = (word) => {
    const place = names.indexOf(word);
    return place < 0 ? undefined : place;
  };
  return {
    read: (words, miss) => lookUp(words, placeOf, noun, miss)[0],
    write: (place) => [/** @type {string} */ (names.at(place))],
  };
}
