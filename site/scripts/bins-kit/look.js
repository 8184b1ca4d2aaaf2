// One bin (paper, Fig. 8): what it is in words, which classes have much of it, and pictures of it on two shapes.

import { element, swatch } from "../base/dom.js";
import { Finder } from "../base/finder.js";
import { resource } from "../base/place.js";
import { toldAs } from "../base/snapshot.js";
import { count, isolated } from "../base/words.js";
import { binName, exactly } from "./bin-name.js";
import { Legend } from "./legend.js";
import { UNPAINTED } from "./on-surface.js";
import { inSentence, kind, kinds } from "../database/kind.js";

/** @import { State } from "../base/state.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { BinCard, Row } from "./bin-card.js" */

const MOST_PICTURED = 4;
const LONGEST = 32;

export class Look {
  /**
   * @param {Database} database
   * @param {Bins} bins
   * @param {Chunk.Selection} selection
   * @param {State} state
   * @param {BinCard} card
   */
  constructor(database, bins, selection, state, card) {
    this.database = database;
    this.bins = bins;
    this.selection = selection;
    this.state = state;
    this.card = card;
    this.words = document.getElementById("bin-words");
    this.paintings = document.getElementById("paintings");
    this.legend = new Legend(selection);
    this.choice = document.getElementById("bin-choice");
    toldAs(document.getElementById("look"), () => {
      const column = state.get("bin");
      const called = bins.called[column];
      return {
        title: `${isolated(bins.names[column])}${called ? `: ${called}` : ""}`,
        words: `${bins.sentence(column)}${database.labelled ? ` A row a ${database.data.standIn ? "cluster" : "class"}: each mark is a shape, the line is the median.` : ""} ${count(bins.rows, "shape")}.`,
      };
    });
    this.choice.addEventListener("change", () => {
      const [bin, group] = this.choice.value.split(" ").map(Number);
      state.set({ bin, group: group >= 0 ? group : null });
    });
    new Finder("bin-search", "bin-found", {
      find: (text) => bins.find(text),
      prepare: () => bins.prepareToFind(),
      none: () => bins.searchHint,
      label: (column) => binName(bins, column),
      choose: (column) => state.set({ bin: column, group: null }),
    });
    state.listen((changed) => {
      if (["bin", "group", "theme"].some((name) => changed.has(name))) this.render();
    });
  }

  render() {
    const column = this.state.get("bin");
    this.#offer(column);
    this.words.replaceChildren(...this.#tell(column));
    this.paintings.replaceChildren(...this.#paint(column));
    const dimension = this.bins.dimensionOf(column);
    if (dimension === null) this.legend.clear();
    else this.legend.show(this.selection.dimensions[dimension], this.bins.binOf(column));
  }

  /**
   * The bins of this page in a list: those of each class, and those that separate all.
   * @param {number} column
   */
  #offer(column) {
    const { database, bins, selection } = this;
    /** @type {[number, string, number[]][]} */
    const lists = selection.minimal.map(({ group, sets }) => [
      group,
      database.className(group),
      [...new Set(sets.flatMap((found) => found.bins))],
    ]);
    if (selection.path.length > 0) lists.push([-1, `all ${kinds(database)}`, selection.path.at(-1).bins]);
    const group = this.state.get("group") ?? -1;
    const known = lists.some(([own, , columns]) => own === group && columns.includes(column));
    /**
     * @param {number} value
     * @param {number} own
     */
    const option = (value, own) =>
      element(
        "option",
        { value: `${value} ${own}` },
        [bins.shortName(value, LONGEST), bins.called[value]].filter(Boolean).join("  "),
      );
    this.choice.replaceChildren(
      ...(known ? [] : [option(column, group)]),
      ...lists.map(([own, name, columns]) =>
        element(
          "optgroup",
          { label: `separate ${name}` },
          columns.map((value) => option(value, own)),
        ),
      ),
    );
    this.choice.value = `${column} ${group}`;
    /** @type {Found} */ (this.choice.closest("label")).hidden = lists.length === 0;
  }

  /** @param {number} column */
  #tell(column) {
    const { bins, card, database } = this;
    const feature = bins.features[bins.featureOf(column)];
    const group = this.state.get("group");
    const groups = database.labelled ? [...database.sizes.keys()].sort((a, b) => a - b) : [];
    card.know({
      scores: new Float64Array(bins.count).fill(NaN),
      scorer: "",
      separated: groups.filter((other) => other === group),
      others: groups.filter((other) => other !== group),
    });
    return [
      element("h3", { class: "in-page" }, binName(bins, column)),
      feature.measures !== "" &&
        element("p", { class: "quiet in-page" }, element("b", {}, `${feature.title}.`), ` ${feature.measures}`),
      element("p", { class: "who" }, this.#who(column)),
      element("div", { class: "bin-card" }, card.classes(column)),
      exactly(bins, column),
    ].filter(Boolean);
  }

  /**
   * Which classes have much of a bin, as one would say it.
   * @param {number} column
   */
  #who(column) {
    const { bins, card, database } = this;
    if (!database.separable) return [];
    const told = bins.telling(column);
    const rows = card.rows(column).sort((a, b) => b.median - a.median || b.mean - a.mean);
    const [most, ...rest] = rows;
    const least = rest.at(-1);
    /** @param {Row} row */
    const name = (row) => element("bdi", {}, inSentence(database, row.name));
    const contrast = this.#contrast(column, rows, told, name);
    if (contrast !== null) return contrast;
    if (told(most.median) === told(least.median))
      return [`Every ${kind(database)} typically has the same of it: ${told(most.median)}.`];
    const next = rest.slice(0, -1).slice(0, 2);
    return [
      bins.isShare(column) ? "Most of it is on " : "It is highest in ",
      name(most),
      `: typically ${told(most.median)}`,
      ...next.flatMap((row, place) => [
        place > 0 ? " and " : `; next ${next.length > 1 ? "come" : "comes"} `,
        name(row),
        ` with ${told(row.median)}`,
      ]),
      bins.isShare(column) ? ". Least is on " : "; it is lowest in ",
      name(least),
      `, with ${told(least.median)}.`,
    ];
  }

  /**
   * For the bin of a class: how it sets this class apart from the others, and from its nearest.
   * @param {number} column
   * @param {Row[]} rows
   * @param {(share: number) => string} told
   * @param {(row: Row) => HTMLElement} name
   */
  #contrast(column, rows, told, name) {
    const own = this.selection.minimal.find(({ group }) => group === this.state.get("group"));
    if (own === undefined) return null;
    /** @param {number} group */
    const named = (group) => rows.find((row) => row.name === this.database.className(group));
    const [row, rival] = [named(own.group), named(own.other)];
    if (row === undefined || rival === undefined) return null;
    const rank = rows.indexOf(row);
    const [most, least] = [rows[0], rows.at(-1)].map(({ median }) => told(median));
    const extreme =
      rank === 0
        ? `, most of all ${kinds(this.database)}`
        : rank === rows.length - 1
          ? `, least of all ${kinds(this.database)}`
          : "";
    const place = most === least ? "" : extreme;
    const [share, other] = this.bins.tell(column, [row.median, rival.median]);
    return [
      "Typical of ",
      name(row),
      ` is ${share}${place}; of `,
      name(rival),
      `, its nearest ${kind(this.database)} on the Overview, it is ${share === other ? "as much" : other}.`,
      ...(rank > 0 && most !== told(row.median)
        ? [
            this.bins.isShare(column) ? " Most of it is on " : " It is highest in ",
            name(rows[0]),
            `, typically ${most}.`,
          ]
        : []),
    ];
  }

  /** @param {number} column */
  #paint(column) {
    const { bins, database, selection } = this;
    if (!bins.isShare(column)) return [element("p", { class: "notice" }, UNPAINTED)];
    const own = pictured(selection, database, column, this.state.get("group"));
    if (own.length === 0) {
      return [
        element(
          "p",
          { class: "quiet" },
          selection.models === null
            ? "No pictures were drawn of this bin."
            : "No pictures were drawn of this bin beforehand; the 3D view shows it on any shape.",
        ),
      ];
    }
    return own.map(({ shape, share, value, inside }) =>
      element(
        "button",
        {
          type: "button",
          class: "painting",
          "data-shape": shape,
          title: `${isolated(database.names.at(shape))}: show in the 3D view`,
          onclick: () => this.state.set({ shape }),
        },
        element("span", { class: "whose" }, shapeLine(database, bins, column, shape, share)),
        [
          ["value", value, "its values in colours"],
          ["in the bin", inside, "what falls into the bin"],
        ].map(([word, address, alt]) =>
          element(
            "span",
            { class: "reading" },
            element("img", {
              src: resource(address),
              alt: `${database.names.at(shape)}, ${alt}`,
              width: 320,
              height: 320,
              decoding: "async",
            }),
            element("i", {}, word),
          ),
        ),
      ),
    );
  }
}

/**
 * The pictures of a bin, the shape with most of it first; of one that separates a class, those that show this contrast.
 * @param {Chunk.Selection} selection
 * @param {Database} database
 * @param {number} column
 * @param {number | null} group
 */
export function pictured({ paintings, minimal }, database, column, group) {
  const own = paintings.filter((painting) => painting.column === column);
  const other = minimal.find((separated) => separated.group === group)?.other;
  const contrast = own.filter(({ shape }) => [group, other].includes(database.groups[shape]));
  return (contrast.length > 0 ? contrast : own)
    .sort((a, b) => b.share - a.share || a.shape - b.shape)
    .slice(0, MOST_PICTURED);
}

/**
 * Class, and how much of the bin, as far as that is known: what stands above a picture of a shape.
 * @param {Database} database
 * @param {Bins} bins
 * @param {number} column
 * @param {number} shape
 * @param {number} share
 */
export function shapeLine(database, bins, column, shape, share) {
  const group = database.groups[shape];
  return [
    database.labelled && swatch(database.symbol(group), database.color(group)),
    element("bdi", {}, database.labelled ? database.className(group) : database.names.at(shape)),
    !Number.isNaN(share) &&
      element("span", { class: "quiet" }, `${bins.telling(column)(share)}${bins.isShare(column) ? " in the bin" : ""}`),
  ].filter(Boolean);
}
