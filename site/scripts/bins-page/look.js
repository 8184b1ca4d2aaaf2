// One bin (paper, Fig. 8): what it is in words, which classes have much of it, and pictures of it on two shapes.

import { percent } from "../bin-card.js";
import { element, swatch } from "../dom.js";
import { Finder } from "./finder.js";
import { Legend } from "./legend.js";

const MOST_PICTURED = 4;

export class Look {
  constructor(model, bins, selection, state, card) {
    Object.assign(this, { model, bins, selection, state, card });
    this.words = document.getElementById("bin-words");
    this.paintings = document.getElementById("paintings");
    this.legend = new Legend(selection);
    this.choice = document.getElementById("bin-choice");
    this.choice.addEventListener("change", () => state.set({ bin: Number(this.choice.value) }));
    new Finder("bin", {
      find: (text) => bins.find(text),
      label: (column) => [hue(bins, column), element("bdi", {}, bins.names[column]), " ", element("span", { class: "quiet" }, bins.features[bins.featureOf(column)].title)],
      choose: (column) => state.set({ bin: column }),
    });
    state.listen((changed) => {
      if (changed.has("bin") || changed.has("theme")) this.render();
    });
  }

  render() {
    const column = this.state.get("bin");
    this.#offer(column);
    this.words.replaceChildren(...this.#tell(column));
    this.paintings.replaceChildren(...this.#paint(column));
    const dimension = dimensionOf(column, this.bins);
    if (dimension === null) this.legend.clear();
    else this.legend.show(this.selection.dimensions[dimension], this.bins.binOf(column));
  }

  /** The bins of this page in a list: those of each class, and those that separate all. */
  #offer(column) {
    const { model, bins, selection } = this;
    const groups = selection.minimal.map(({ group, sets }) => [`separate ${model.className(group)}`, [...new Set(sets.flatMap((found) => found.bins))]]);
    if (selection.path.length > 0) groups.push(["separate all classes", selection.path.at(-1).bins]);
    const known = groups.some(([, columns]) => columns.includes(column));
    const option = (value) => element("option", { value }, bins.names[value]);
    this.choice.replaceChildren(
      ...(known ? [] : [option(column)]),
      ...groups.map(([label, columns]) => element("optgroup", { label }, columns.map(option))),
    );
    this.choice.value = String(column);
    this.choice.closest("label").hidden = groups.length === 0;
  }

  #tell(column) {
    const { bins, card, model } = this;
    const feature = bins.features[bins.featureOf(column)];
    const end = bins.binOf(column) < feature.bins / 2 ? ["Low values mean ", feature.lowMeans] : ["High values mean ", feature.highMeans];
    const measured = bins.isShare(column) && feature.measures !== "";
    card.know({ scores: new Float64Array(bins.count).fill(NaN), scorer: "", separated: [], others: [...model.sizes.keys()].sort((a, b) => a - b) });
    return [
      element("h3", {}, hue(bins, column), element("bdi", {}, bins.names[column])),
      element("p", { class: "sentence" }, bins.sentence(column)),
      measured && element("p", { class: "quiet" }, element("b", {}, feature.title), ": ", lowered(feature.measures), end[1] !== "" && ` ${end[0]}${end[1]}.`),
      element("p", { class: "who" }, this.#who(column)),
      element("div", { class: "bin-card" }, card.classes(column)),
    ].filter(Boolean);
  }

  /** Which classes have much of a bin, as one would say it. */
  #who(column) {
    const { bins, card, model } = this;
    if (!model.separable) return [];
    const told = bins.isShare(column) ? percent : (value) => String(Number(value.toPrecision(3))).replace("-", "−");
    const rows = card.rows(column);
    const [most, ...rest] = rows;
    const least = rest.at(-1);
    const name = (row) => element("bdi", {}, row.name);
    if (most.median === least.median) return [`In every class half of the shapes have ${told(most.median)} of it or less.`];
    const next = rest.slice(0, -1).slice(0, 2);
    return [
      "The class ", name(most), ` has most of it: half of its shapes have more than ${told(most.median)}. `,
      ...(next.length > 0 ? ["Next ", next.length > 1 ? "come " : "comes ", ...next.flatMap((row, place) => [place > 0 ? " and " : "", name(row), ` with ${told(row.median)}`]), ". "] : []),
      "Least of it has ", name(least), `, with ${told(least.median)}.`,
    ];
  }

  #paint(column) {
    const { bins, model, selection } = this;
    if (!bins.isShare(column)) return [element("p", { class: "notice" }, "This feature was brought along: it has one value a shape, and none on the surface, so there is nothing to paint.")];
    const own = selection.paintings.filter((painting) => painting.column === column).slice(0, MOST_PICTURED);
    if (own.length === 0) {
      return [element("p", { class: "quiet" }, selection.models === null ? "No pictures were drawn of this bin." : "No pictures were drawn of this bin beforehand; the 3D view shows it on any shape.")];
    }
    return own.map(({ shape, value, inside }) =>
      element(
        "button",
        { type: "button", class: "painting", "data-shape": shape, title: `${model.names[shape]}: show in the 3D view`, onclick: () => this.state.set({ shape }) },
        element("span", { class: "whose" }, shapeLine(model, bins, column, shape)),
        [["value", value, "its values in colours"], ["in the bin", inside, "what falls into the bin"]].map(([word, address, alt]) =>
          element("span", { class: "reading" }, element("img", { src: address, alt: `${model.names[shape]}, ${alt}`, width: 320, height: 320, decoding: "async" }), element("i", {}, word)),
        ),
      ),
    );
  }
}

/** Class, and how much of the bin: what stands above a picture of a shape. */
export function shapeLine(model, bins, column, shape) {
  const group = model.groups[shape];
  const value = bins.share(column, shape);
  return [
    model.labelled && swatch(model.symbol(group), model.color(group)),
    element("bdi", {}, model.labelled ? model.className(group) : model.names[shape]),
    element("span", { class: "quiet" }, bins.isShare(column) ? `${percent(value)} in the bin` : String(Number(value.toPrecision(3)))),
  ].filter(Boolean);
}

/** The number of a column's dimension among those of the descriptors; null for a feature that was brought along. */
export function dimensionOf(column, bins) {
  if (!bins.isShare(column)) return null;
  let before = 0;
  for (const feature of bins.features.slice(0, bins.featureOf(column))) if (feature.bins > 1) before += feature.dimensions;
  const { start, bins: width } = bins.features[bins.featureOf(column)];
  return before + Math.floor((column - start) / width);
}

function hue(bins, column) {
  const mark = element("i", { class: "hued" });
  mark.style.background = bins.color(column);
  return mark;
}

function lowered(text) {
  return text.charAt(0).toLocaleLowerCase() + text.slice(1);
}
