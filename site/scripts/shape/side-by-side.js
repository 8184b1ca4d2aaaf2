// This shape and another: where on their surfaces the distance between them lies, feature by feature and in colours.

import { calm, element, focused } from "../base/dom.js";
import { toldAs } from "../base/snapshot.js";
import { figure, shortened, wholePercent } from "../base/words.js";
import { byFeature, sumOf } from "../bins-kit/difference.js";
import { Stage } from "../bins-kit/stage.js";
import { modelsOf, TwoSurfaces } from "../bins-kit/two-surfaces.js";
import { copyEvidence } from "../database/facts.js";
import { Comparing, isNone } from "./comparing.js";

/** @import { FeaturePart, Part } from "../bins-kit/difference.js" */

const LONGEST = 40;

export class SideBySide extends Comparing {
  /**
   * @param {ConstructorParameters<typeof Comparing>[0]} known
   * @param {Chunk.Selection} selection
   */
  constructor(known, selection) {
    super(known);
    const { database, bins, state } = known;
    this.section = document.getElementById("beside");
    this.features = document.getElementById("beside-features");
    /** @param {string} id */
    const stage = (id) =>
      new Stage(document.getElementById(id), { database, load: modelsOf(selection), keys: "turn-keys" });
    this.surfaces = new TwoSurfaces(database, bins, selection, {
      stages: [stage("beside-own"), stage("beside-other")],
      legend: document.getElementById("beside-legend"),
    });
    toldAs(this.section, () => ({
      title: document.getElementById("beside-title").textContent ?? undefined,
      words: "Coloured is what one of the two has and the other lacks; the bars say which features tell them apart.",
    }));
    document.getElementById("beside-close").addEventListener("click", () => {
      state.set({ beside: null, within: "" });
      document.getElementById("similar-title").focus();
    });
    state.listen((changed) => {
      if (changed.has("shape") && !changed.has("beside") && state.get("beside") !== null)
        state.set({ beside: null, within: "" });
      if (["shape", "beside", "within", "features", "bins", "theme"].some((name) => changed.has(name))) this.render();
      if (changed.has("beside") && !this.section.hidden) this.#bringIntoSight();
    });
  }

  /** @type {Part[]} what the two in sight differ in */
  parts = [];
  /** @type {symbol | null} */
  #asked = null;

  /** This shape and the one beside it; null where there is none. */
  get pair() {
    const { state } = this;
    const [own, other] = [state.get("shape"), state.get("beside")];
    return own === null || other === null || own === other ? null : /** @type {[number, number]} */ ([own, other]);
  }

  async render() {
    const { pair } = this;
    this.section.hidden = pair === null;
    this.parts = [];
    if (pair === null) {
      this.surfaces.leave();
      for (const stage of this.surfaces.stages) stage.rest();
      return;
    }
    const asked = (this.#asked = Symbol("asked"));
    const parts = await this.#parts(pair);
    if (asked !== this.#asked || this.pair === null) return;
    this.parts = parts;
    const features = byFeature(parts, this.bins, pair);
    const within =
      features.find(({ feature }) => this.bins.features[feature].name === this.state.get("within")) ?? null;
    this.#title(pair, features.length > 0);
    this.#tell(pair, Math.sqrt(sumOf(parts)), within === null ? features : [within]);
    this.#list(features, within);
    this.surfaces.show(
      pair,
      parts.filter(({ column }) => within === null || this.bins.featureOf(column) === within.feature),
      sumOf(parts),
    );
  }

  /**
   * What the two differ in; nothing where their distance is none.
   * @param {[number, number]} pair
   */
  async #parts(pair) {
    const parts = await this.similarity.differences(...pair, this.comparison.choice);
    return isNone(Math.sqrt(sumOf(parts))) ? [] : parts;
  }

  /** Feature by feature, for the tables: `[name, share of the distance, on this shape, on the other]`. */
  rows() {
    const { pair, bins } = this;
    if (pair === null) return [];
    return byFeature(this.parts, bins, pair).map(({ feature, share, on, beside }) => [
      bins.features[feature].name,
      wholePercent(share),
      ...on.map((own) => (beside > 0 ? "–" : wholePercent(own))),
    ]);
  }

  /**
   * @param {[number, number]} pair
   * @param {boolean} differ
   */
  #title([own, other], differ) {
    const title = document.getElementById("beside-title");
    title.replaceChildren(
      ...[differ && "Where ", this.#name(own), " and ", this.#name(other), differ && " differ"].filter(Boolean),
    );
    for (const [place, row] of [own, other].entries())
      document
        .getElementById(["beside-own-name", "beside-other-name"][place])
        .replaceChildren(place === 0 ? this.#name(row) : this.links.link(row, {}, this.#name(row)));
  }

  /** @param {number} row */
  #name(row) {
    return element("bdi", {}, shortened(this.database.names.at(row), LONGEST));
  }

  /**
   * @param {[number, number]} pair
   * @param {number} distance
   * @param {FeaturePart[]} told
   */
  #tell([own, other], distance, told) {
    const words = document.getElementById("beside-words");
    const copy = element("p", { hidden: true });
    this.database.details(own).then((known) => {
      const evidence = copyEvidence(known, other);
      copy.hidden = evidence === null;
      copy.replaceChildren(this.#name(other), " is a copy of ", this.#name(own), `: ${evidence}.`);
    });
    if (told.length === 0) {
      words.replaceChildren(copy, element("p", {}, "Nothing that is compared tells the two apart."));
      return;
    }
    const [here, there] = [0, 1].map((side) => told.reduce((sum, { on }) => sum + on[side], 0));
    const nowhere = told.reduce((sum, { beside }) => sum + beside, 0);
    const one = told.length === 1 && this.bins.features[told[0].feature];
    words.replaceChildren(
      copy,
      element(
        "p",
        {},
        "Of all that sets the two apart, ",
        one && [element("bdi", {}, one.title), " makes ", element("b", {}, wholePercent(told[0].share)), ": "],
        element("b", {}, wholePercent(here)),
        " lies on ",
        this.#name(own),
        " and ",
        element("b", {}, wholePercent(there)),
        " on ",
        this.#name(other),
        nowhere > 0 && [
          ", and ",
          element("b", {}, wholePercent(nowhere)),
          " lies in what is measured of whole shapes, not of a place on them",
        ],
        ". What one has and the other lacks is coloured; what both have as much of is not.",
      ),
      element(
        "details",
        {},
        element("summary", {}, "How this is reckoned"),
        `The squared distance of the two, ${figure(distance)}², is a sum over bins. What a bin adds is dealt out evenly over all of both surfaces that falls into it, so that the colours of both add up to the distance.`,
      ),
    );
  }

  /**
   * @param {FeaturePart[]} features
   * @param {FeaturePart | null} within
   */
  #list(features, within) {
    const { bins, state } = this;
    const kept = this.features.contains(focused()) ? focused().dataset.within : null;
    const longest = features[0]?.share ?? 1;
    this.features.replaceChildren(
      ...features.map((part) => {
        const { name, title } = bins.features[part.feature];
        const bar = element("i", {});
        bar.style.width = `${(100 * part.share) / longest}%`;
        bar.style.background = bins.colorOf(part.feature);
        return element(
          "button",
          {
            type: "button",
            class: "plain difference",
            "data-within": name,
            "aria-pressed": String(part === within),
            title: "Colour both surfaces by this alone",
            onclick: () => state.set({ within: part === within ? "" : name }),
          },
          element("span", { class: "feature" }, element("bdi", {}, shortened(title, LONGEST))),
          element("span", { class: "length", "aria-hidden": "true" }, bar),
          element("span", {}, wholePercent(part.share)),
        );
      }),
    );
    if (kept) [...this.features.children].find((node) => node.dataset.within === kept)?.focus({ preventScroll: true });
  }

  #bringIntoSight() {
    this.section.scrollIntoView({ behavior: calm() ? "instant" : "smooth", block: "start" });
    document.getElementById("beside-title").focus({ preventScroll: true });
  }
}
