// Texts as the page has them.

import { Texts } from "../../site/scripts/database/texts.js";

/** As `texts_chunk` of pages/base.py makes them. */
export function textsOf(...texts) {
  const encoder = new TextEncoder();
  const lengths = Uint32Array.from(texts, (text) => encoder.encode(text).length);
  return new Texts({ bytes: encoder.encode(texts.join("\n")), lengths });
}
