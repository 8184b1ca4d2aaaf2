// The gallery from elsewhere.

import { pageAddress } from "../place.js";
import { writeSelection } from "../selection.js";

/** The address of the gallery with some shapes selected, and none but these shown. */
export function galleryOf(model, shapes) {
  const query = new URLSearchParams([["only", ""]]);
  writeSelection(query, model, shapes);
  return pageAddress("shapes.html", query);
}
