// The state of a page in its address, as a table of which both reading and writing are made. A row says of a value of the
// state under which parameter it stands, which texts are valid there, and what holds where none is. Things stand there by
// name, not by number: a link stays good when the database grows.

/**
 * What stands under a parameter, which may be given several times: `read` makes a value of its texts, undefined where
 * they are none, and `write` makes texts of a value.
 * @typedef {{ read(texts: string[]): any, write(value: any): string[] }} Kind
 */

/**
 * A value of the state, `name`, of the `kind` of its parameter `key`; or, where one parameter is not enough, what reads
 * it from all of them and adds it to them. Several `names` are one value that is an object of them. `standard` holds
 * where nothing is read, and is not written. A change of a `place` is one that the browser's way back leads to; what
 * changes `often` is written when it has come to rest.
 * @typedef {object} Row
 * @property {string} [name]
 * @property {string[]} [names]
 * @property {string} [key]
 * @property {Kind} [kind]
 * @property {(query: URLSearchParams) => any} [read]
 * @property {(query: URLSearchParams, value: any) => void} [write]
 * @property {any} [standard]
 * @property {boolean} [place]
 * @property {boolean} [often]
 */

export class Address {
  /** @param {Row[]} rows  in the order in which they are written */
  constructor(rows) {
    this.rows = rows;
  }

  /** Whether one of these values stands in the address, in a row that has `mark`. */
  has(changed, mark = (_) => true) {
    return this.rows.some((row) => mark(row) && namesOf(row).some((name) => changed.has(name)));
  }

  /** The values of the state that the parameters of an address hold. */
  read(query) {
    const values = {};
    for (const row of this.rows) {
      const found = row.kind ? row.kind.read(query.getAll(row.key)) : row.read(query);
      const value = found === undefined ? row.standard : found;
      Object.assign(values, row.names ? value : { [row.name]: value });
    }
    return values;
  }

  /** The parameters of a state, or of a map of its values. */
  write(state) {
    const query = new URLSearchParams();
    for (const row of this.rows) {
      const value = row.names
        ? Object.fromEntries(row.names.map((name) => [name, state.get(name)]))
        : state.get(row.name);
      if (isStandard(row, value)) continue;
      if (row.kind) for (const text of row.kind.write(value)) query.append(row.key, text);
      else row.write(query, value);
    }
    return query;
  }
}

/** @param {Row} row */
function namesOf({ name, names }) {
  return names ?? [name];
}

/**
 * @param {Row} row
 * @param {any} value
 */
function isStandard({ names, standard }, value) {
  if (standard === undefined) return false;
  return names ? names.every((name) => value[name] === standard[name]) : value === standard;
}

/** One of a few words. */
export function choice(words) {
  return { read: ([word]) => (words.includes(word) ? word : undefined), write: (word) => [word] };
}

/** Any text but none. */
export const text = { read: ([word]) => word || undefined, write: (word) => [word] };

/** Any texts. */
export const texts = { read: (words) => new Set(words), write: (words) => [...words] };

/** A parameter that says all by being there. */
export const flag = { read: (words) => words.length > 0 || undefined, write: () => [""] };

/** A number between others. */
export function within(least, most) {
  const read = ([word]) => (Number(word) >= least && Number(word) <= most ? Number(word) : undefined);
  return { read, write: (number) => [String(number)] };
}

/** The place of a name among others, from 0. */
export function named(names) {
  const places = new Map(names.map((name, place) => [name, place]));
  const read = (words) => places.get(words.find((word) => places.has(word)));
  return { read, write: (place) => [names[place]] };
}
