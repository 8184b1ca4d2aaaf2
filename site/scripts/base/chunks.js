// Data of a page: gzipped JSON, columns or bytes in scripts that hand it over, because pages from file:// may not fetch.

import { pause } from "./dom.js";
import { entry } from "./entry.js";

/**
 * What a chunk is, gzipped. Columns are JSON with arrays of numbers in it; stored ones are not gzipped.
 * @typedef {"json" | "columns" | "stored" | "bytes"} Kind
 *
 * A chunk as its script hands it over: so many bytes in letters of fifteen bits, which are a comment in a function. The text
 * of a function is a part of that of its script, where that of a string would be in memory once more.
 * @typedef {{ kind: Kind, length: number, holder: () => void }} Handed
 *
 * A chunk in letters of either kind, and what those from one place to another stand for.
 * @typedef {{ kind: Kind, letters: number, decode: (from: number, to: number, into?: Uint8Array<ArrayBuffer>) => Uint8Array<ArrayBuffer> }} Packed
 */

/** Called in the head: chunks may arrive before the scripts that want them. */
export function openReception() {
  /** @type {Map<string, Handed>} */
  const handed = new Map();
  window.shapeviz = {
    handed,
    // In a site of one file: what its scripts do, by their address in a folder.
    scripts: new Map(),
    receive(name, kind, length, holder) {
      handed.set(name, { kind, length, holder });
      // As long as its element is there, Chromium keeps the text of a script.
      document.currentScript?.remove();
    },
  };
}

/** @type {Map<string, Promise<any>>} */
const loaded = new Map();

/**
 * The content of a chunk, loaded when first asked for: an ArrayBuffer where it holds bytes.
 * @template {keyof Chunk.Chunks} Name
 * @param {Name} name
 * @returns {Promise<Chunk.Chunks[Name]>}
 */
export function chunk(name) {
  return entry(loaded, name, () => load(name, () => addressOf(name)));
}

/**
 * Several chunks at once.
 * @template {(keyof Chunk.Chunks)[]} Names
 * @param {Names} names
 * @returns {Promise<{ [Place in keyof Names]: Chunk.Chunks[Names[Place]] }>}
 */
export function chunks(...names) {
  return /** @type {any} */ (Promise.all(names.map(chunk)));
}

/**
 * Whether the site has a chunk.
 * @param {keyof Chunk.Chunks} name
 */
export function isThere(name) {
  return standingIn(name) !== null || addressOf(name) !== undefined;
}

/** Letters of the parts that are kept at hand, two for some ten bytes of what is in them. */
const MOST_LETTERS = 5e5;

/** @type {Map<string, { content: Promise<any>, letters: number }>} the one that was asked for last comes last */
const parts = new Map();

/**
 * A part of a chunk that comes in parts, from 0.
 * @template {keyof Chunk.Parts} Name
 * @param {Name} name
 * @param {number} number
 * @returns {Promise<Chunk.Parts[Name]>}
 */
export function part(name, number) {
  const key = `${String(name)}-${number}`;
  const found = parts.get(key) ?? loadPart(key, () => addressOf(String(name)).replace("*", String(number)));
  parts.delete(key);
  parts.set(key, found);
  return found.content;
}

/**
 * @param {string} key
 * @param {() => string} address
 */
function loadPart(key, address) {
  const made = { content: load(key, address, keep), letters: 0 };
  /** @param {Packed} packed */
  function keep({ letters }) {
    made.letters = letters;
    let all = 0;
    for (const part of parts.values()) all += part.letters;
    for (const [oldest, part] of parts) {
      if (all <= MOST_LETTERS || part === made) break;
      parts.delete(oldest);
      all -= part.letters;
    }
  }
  return made;
}

/**
 * All parts of a chunk of bytes, which are read one after the other and not kept beside the whole.
 * @param {keyof Chunk.Parts} name
 * @param {number} length of all
 * @param {number} aPart of each but the last
 */
export async function joined(name, length, aPart) {
  const whole = new Uint8Array(length);
  /** @param {number} number */
  const taking = (number) => taken(`${name}-${number}`, () => addressOf(name).replace("*", String(number)));
  let next = length > 0 ? taking(0) : null;
  for (let start = 0; next !== null; start += aPart) {
    const packed = await next;
    // The next one comes while this one is unpacked.
    next = start + aPart < length ? taking(start / aPart + 1) : null;
    await unpack(packed, whole.subarray(start, start + aPart));
  }
  return whole.buffer;
}

/**
 * Where a chunk is; of one that comes in parts a star stands for the number of the part.
 * @param {string} name
 */
function addressOf(name) {
  return JSON.parse(document.body.dataset.chunks ?? "{}")[name];
}

/**
 * The 3D model of a shape by its name in the chunk "selection", an ArrayBuffer; loaded anew each time.
 * @param {string} name
 * @returns {Promise<ArrayBuffer>}
 */
export function modelBytes(name) {
  return load(`model-${name}`, () => `models/${name}.js`);
}

/**
 * @param {string} name
 * @param {() => string} address
 * @param {(packed: Packed) => void} [arrived] is told of it before it is unpacked
 * @returns {Promise<any>}
 */
async function load(name, address, arrived = () => {}) {
  const packed = await taken(name, address);
  arrived(packed);
  const { kind, letters, decode } = packed;
  if (kind === "stored") return columnsOf(decode(0, letters).buffer);
  const content = new Uint8Array(sizeOf(packed));
  await unpack(packed, content);
  if (kind === "bytes") return content.buffer;
  if (kind === "columns") return columnsOf(content.buffer);
  return JSON.parse(new TextDecoder().decode(content));
}

/** Letters of either kind that are whole bytes; and so many of them as are decoded at a time. */
const GROUP = 16;
const DECODED = 2048 * GROUP;

/**
 * How many bytes are packed: what gzipped data ends with.
 * @param {Packed} packed
 */
function sizeOf({ letters, decode }) {
  const end = decode(Math.max(GROUP * (Math.ceil(letters / GROUP) - 2), 0), letters);
  return new DataView(end.buffer).getUint32(end.length - 4, true);
}

/** Milliseconds for which chunks are unpacked at a stretch. */
const STRETCH = 12;

let breathed = 0;

/** Let the page be drawn now and then: pieces that follow each other would keep it waiting for all chunks that come at once. */
async function breathe() {
  if (performance.now() - breathed < STRETCH) return;
  await pause();
  breathed = performance.now();
}

/**
 * Write what is in a chunk, piece by piece: decoded as a whole, it would be in memory twice.
 * @param {Packed} packed
 * @param {Uint8Array} into as long
 */
async function unpack({ letters, decode }, into) {
  const { readable, writable } = new DecompressionStream("gzip");
  const writer = writable.getWriter();
  const write = async () => {
    // One for all pieces: what was written is read by then, and memory that is left behind is not soon given back.
    const piece = new Uint8Array((15 / 8) * Math.min(DECODED, letters + GROUP));
    for (let from = 0; from < letters; from += DECODED) {
      await breathe();
      await writer.write(decode(from, Math.min(from + DECODED, letters), piece));
    }
    await writer.close();
  };
  const read = async () => {
    const reader = readable.getReader();
    let place = 0;
    for (let step = await reader.read(); !step.done; step = await reader.read()) {
      into.set(step.value, place);
      place += step.value.length;
    }
  };
  await Promise.all([write(), read()]);
}

const ARRAYS = {
  u1: Uint8Array,
  u2: Uint16Array,
  u4: Uint32Array,
  i1: Int8Array,
  i2: Int16Array,
  i4: Int32Array,
  f4: Float32Array,
  f8: Float64Array,
};

/** Arrays begin at multiples of so many bytes. */
const ALIGNMENT = 8;

/**
 * JSON with its arrays, which lie behind it, as `pack` of `writing/packing.py` lays them: views of the buffer.
 * @param {ArrayBuffer} buffer
 */
function columnsOf(buffer) {
  const [length] = new Uint32Array(buffer, 0, 1);
  const text = new TextDecoder().decode(new Uint8Array(buffer, ALIGNMENT, length));
  /** @type {{ value: any, arrays: { way: (string | number)[], type: keyof typeof ARRAYS, length: number, start: number }[] }} */
  const { value, arrays } = JSON.parse(text);
  const first = ALIGNMENT * (1 + Math.ceil(length / ALIGNMENT));
  for (const { way, type, length, start } of arrays) {
    const holder = way.slice(0, -1).reduce((node, key) => node[key], value);
    holder[/** @type {string} */ (way.at(-1))] = new ARRAYS[type](buffer, first + start, length);
  }
  return value;
}

/**
 * What holds data in a document that is the whole site.
 * @param {string} name
 */
function standingIn(name) {
  return document.getElementById(`chunk-${name}`);
}

/**
 * Data that stands in the document, in base64, where the site is one file.
 * @param {string} name
 * @returns {Packed | null}
 */
function standing(name) {
  const block = standingIn(name);
  if (block === null) return null;
  const text = block.textContent;
  return {
    kind: /** @type {Kind} */ (block.dataset.kind),
    letters: text.length,
    decode(from, to) {
      const held = atob(text.slice(from, to));
      // `Uint8Array.from` with a function takes thirty times as long, seconds for a large database.
      const bytes = new Uint8Array(held.length);
      for (let place = 0; place < held.length; place += 1) bytes[place] = held.charCodeAt(place);
      return bytes;
    },
  };
}

/**
 * @param {string} name
 * @param {() => string} address
 * @returns {Promise<Packed>}
 */
async function taken(name, address) {
  const inDocument = standing(name);
  if (inDocument !== null) return inDocument;
  const { handed } = window.shapeviz;
  if (!handed.has(name)) await addScript(address());
  const { kind, length, holder } = /** @type {Handed} */ (handed.get(name));
  handed.delete(name);
  const text = holder.toString().slice("() => {/*".length, -"*/}".length);
  return {
    kind,
    letters: text.length,
    decode: (from, to, into) =>
      bytesOf(flat(text.slice(from, to)), Math.min((to * 15) / 8, length) - (from * 15) / 8, into),
  };
}

/**
 * A text by itself: of a part of a script's text, Chromium takes ten times as long to say a letter.
 * @param {string} text
 */
const flat = (text) => ` ${text}`.slice(1);

/** The letter of fifteen bits without any set; `FIRST_LETTER` of `writing/packing.py`. */
const FIRST_LETTER = 0x100;

/**
 * What groups of letters of fifteen bits stand for: as many numbers of two bytes, the highest bit of each in the last letter.
 * @param {string} text
 * @param {number} length in bytes
 * @param {Uint8Array<ArrayBuffer>} [into] for all of them
 */
export function bytesOf(text, length, into = new Uint8Array((text.length * 15) / 8)) {
  const numbers = new Uint16Array(into.buffer);
  const last = GROUP - 1;
  for (let letter = 0, place = 0; letter < text.length; letter += GROUP) {
    const highest = text.charCodeAt(letter + last) - FIRST_LETTER;
    for (let own = 0; own < last; own += 1, place += 1)
      numbers[place] = (text.charCodeAt(letter + own) - FIRST_LETTER) | (((highest >> own) & 1) << 15);
  }
  return into.subarray(0, length);
}

/**
 * Run a script of the site.
 * @param {string} address
 * @returns {Promise<any>}
 */
export function addScript(address) {
  const standing = window.shapeviz.scripts.get(address);
  if (standing) return Promise.resolve(standing());
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = address;
    // Scripts that have run need not keep their texts.
    script.onload = () => {
      script.remove();
      resolve(undefined);
    };
    script.onerror = () => reject(new Error(`${address} is missing from the site`));
    document.head.append(script);
  });
}
