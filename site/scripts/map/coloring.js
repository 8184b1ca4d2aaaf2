// What the colour of a mark says: a class, how well a shape keeps to its class, or anything else that is known of shapes.

import { entry } from "../base/entry.js";
import { figure, numberWord, percent } from "../base/words.js";
import { NONE, numberText, valueName } from "../database/fields.js";
import { highestOf, ofAtMost, reachOf } from "../database/hit-range.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database, ShapeMap } from "../database/database.js" */
/** @import { Field } from "../database/fields.js" */

/**
 * @typedef {{ symbol: string, color: string }} Look of a mark
 *
 * What colours say. Shapes of one `kind` look the same; null is the kind of a shape that nothing is known of.
 * @typedef {object} Coloring
 * @property {string} title
 * @property {(index: number) => number | null} kindOf
 * @property {(kind: number | null) => Look} look
 * @property {(index: number) => string} textOf what is known of a shape, in words
 * @property {string} [note] a sentence on what that is
 * @property {Legend} [legend] what the colours are, where no other list on the page says it
 * @property {Naming} [naming] groups that stand together on a map, where these are not the classes
 * @property {boolean} [ofClasses] whether symbols are those of the classes all the same
 * @property {(map: ShapeMap) => Coloring} [of] the same of another map, where it is about the map that is drawn
 *
 * Shapes of one look have a line of their own; numbers have their ramp, with texts at equal distances.
 * @typedef {{ name: string, look: Look, shapes: number[] }} Line
 * @typedef {{ lines: Line[], ramp: { colors: string[], texts: string[] } | null }} Legend
 *
 * Groups with a name, of which -1 has none.
 * @typedef {object} Naming
 * @property {(index: number) => number} groupOf
 * @property {(group: number) => string} nameOf
 * @property {(group: number) => Look} lookOf
 */

/**
 * @param {Database} database
 * @returns {Naming}
 */
export function classNaming(database) {
  return {
    groupOf: (index) => database.groups[index],
    nameOf: (group) => database.className(group),
    lookOf: (group) => ({ symbol: database.symbol(group), color: database.color(group) }),
  };
}

/**
 * @param {Database} database
 * @returns {Coloring}
 */
export function classColoring(database) {
  const { lookOf } = classNaming(database);
  return {
    title: database.data.standIn ? "Cluster" : "Class",
    kindOf: (index) => database.groups[index],
    look: (group) => lookOf(group ?? -1),
    textOf: (index) => database.className(database.groups[index]),
  };
}

/**
 * @param {Database} database
 * @param {ShapeMap} map
 * @returns {Coloring}
 */
export function hitColoring(database, map) {
  return {
    title: "NH",
    kindOf: (index) => reachOf(database, map, index),
    look: (reach) => ({
      symbol: database.data.marks.plain,
      color: reach === null ? database.marks.unlabelled : between(database.marks.hit, reach),
    }),
    textOf: (index) => `${figure(map.hit[index])}${ofAtMost(highestOf(database, map, index))}`,
  };
}

/**
 * How truly maps show the neighbours of a shape.
 * @typedef {"kept" | "false" | "missing"} Trust
 */

/** @type {Record<Trust, { title: string, note: (k: string) => string }>} */
const TRUST = {
  kept: {
    title: "Neighbours kept",
    note: (k) => `Of the ${k} most alike, the share that is among the ${k} nearest on this map.`,
  },
  false: {
    title: "False neighbours",
    note: (k) =>
      `How unlike the ${k} nearest on this map are: 0\u00a0% where they are the ${k} most alike, 100\u00a0% where none of all shapes are less alike.`,
  },
  missing: {
    title: "Missing neighbours",
    note: (k) =>
      `How far away the ${k} most alike are on this map: 0\u00a0% where they are the ${k} nearest, 100\u00a0% where none of all shapes are farther.`,
  },
};

/** Where a ramp of false or of missing neighbours ends at the least, as a share. */
const LEAST_END = 0.05;

/**
 * How truly a map shows the neighbours of each shape: of the map that is drawn, on one scale for all maps.
 * @param {Database} database
 * @param {Trust} kind
 * @param {() => ShapeMap} current the map that the page shows
 * @returns {Coloring}
 */
export function trustColoring(database, kind, current) {
  const { title, note } = TRUST[kind];
  const known = database.projections.flatMap(({ faith }) => [...(faith?.false ?? []), ...(faith?.missing ?? [])]);
  const end =
    kind === "kept" ? 1 : known.reduce((most, share) => Math.max(/** @type {number} */ (most), share ?? 0), LEAST_END);
  /** @param {number} share */
  const textOf = (share) => percent(share);
  const nothing = new Array(database.count).fill(null);
  const options = { range: /** @type {[number, number]} */ ([0, /** @type {number} */ (end)]), open: kind !== "kept" };
  /** @type {WeakMap<object, Coloring>} */
  const made = new WeakMap();
  /** @param {ShapeMap} map */
  const of = (map) => {
    const numbers = map.faith?.[kind] ?? nothing;
    return entry(made, numbers, () => numberColoring(database, title, numbers, textOf, options));
  };
  const k = numberWord(current().neighbours);
  return {
    ...of(current()),
    note: note(k),
    kindOf: (index) => of(current()).kindOf(index),
    textOf: (index) => of(current()).textOf(index),
    of,
  };
}

/**
 * What a field of the database says: few values by a colour each, numbers and dates by a ramp.
 * @param {Database} database
 * @param {Field} field
 * @returns {Coloring}
 */
export function fieldColoring(database, field) {
  if (field.numbers === null) return choiceColoring(database, field);
  const unit = field.unit === "" ? "" : ` ${field.unit}`;
  return numberColoring(database, field.title, field.numbers, (number) => `${numberText(number, field)}${unit}`);
}

/**
 * How much of a shape falls into a bin, or its value.
 * @param {Database} database
 * @param {Bins} bins
 * @param {number} column
 * @param {number[]} values of all shapes
 * @returns {Coloring}
 */
export function binColoring(database, bins, column, values) {
  return { ...numberColoring(database, bins.names[column], values, bins.telling(column)), note: bins.sentence(column) };
}

/**
 * @param {Database} database
 * @param {Field} field with values
 * @returns {Coloring}
 */
function choiceColoring({ data, marks }, field) {
  const of = field.of ?? [];
  const names = field.names ?? [];
  const sizes = new Int32Array(names.length);
  for (const value of of) if (value !== NONE) sizes[value] += 1;
  const most = data.marks.categories.length;
  // Those with most shapes are told apart, and stand in the order of all.
  const told = [...names.keys()]
    .sort((a, b) => sizes[b] - sizes[a] || a - b)
    .slice(0, names.length > most ? most - 1 : most)
    .sort((a, b) => a - b);
  const placeOf = new Map(told.map((value, place) => [value, place]));
  const other = told.length;
  /** @type {Coloring["kindOf"]} */
  const kindOf = (index) => (of[index] === NONE ? null : (placeOf.get(of[index]) ?? other));
  /** @type {Coloring["look"]} */
  const look = (kind) => {
    if (kind === null) return missing({ data, marks });
    if (kind === other) return { symbol: data.marks.plain, color: marks.unlabelled };
    return { symbol: data.marks.categories[kind], color: marks.categories[kind] };
  };
  /** @param {number | null} kind */
  const shapesOf = (kind) => [...of.keys()].filter((index) => kindOf(index) === kind);
  /** @type {[number | null, string][]} */
  const kinds = [
    ...told.map((value, place) => /** @type {[number, string]} */ ([place, names[value]])),
    [other, `other (${names.length - told.length} more)`],
    [null, valueName(field, NONE)],
  ];
  const lines = kinds.map(([kind, name]) => ({ name, look: look(kind), shapes: shapesOf(kind) }));
  return {
    title: field.title,
    kindOf,
    look,
    textOf: (index) => valueName(field, of[index]),
    legend: { lines: lines.filter(({ shapes }) => shapes.length > 0), ramp: null },
    naming: {
      groupOf: (index) => placeOf.get(of[index]) ?? NONE,
      nameOf: (place) => names[told[place]],
      lookOf: look,
    },
  };
}

/** Steps of a ramp: marks of each have one stamp. */
const STEPS = 48;
/** Where on a ramp the middle of numbers lies, from 0 to 1, that lie together at its one end. */
const SKEWED = 0.25;
const TEXTS = 3;

/** @param {number | null} number */
const isKnown = (number) => Number.isFinite(number);

/**
 * @param {Database} database
 * @param {string} title
 * @param {(number | null)[] | Float64Array} numbers null, or no number, where there is none
 * @param {(number: number) => string} textOf
 * @param {object} [scale]
 * @param {[number, number] | null} [scale.range] where the ramp begins and ends, if not with the numbers
 * @param {boolean} [scale.open] whether numbers may lie beyond its end
 * @returns {Coloring}
 */
function numberColoring(database, title, numbers, textOf, { range = null, open = false } = {}) {
  const { data, marks } = database;
  const known = Float64Array.from(/** @type {number[]} */ (Array.from(numbers).filter(isKnown))).sort();
  const [least, most] = [known[0], known[known.length - 1]];
  const [low, high] = range ?? [least, most];
  const middle = known[known.length >> 1];
  // By factors and no longer by differences, where half of them would have the colours of one end, and then have not.
  const [differences, factors] = [(middle - low) / (high - low), Math.log(middle / low) / Math.log(high / low)];
  const wide = range === null && low > 0 && differences < SKEWED && factors - 0.5 < 0.5 - differences;
  /** @param {number} number */
  const lengthOf = (number) => (wide ? Math.log(number) : number);
  const span = lengthOf(high) - lengthOf(low) || 1;
  // A kind is a class and a step: the symbol says the one, the colour the other.
  /** @type {Coloring["look"]} */
  const look = (kind) => {
    if (kind === null) return missing({ data, marks });
    const group = Math.floor(kind / (STEPS + 1)) - 1;
    return { symbol: database.symbol(group), color: between(marks.ramp, (kind % (STEPS + 1)) / STEPS) };
  };
  const lacking = [...numbers.keys()].filter((index) => !isKnown(numbers[index]));
  /** @param {number} share */
  const at = (share) => (wide ? low * (high / low) ** share : low + share * (high - low));
  return {
    title,
    kindOf(index) {
      const number = numbers[index];
      if (number === null || !isKnown(number)) return null;
      const step = Math.min(Math.round(((lengthOf(number) - lengthOf(low)) / span) * STEPS), STEPS);
      return (database.groups[index] + 1) * (STEPS + 1) + step;
    },
    look,
    textOf: (index) => (isKnown(numbers[index]) ? textOf(/** @type {number} */ (numbers[index])) : "–"),
    legend: {
      lines: lacking.length > 0 ? [{ name: "no value", look: look(null), shapes: lacking }] : [],
      ramp: {
        colors: marks.ramp,
        texts:
          known.length === 0
            ? []
            : Array.from({ length: TEXTS }, (_, text) =>
                open && text === TEXTS - 1 && most > high ? `≥ ${textOf(high)}` : textOf(at(text / (TEXTS - 1))),
              ),
      },
    },
    ofClasses: true,
    // The colours of classes would be read as numbers.
    naming: {
      ...classNaming(database),
      lookOf: (group) => ({ symbol: database.symbol(group), color: marks.ink }),
    },
  };
}

/**
 * The colours of some shapes in their order, as the stops of a strip.
 * @param {Coloring} coloring
 * @param {number[]} shapes
 */
export function stripesOf({ kindOf, look }, shapes) {
  const kinds = shapes.map(kindOf).sort((one, other) => (one ?? Infinity) - (other ?? Infinity));
  return kinds.map((kind, place) => {
    const [from, to] = [place, place + 1].map((end) => `${((100 * end) / kinds.length).toFixed(2)}%`);
    return `${look(kind).color} ${from} ${to}`;
  });
}

/** Of so many shapes at most it is asked whether others like them lie about them. */
const ASKED = 400;
/** How far above chance groups have to keep together to have a place: half the way to all. */
const TOGETHER = 0.5;

/**
 * The groups that have a place on a map: there others of theirs lie about their shapes. The name of one that is strewn
 * over the map would say nothing of where it stands.
 * @param {Naming} naming
 * @param {Database} database
 * @param {number} method
 */
export function placedGroups({ groupOf }, database, method) {
  const groups = Array.from(database.ids.keys(), groupOf);
  const stride = Math.ceil(groups.length / ASKED);
  /** @type {Map<number, { near: number, own: number }>} */
  const found = new Map();
  for (let index = 0; index < groups.length; index += stride) {
    if (groups[index] < 0) continue;
    const near = database.neighbours(index, method);
    const sum = entry(found, groups[index], () => ({ near: 0, own: 0 }));
    sum.near += near.length;
    sum.own += near.filter((other) => groups[other] === groups[index]).length;
  }
  const placed = [...found].filter(([group, { near, own }]) => {
    const chance = (groups.filter((other) => other === group).length - 1) / Math.max(groups.length - 1, 1);
    return own - chance * near >= TOGETHER * (1 - chance) * near;
  });
  return new Set(placed.map(([group]) => group));
}

/**
 * The look of a shape that nothing is known of.
 * @param {Pick<Database, "data" | "marks">} database
 * @returns {Look}
 */
function missing({ data, marks }) {
  return { symbol: data.marks.missing, color: marks.unlabelled };
}

/**
 * A colour on a ramp.
 * @param {string[]} ramp written as #rrggbb, from 0 to 1
 * @param {number} share
 */
export function between(ramp, share) {
  const place = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
  const low = Math.min(Math.floor(place), ramp.length - 2);
  return mixed(ramp[low], ramp[low + 1], place - low);
}

/**
 * A colour between two, which are written as #rrggbb.
 * @param {string} one
 * @param {string} other
 * @param {number} share
 */
function mixed(one, other, share) {
  /**
   * @param {string} color
   * @param {number} at
   */
  const part = (color, at) => Number.parseInt(color.slice(at, at + 2), 16);
  return `rgb(${[1, 3, 5].map((at) => Math.round(part(one, at) + share * (part(other, at) - part(one, at)))).join(" ")})`;
}
