// Whether maps draw lines from a shape to those most alike, in the address of every page with maps.

/** @import { Row } from "../base/address.js" */

/** @type {Row} */
export const LINES = {
  name: "lines",
  key: "lines",
  kind: {
    read([word], miss) {
      if (word === "none") return false;
      if (word) miss("setting", word);
      return undefined;
    },
    write: () => ["none"],
  },
  standard: true,
  words: "lines to those most alike",
};
