// What a reader does on the Workbench, in one place: every change of classes, features and bins is a step that can be
// taken back; every change asks anew what it makes out of date.

import { changeWords } from "../base/figures.js";
import { walk, whereabouts } from "../base/place.js";
import { count, figure, grouped } from "../base/words.js";
import { ranked } from "../bins-kit/bin-list.js";
import { Inquiry } from "../engine/inquiry.js";
import { alike, History } from "./history.js";
import { contests, separationWords } from "./separation.js";

/** @import { WorkState } from "../addresses/workbench.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database, Faith, ShapeMap } from "../database/database.js" */
/** @import { Listener } from "../engine/client.js" */
/** @import { Standing } from "../engine/inquiry.js" */
/** @import { LiveScene } from "../map/live-scene.js" */
/** @import { Answers } from "./answers.js" */
/** @import { Use, Work } from "./history.js" */

/**
 * The questions that a reader keeps asking: for the two maps, for how far these show who is like whom, for the scores of the
 * bins, and for a few bins that make a better map.
 * @typedef {"original" | "refined"} Which
 * @typedef {`${Which}Faith`} OfMap
 * @typedef {Which | OfMap | "scores" | "offer"} Question
 */

/** Fewer shapes have no map worth the name. */
export const FEWEST_SHAPES = 3;

/** @type {Standing} */
const WORKING = { kind: "working" };

/** What the state has of the work at first. */
export function nothingMade() {
  return {
    step: null,
    originalMap: null,
    originalStatus: { kind: "none" },
    originalProgress: 0,
    originalCamera: null,
    refinedMap: null,
    refinedStatus: { kind: "none" },
    refinedProgress: 0,
    refinedCamera: null,
    originalFaith: null,
    originalFaithStatus: { kind: "none" },
    originalFaithProgress: 0,
    refinedFaith: null,
    refinedFaithStatus: { kind: "none" },
    refinedFaithProgress: 0,
    scores: null,
    scoresStatus: { kind: "none" },
    scoresProgress: 0,
    offerStatus: { kind: "none" },
    offerProgress: 0,
    refused: null,
    method: 0,
    matches: null,
    opened: null,
  };
}

export class Desk {
  /**
   * @param {Database} database
   * @param {Chunk.Workbench} data
   * @param {Bins} bins
   * @param {WorkState} state
   * @param {Answers} answers
   * @param {Record<Which, LiveScene>} scenes
   * @param {(text: string) => void} announce
   */
  constructor(database, data, bins, state, answers, scenes, announce) {
    this.database = database;
    this.data = data;
    this.bins = bins;
    this.state = state;
    this.answers = answers;
    this.scenes = scenes;
    this.announce = announce;
    this.history = new History();
    this.history.take(this.#stepOf(this.#work()));
    /** @param {Question} name */
    const inquiry = (name) =>
      new Inquiry((/** @type {Standing} */ { progress = 0, ...standing }) =>
        // One for all progress: only bars care for that.
        state.set({
          [`${name}Status`]: standing.kind === "working" ? WORKING : standing,
          [`${name}Progress`]: progress,
        }),
      );
    /** @type {Record<Question, Inquiry>} */
    this.inquiries = {
      original: inquiry("original"),
      refined: inquiry("refined"),
      originalFaith: inquiry("originalFaith"),
      refinedFaith: inquiry("refinedFaith"),
      scores: inquiry("scores"),
      offer: inquiry("offer"),
    };
    const content = document.getElementById("content");
    state.listen((changed, before) => {
      if ([...changed].some((name) => name.endsWith("Status"))) content.setAttribute("aria-busy", String(this.busy));
      const { steps, way } = state.get("whereabouts");
      if (before.get("whereabouts") && before.get("whereabouts").way !== way) this.history.branch(steps);
    });
  }

  // Steps

  /**
   * Take other classes, features or bins into use, or look at them in another way. Bins of a feature that is not in use
   * go with it.
   * @param {Partial<Work>} patch
   */
  use(patch) {
    const next = { ...this.#work(), ...patch };
    const kept = [...next.bins].filter((column) => next.features.has(this.bins.featureOf(column)));
    if (kept.length < next.bins.size) next.bins = new Set(kept);
    if (alike(next, this.history.current)) return;
    // Written into the address, it is a step there, or in the place of the last one; so it is here.
    this.state.set(next);
    this.history.take(this.#stepOf(next));
    this.#renew();
  }

  /** @param {number[]} columns */
  add(columns) {
    this.use({ bins: new Set([...this.state.get("bins"), ...columns]) });
  }

  /** @param {number[]} columns */
  remove(columns) {
    const bins = new Set(this.state.get("bins"));
    for (const column of columns) bins.delete(column);
    this.use({ bins });
  }

  /** @param {number[]} columns */
  toggle(columns) {
    const bins = new Set(this.state.get("bins"));
    for (const column of columns) if (!bins.delete(column)) bins.add(column);
    this.use({ bins });
  }

  /** The columns in use, best first; none as long as there are no scores. */
  #ranked() {
    const scores = this.state.get("scores");
    return scores === null ? [] : [...ranked(scores)];
  }

  /**
   * Choose the bins with the highest scores, and no others.
   * @param {number} number
   */
  takeBest(number) {
    this.use({ bins: new Set(this.#ranked().slice(0, number)) });
  }

  /** NH of the better of the maps at hand; null as long as there is none, and without labels. */
  get reached() {
    const hits = [this.state.get("originalMap"), this.state.get("refinedMap")].map((map) => map?.hitOfAll ?? null);
    return hits[0] === null ? null : Math.max(hits[0], hits[1] ?? 0);
  }

  /** Whether a search for bins has all it needs to begin. */
  get canFind() {
    const { state } = this;
    const asked = /** @type {const} */ (["original", "refined", "offer"]);
    const working = asked.some((name) => state.get(`${name}Status`).kind === "working");
    return !working && this.reached !== null && this.#ranked().length > 0;
  }

  /** Look for a few bins whose map keeps the classes in use apart better, and choose them: never those of a worse map. */
  findBins() {
    const { state, answers } = this;
    const step = this.history.current;
    const before = this.reached ?? 0;
    const projection = state.get("projection");
    const ranking = this.#ranked();
    const key = JSON.stringify([this.#mapKey("refined", step), sorted(step.features), ranking]);
    this.inquiries.offer.ask(
      key,
      (report) => answers.choice(projection, step, ranking, report),
      (/** @type {{ columns: number[], map: ShapeMap }} */ { columns, map }) => {
        if ((map.hitOfAll ?? 0) < before) {
          state.set({ refused: { before, reached: map.hitOfAll ?? 0, bins: columns.length } });
          this.announce(`No bins were found whose map has an NH above ${figure(before)}`);
          return;
        }
        const chosen = { ...step, bins: new Set(columns) };
        this.inquiries.refined.know(this.#mapKey("refined", chosen), map);
        this.use({ bins: chosen.bins });
      },
    );
  }

  /**
   * Go to another step, as the browser's own way does.
   * @param {number} place
   */
  go(place) {
    const step = this.history.steps[place];
    if (step && place !== this.history.at) walk(step.taken - whereabouts().steps);
  }

  /**
   * The reader came to another place: by undo or redo, by the browser's own ways, or by an address written by hand.
   * @param {Work & Record<string, any>} found what the address holds
   */
  arrive({ hidden, features, bins, scorer, separation, projection, ...beside }) {
    const { history } = this;
    const { current } = history;
    this.state.set(beside);
    history.arrive(this.#stepOf({ hidden, features, bins, scorer, separation, projection }));
    if (history.current === current) return;
    const { taken: _taken, originalMap: _original, refinedMap: _refined, ...work } = history.current;
    this.state.set(work);
    this.#renew();
    this.announce(`Step ${history.at + 1} of ${history.steps.length}`);
  }

  /** @returns {Work} */
  #work() {
    const { state } = this;
    return {
      hidden: state.get("hidden"),
      features: state.get("features"),
      bins: state.get("bins"),
      scorer: state.get("scorer"),
      separation: state.get("separation"),
      projection: state.get("projection"),
    };
  }

  /** @param {Work} work */
  #stepOf(work) {
    return { ...work, taken: whereabouts().steps, originalMap: null, refinedMap: null };
  }

  /** Of how many shapes in use maps and scores are made, in words; empty where of all. */
  get sampleWords() {
    const use = { hidden: this.state.get("hidden") };
    const [taken, all] = [this.answers.shapes(use), this.answers.inUse(use)].map(({ length }) => length);
    return taken < all ? `${grouped(taken)} of ${count(all, "shape")}, each class in proportion` : "";
  }

  // Questions

  /** Ask all anew; what bins were looked for was another question. */
  #renew() {
    this.inquiries.offer.rest();
    this.state.set({ refused: null, step: this.history.current });
    this.ask();
  }

  /**
   * Ask for what is not known yet.
   * @param {Question[]} what
   */
  ask(what = ["original", "refined", "scores"]) {
    /** @type {Partial<Record<Question, () => void>>} */
    const ways = {
      original: () => this.#askMap("original"),
      refined: () => this.#askMap("refined"),
      scores: () => this.#askScores(),
      offer: () => this.findBins(),
    };
    for (const name of what) ways[name]?.();
  }

  /**
   * @param {"from" | "against"} part
   * @param {number[]} groups
   */
  separate(part, groups) {
    this.use({ separation: { ...this.state.get("separation"), [part]: new Set(groups) } });
  }

  /** Whether anything is being worked on. */
  get busy() {
    const names = /** @type {Question[]} */ (Object.keys(this.inquiries));
    return names.some((name) => this.state.get(`${name}Status`).kind === "working");
  }

  /** @param {Question} name */
  stop(name) {
    const stopped = this.inquiries[name].stop();
    if (stopped && (name === "original" || name === "refined")) this.scenes[name].rest();
    return stopped;
  }

  /** Stop all work in progress; true if there was any. */
  stopAll() {
    return /** @type {Question[]} */ (Object.keys(this.inquiries)).map((name) => this.stop(name)).some(Boolean);
  }

  /** @param {Which} which */
  #askMap(which) {
    const { state, answers, history } = this;
    const inquiry = this.inquiries[which];
    const step = history.current;
    const projection = state.get("projection");
    if (answers.shapes(step).length < FEWEST_SHAPES || (which === "refined" && step.bins.size === 0)) {
      inquiry.rest();
      this.inquiries[`${which}Faith`].rest();
      state.set({ [`${which}Map`]: null });
      return;
    }
    const key = this.#mapKey(which, step);
    const scene = this.scenes[which];
    /** @param {Listener} report */
    const start = (report) =>
      answers[which](
        projection,
        step,
        report,
        (/** @type {ArrayLike<number>} */ x, /** @type {ArrayLike<number>} */ y) => {
          if (state.get(`${which}Status`).kind === "working") scene.stream(x, y);
        },
      );
    inquiry.ask(key, start, (map) => {
      step[`${which}Map`] = map;
      const shown = state.get(`${which}Map`) === map;
      state.set({ [`${which}Map`]: map });
      if (!shown) scene.show(map);
      this.#say(which, map);
      this.#askFaith(which, key, map);
    });
  }

  /**
   * A map waits for no answer to this.
   * @param {Which} which
   * @param {string} key
   * @param {ShapeMap} map
   */
  #askFaith(which, key, map) {
    const inquiry = this.inquiries[`${which}Faith`];
    if (map.faith || map.compares === undefined) {
      inquiry.rest();
      return;
    }
    inquiry.ask(
      key,
      (report) => this.answers.faith(map, report),
      (/** @type {Faith} */ faith) => {
        map.faith = faith;
        for (const shown of this.scenes[which].database.methods) if (shown.x === map.x) shown.faith = faith;
        this.state.set({ [`${which}Faith`]: faith });
      },
    );
  }

  /**
   * What a map depends on.
   * @param {Which} which
   * @param {Use} use
   */
  #mapKey(which, { hidden, features, bins }) {
    const members = which === "original" ? features : bins;
    return [this.state.get("projection"), sorted(hidden), sorted(members)].join("|");
  }

  /**
   * @param {Which} which
   * @param {ShapeMap} map
   */
  #say(which, map) {
    if (map.hitOfAll === null) {
      this.announce(`The ${which} map is ready.`);
      return;
    }
    const before = this.state.get("originalMap")?.hitOfAll ?? null;
    const change =
      which === "refined" && before !== null ? `, ${changeWords(before, map.hitOfAll)} against the original` : "";
    this.announce(`NH of the ${which} map ${figure(map.hitOfAll)}${change}`);
  }

  #askScores() {
    const { state, answers, database } = this;
    const step = this.history.current;
    if (!database.separable) {
      this.inquiries.scores.rest();
      state.set({ scores: answers.spread(step) });
      return;
    }
    const separation = state.get("separation");
    const asked = contests(separation, answers.groups(step.hidden));
    if (asked.length === 0) {
      this.inquiries.scores.rest();
      state.set({ scores: null });
      return;
    }
    const scorer = state.get("scorer");
    if (!answers.canScore(scorer, separation, step)) {
      const { title } = /** @type {Chunk.Scorer} */ (this.data.scorers.find(({ key }) => key === scorer));
      this.inquiries.scores.rest(
        `${title} was computed with the site, for all features and every class against all the rest: ask that, or choose another scorer.`,
      );
      state.set({ scores: null });
      return;
    }
    const key = JSON.stringify([scorer, asked, sorted(step.features)]);
    this.inquiries.scores.ask(
      key,
      (report) => answers.scores(scorer, separation, step, report),
      (scores) => state.set({ scores }),
    );
  }

  /** All there is at this moment, for export. */
  work() {
    const { state, database, data, answers } = this;
    const groups = answers.groups(state.get("hidden"));
    const words = [
      `map: ${state.get("projection")}, seed ${data.seed}`,
      database.labelled &&
        `classes: ${groups.length === database.classes.length ? "all" : groups.map((group) => database.className(group)).join(", ") || "none"}`,
      database.separable &&
        `scorer: ${state.get("scorer")}, separating ${separationWords(state.get("separation"), groups, database)}`,
      this.sampleWords && `measured on ${this.sampleWords}`,
    ].filter(Boolean);
    return {
      chosen: state.get("bins"),
      scores: state.get("scores"),
      originalMap: state.get("originalMap"),
      refinedMap: state.get("refinedMap"),
      words,
      address: ownAddress(window.location),
    };
  }
}

/**
 * The address of the page with what it asks; of a file its name alone, for the folder tells of the machine it lies on.
 * @param {Location} location
 */
function ownAddress({ protocol, href, pathname, hash }) {
  return protocol === "file:" ? pathname.split("/").at(-1) + hash : href;
}

/** @param {Set<number>} members */
function sorted(members) {
  return [...members].sort((a, b) => a - b).join();
}
