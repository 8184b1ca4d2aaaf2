// The map of a subset among those of the database.

/** @import { Database } from "../database/database.js" */
/** @import { Subsets } from "../database/subsets.js" */

/**
 * The index of a subset's map in the database. Shapes that the search left out have no place on it.
 * @param {Database} database
 * @param {Subsets} subsets
 * @param {number} place
 */
export async function shown(database, subsets, place) {
  const { rows } = subsets.data;
  const map = await subsets.map(place, database.classes.length);
  /**
   * @template Value
   * @param {ArrayLike<Value>} values
   * @param {Value} none
   * @returns {Value[]}
   */
  const spread = (values, none) => {
    const all = new Array(database.count).fill(none);
    for (const [index, row] of (rows ?? []).entries()) all[row] = values[index];
    return all;
  };
  if (rows === null) return database.add(map, -1);
  const faith = map.faith && { ...map.faith };
  return database.add(
    {
      ...map,
      x: spread(map.x, NaN),
      y: spread(map.y, NaN),
      hit: spread(map.hit, null),
      faith,
      async know() {
        await map.know?.();
        for (const kind of /** @type {const} */ (["kept", "false", "missing"])) {
          const shares = map.faith?.[kind];
          if (faith && shares) faith[kind] = spread(shares, null);
        }
      },
    },
    -1,
  );
}
