// The table that the engine works on. Values stand in it as steps, as the site holds them, which takes half their room.

/**
 * What reads the value of a row in a column.
 * @param {FeatureValues} table
 * @param {number} column
 * @returns {(row: number) => number}
 */
export function reader({ rows, steps, most, low, high, blocks }, column) {
  const start = column * rows;
  const lowest = low[blocks[column]];
  const width = high[blocks[column]] - lowest;
  return (row) => Math.fround(lowest + (width * steps[start + row]) / most);
}

/**
 * The values of some rows in a column, in their order.
 * @param {FeatureValues} table
 * @param {number} column
 * @param {ArrayLike<number>} rows
 * @param {Float32Array} [into] as many
 */
export function valuesAt(table, column, rows, into = new Float32Array(rows.length)) {
  const read = reader(table, column);
  for (let place = 0; place < into.length; place += 1) into[place] = read(rows[place]);
  return into;
}

/**
 * Whether some rows have different values in a column.
 * @param {FeatureValues} table
 * @param {number} column
 * @param {Int32Array} rows
 */
export function differ(table, column, rows) {
  const read = reader(table, column);
  const first = read(rows[0]);
  return rows.some((row) => read(row) !== first);
}
