// What the colours of maps say, in the address of every page with maps: the classes, how well shapes keep to theirs, or a
// field or a bin, by its key. Whether there is such a one is known when its chunk is there.

/** @import { Kind, Row } from "../base/address.js" */
/** @import { Database } from "../database/database.js" */

/** What is no key of a field or a bin. */
export const OWN_COLORS = ["class", "hit"];

/**
 * @param {Pick<Database, "labelled">} database
 * @returns {Kind}
 */
export function colors({ labelled }) {
  return { read: ([word]) => (word === "hit" && !labelled ? undefined : word || undefined), write: (word) => [word] };
}

/**
 * @param {Pick<Database, "labelled">} database
 * @returns {Row}
 */
export function coloredBy(database) {
  return {
    name: "color",
    key: "color",
    kind: colors(database),
    standard: OWN_COLORS[0],
    place: true,
    words: "what colours say",
  };
}
