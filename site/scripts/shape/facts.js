// What is known of a shape, in words and figures: where it is from, its labels, its mesh.

import { chunk } from "../base/chunks.js";
import { element } from "../base/dom.js";
import { longText } from "../base/long-text.js";
import { grouped } from "../base/words.js";
import { meshFacts, surfaceFacts } from "../database/facts.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Database } from "../database/database.js" */
/** @import { ShapeLinks } from "./links.js" */

/**
 * What is said of a shape under a heading: names and values; where these are of other shapes, `shapes` are their numbers;
 * and the file of it that there may be.
 * @typedef {{ title: string, rows: [string, string][], note?: string, shapes?: number[], file?: string | null }} FactGroup
 */

/** What columns of a table are called that say whose a shape is and what may be done with it; these come first. */
const RIGHTS = ["license", "licence", "rights", "author", "creator", "attribution", "source", "url"];

const DIGITS = 4;

export class Facts {
  /**
   * @param {Database} database
   * @param {ShapeState} state
   * @param {{ links: ShapeLinks }} parts
   */
  constructor(database, state, { links }) {
    this.database = database;
    this.state = state;
    this.links = links;
    this.node = document.getElementById("facts");
    /** @type {FactGroup[]} */
    this.groups = [];
    state.listen((changed) => {
      if (changed.has("shape")) this.render();
    });
  }

  async render() {
    const shape = this.state.get("shape");
    if (shape === null) return;
    const [known, clusters] = await Promise.all([this.database.details(shape), chunk("clusters")]);
    if (this.state.get("shape") !== shape) return;
    this.groups = factGroups(this.database, shape, known, clusters);
    this.node.replaceChildren(...this.groups.map((group) => this.#section(group)));
  }

  /** @param {FactGroup} group */
  #section({ title, rows, note, shapes, file }) {
    /**
     * @param {string} name
     * @param {number} place
     */
    const named = (name, place) =>
      shapes ? this.links.link(shapes[place], { title: this.database.ids.at(shapes[place]) }, name) : name;
    return element(
      "section",
      {},
      element("h2", {}, title),
      element(
        "dl",
        {},
        rows.map(([name, value], place) => [
          element("dt", { dir: "auto" }, named(name, place)),
          element("dd", { dir: "auto" }, linked(value)),
        ]),
      ),
      note && element("p", { class: "key" }, note),
      file && element("p", { class: "on-screen" }, this.#download(file)),
    );
  }

  /** @param {string} file */
  #download(file) {
    const name = this.database.ids.at(this.state.get("shape") ?? 0).replaceAll("/", "-");
    return element("a", { href: `gltf/${file}`, download: `${name}.glb` }, "Download the surface (glTF)");
  }
}

/**
 * All facts of a shape, whose it is first.
 * @param {Database} database
 * @param {number} shape
 * @param {Chunk.ShapeDetails} known
 * @param {Chunk.Clusters | null} clusters
 * @returns {FactGroup[]}
 */
function factGroups(database, shape, known, clusters) {
  /** @param {[string, string]} parts */
  const rank = ([name]) => RIGHTS.indexOf(name.trim().toLowerCase());
  const rights = known.metadata.filter((pair) => rank(pair) >= 0).sort((a, b) => rank(a) - rank(b));
  const ofRights = new Set(rights.map(([name]) => name));
  const labels = known.labels.filter(([labeling]) => !ofRights.has(labeling));
  // A column that is a labeling is told among the labels.
  const told = new Set(labels.length > 1 ? labels.map(([labeling]) => labeling) : []);
  const others = known.metadata.filter((pair) => rank(pair) < 0 && !told.has(pair[0]));
  // Where clusters stand in for labels, the cluster stands below the name already.
  if (clusters !== null && !clusters.standIn) labels.push(["cluster", clusters.clusters[clusters.of[shape]].name]);
  const [wide, high, deep] = known.extents.map(measured);
  /** @type {FactGroup[]} */
  const groups = [
    { title: "Licence and source", rows: rights },
    {
      title: "The same shape as",
      rows: known.copies.map(([other, evidence]) => [database.names.at(other), evidence]),
      shapes: known.copies.map(([other]) => other),
    },
    { title: labels.length > 1 ? "Labels" : "", rows: labels.length > 1 ? labels : [] },
    { title: "From the database", rows: others },
    {
      title: "Shape",
      rows: [
        ["id", database.ids.at(shape)],
        ["size", `${wide} × ${high} × ${deep}`],
        ["area", measured(known.area)],
        ["volume", known.volume === null && !known.watertight ? "– (it is not closed)" : measured(known.volume)],
        ...surfaceFacts(known),
      ],
      note: "Sizes are in the units of its file.",
    },
    {
      title: "Mesh",
      rows: meshFacts(known),
      file: known.gltf,
    },
    { title: "Repairs", rows: known.repairs.map(([repair, number]) => [repair, grouped(number)]) },
  ];
  return groups.filter(({ rows }) => rows.length > 0);
}

/**
 * A value; one that is a web address, whole, as a link to it.
 * @param {string} value
 */
function linked(value) {
  if (!/^https?:\/\/\S+$/i.test(value) || !URL.canParse(value)) return longText(value);
  return element("a", { href: value, rel: "noopener noreferrer external" }, value);
}

/** @param {number | null} value */
function measured(value) {
  if (value === null) return "–";
  const rounded = Number(value.toPrecision(DIGITS));
  if (rounded !== 0 && (Math.abs(rounded) < 1e-3 || Math.abs(rounded) >= 1e7))
    return rounded.toExponential().replace("-", "−");
  return grouped(rounded);
}
