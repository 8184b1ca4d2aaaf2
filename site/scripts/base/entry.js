// What a map holds under a key, made when it is first asked for.

/**
 * @template Key
 * @template Value
 * @param {{ get(key: Key): Value | undefined, set(key: Key, value: Value): unknown }} map
 * @param {Key} key
 * @param {() => Value} make never undefined
 * @returns {Value}
 */
export function entry(map, key, make) {
  const held = map.get(key);
  if (held !== undefined) return held;
  const made = make();
  map.set(key, made);
  return made;
}
