// The pictures of shapes. Single files lie in the site as long as these are few; beyond, as the host of a site would not
// have so many, pictures come in parts, as figures that are saved have them at any size: a page from file:// may show a
// file of a picture, but not read it.

import { chunk, part } from "./chunks.js";
import { entry } from "./entry.js";
import { resource } from "./place.js";

/** Addresses that are kept of pictures that came in parts, more than any window shows. */
const MOST_ADDRESSES = 4000;

class Pictures {
  /** @param {Pick<Chunk.Overview, "shapes" | "partSizes">} overview */
  constructor({ shapes, partSizes }) {
    this.names = shapes.pictures;
    this.groups = shapes.groups;
    this.aPart = partSizes.pictures;
  }

  /** @type {Map<number, string>} the one that was made last comes last */
  #addresses = new Map();

  /**
   * The address of a picture; null where it has not come yet.
   * @param {number} index
   */
  at(index) {
    if (this.names !== null) return resource(`thumbnails/${this.names[index]}`);
    return this.#addresses.get(index) ?? null;
  }

  /**
   * Show the picture of a shape, as soon as it is there.
   * @param {HTMLImageElement} image
   * @param {number} index
   */
  show(image, index) {
    image.dataset.picture = String(index);
    const address = this.at(index);
    if (address !== null) image.src = address;
    else
      this.#load(index).then((made) => {
        if (image.dataset.picture === String(index)) image.src = made;
      });
  }

  /** @param {number} index */
  async #load(index) {
    const bytes = await this.bytes(index);
    const address = entry(this.#addresses, index, () => URL.createObjectURL(new Blob([bytes], { type: "image/webp" })));
    if (this.#addresses.size > MOST_ADDRESSES) {
      // What shows it keeps it.
      const [[oldest, gone]] = this.#addresses;
      URL.revokeObjectURL(gone);
      this.#addresses.delete(oldest);
    }
    return address;
  }

  /**
   * The file of a picture.
   * @param {number} index
   */
  async bytes(index) {
    this.#places ??= placesByClass(this.groups);
    const place = this.#places[index];
    const { ends, content } = await part("pictures", Math.floor(place / this.aPart));
    const within = place % this.aPart;
    return content.slice(within === 0 ? 0 : ends[within - 1], ends[within]);
  }

  /** @type {Uint32Array | null} */
  #places = null;

  /**
   * The shape of a picture that is a file, by its address; -1 for another picture.
   * @param {string} address
   */
  shapeOf(address) {
    return this.names?.indexOf(address.match(/thumbnails\/([^/]+)$/)?.[1] ?? "") ?? -1;
  }
}

/** @type {Pictures | null} those of the page, which has one database */
let ofPage = null;

/** @param {Pick<Chunk.Overview, "shapes" | "partSizes">} overview */
export function picturesOf(overview) {
  ofPage ??= new Pictures(overview);
  return ofPage;
}

/**
 * The address of a picture that the page shows: of a shape's by its number; of another the address it is known by.
 * @param {number | string} picture
 */
export function shownPicture(picture) {
  return typeof picture === "string" ? picture : (ofPage?.at(picture) ?? null);
}

/**
 * Where pictures stand among all: those of a class beside each other, as galleries have them, in the order of the shapes.
 * @param {Int32Array} groups
 */
export function placesByClass(groups) {
  const next = new Uint32Array(groups.reduce((most, group) => Math.max(most, group), 0) + 2);
  for (const group of groups) if (group + 2 < next.length) next[group + 2] += 1;
  for (let place = 1; place < next.length; place += 1) next[place] += next[place - 1];
  const places = new Uint32Array(groups.length);
  for (let index = 0; index < groups.length; index += 1) {
    places[index] = next[groups[index] + 1];
    next[groups[index] + 1] += 1;
  }
  return places;
}

/**
 * Pictures as addresses that hold them, for a drawing that is taken away: of shapes by their numbers, of others by their
 * addresses.
 * @param {Iterable<number | string>} wanted
 * @returns {Promise<Map<number | string, string>>}
 */
export async function heldPictures(wanted) {
  /** @type {Map<number | string, string>} */
  const held = new Map();
  for (const picture of wanted) {
    const shown = shownPicture(picture);
    if (shown?.startsWith("data:")) held.set(picture, shown);
    else {
      const content = await base64Of(picture);
      if (content !== undefined) held.set(picture, `data:image/webp;base64,${content}`);
    }
  }
  return held;
}

/**
 * @param {number | string} picture
 * @returns {Promise<string | undefined>}
 */
async function base64Of(picture) {
  const index = typeof picture === "number" ? picture : (ofPage?.shapeOf(picture) ?? -1);
  if (ofPage !== null && index >= 0) return btoa(String.fromCharCode(...(await ofPage.bytes(index))));
  return (await chunk("paintings"))[String(picture).split("/").slice(-2).join("/")];
}
