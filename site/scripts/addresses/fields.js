// Fields of shapes in an address, by their keys.

/** @import { Miss } from "../base/missing.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Fields } from "../database/fields.js" */

/**
 * A field that is there may yet not do for everything.
 * @param {string} key
 * @param {Database} database
 * @param {Fields} fields
 * @param {Miss} miss
 */
export function missField(key, database, fields, miss) {
  if (fields.byKey.has(key)) return;
  const [, kind, name] = /^([a-z]+):(.*)$/s.exec(key) ?? [null, "", key];
  if (kind !== "nh" && kind !== "kept") miss("column", name);
  else if (!database.data.methods.some((method) => method.key === name)) miss("map", name);
}
