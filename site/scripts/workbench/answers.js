// Maps and scores: the ones that travel with the site where they answer the question, else computed by the engine.

import { isSame } from "../addresses/workbench.js";
import { chunk } from "../base/chunks.js";
import { numbersOfBins, numbersOfFeatures } from "../database/levels.js";
import { sampled } from "../database/sample.js";
import { Subsets } from "../database/subsets.js";
import { startEngine } from "../engine/client.js";
import { mapOf } from "../map/plot.js";
import { contests } from "./separation.js";
import { turned } from "./turned.js";

/** @import { Bins } from "../database/bins.js" */
/** @import { Database, Faith, ShapeMap } from "../database/database.js" */
/** @import { Choice } from "../database/similarity.js" */
/** @import { Engine, Job, Listener } from "../engine/client.js" */
/** @import { Use } from "./history.js" */
/** @import { Separation } from "./separation.js" */

/**
 * Places of all shapes, along x and along y.
 * @typedef {[Float32Array, Float32Array]} Places
 *
 * Takes those while a map is being made, which change until the next.
 * @typedef {(x: Float32Array, y: Float32Array) => void} Partial
 *
 * Runs a task of the engines; those of scores take turns with several.
 * @typedef {(name: string, parameters: Parameters<Engine["run"]>[1], report?: Listener, number?: number) => Promise<any>} Run
 *
 * What a map is made of, and of whom; `others` are to be placed beside these.
 * @typedef {{ method: string, shapes: Int32Array, others: Int32Array, columns: Int32Array, by: "features" | "bins" }} Layout
 */

const SCORE_STEPS = 65535;

/** At most as many engines score at once, beside the one that lays out; each holds the whole table, and all no more bytes. */
const SCORING = Math.min(Math.max((navigator.hardwareConcurrency ?? 2) - 1, 1), 3);
const HELD = 60e6;

const MOST_CONTESTS = 500;

/** A search for bins looks at no more shapes and at the best of the bins only, so that it takes seconds. */
export const SEARCHED_SHAPES = 400;
const SEARCHED_BINS = 300;
/** By whose maps the build searches bins; the promise of another is none. */
export const FOUND_BY = "tsne";

/** The part of the work on a map that its layout is, where others are placed on it. */
const LAID_OUT = 0.7;

/** More bins than this hardly raise NH: docs/method/bins-search.md. */
const FOUND_BINS = 25;

export class Answers {
  /** @type {Promise<Engine>[]} */
  #engines = [];
  /** @type {Map<string, Float64Array>} */
  #contests = new Map();

  /**
   * @param {Database} database
   * @param {Chunk.Workbench} data
   * @param {Bins} bins
   */
  constructor(database, data, bins) {
    this.database = database;
    this.data = data;
    this.bins = bins;
    this.titles = new Map(database.data.methods.map(({ key, title, note }) => [key, { title, note }]));
  }

  /**
   * An engine by its number, started when first needed, and again after it could not be started.
   * @param {number} number
   */
  #engine(number) {
    this.#engines[number] ??= this.#start().catch((error) => {
      delete this.#engines[number];
      throw error;
    });
    return this.#engines[number];
  }

  /** Start the engine of maps before it is asked for; if that fails, whoever asks will hear why. */
  warm() {
    this.#engine(0).catch(() => {});
  }

  #start() {
    return startEngine(() => this.#table(Int32Array.from({ length: this.bins.count }, (_, column) => column)));
  }

  /**
   * Some columns for an engine.
   * @param {Int32Array} columns
   * @returns {FeatureValues}
   */
  #table(columns) {
    const { bins, data } = this;
    return {
      rows: bins.rows,
      columns: columns.length,
      ...bins.stepped(columns),
      blocks: columns.map((column) => bins.featureOf(column)),
      weights: bins.features.map(({ weight }) => weight),
      scaling: data.scaling,
    };
  }

  /**
   * What an engine is to compare: columns of its table, but few bins come along, as all would take a hundred times the
   * memory.
   * @param {Int32Array} columns
   * @param {"features" | "bins"} by
   */
  #asked(columns, by) {
    return by === "features"
      ? { columns, by }
      : { table: this.#table(columns), columns: Int32Array.from(columns.keys()), by };
  }

  /**
   * The shapes of the classes in use.
   * @param {Pick<Use, "hidden">} use
   */
  inUse({ hidden }) {
    const { groups } = this.database;
    return groups.map((_, shape) => shape).filter((shape) => !hidden.has(groups[shape]));
  }

  /**
   * Those of which maps and scores are made: all, or where they are too many a sample, each class in proportion.
   * @param {Pick<Use, "hidden">} use
   * @returns {Int32Array}
   */
  shapes({ hidden }) {
    const { groups } = this.database;
    const { sample } = this.bins;
    const known = sample?.filter((shape) => !hidden.has(groups[shape])) ?? this.inUse({ hidden });
    return /** @type {Int32Array} */ (sampled(known, groups));
  }

  /**
   * Those, and the others in use.
   * @param {Pick<Use, "hidden">} use
   */
  #who(use) {
    const [shapes, inUse] = [this.shapes(use), this.inUse(use)];
    if (shapes.length === inUse.length) return { shapes, others: Int32Array.of() };
    const taken = new Set(shapes);
    return { shapes, others: inUse.filter((shape) => !taken.has(shape)) };
  }

  /**
   * Whether a map of all shapes that answers the question travels with the site.
   * @param {"original" | "refined"} which
   * @param {string} projection
   * @param {Use} use
   */
  hasMap(which, projection, { hidden, features, bins }) {
    const { database, data } = this;
    if (hidden.size > 0) return false;
    if (which === "refined") return isSame(bins, data.bins);
    if (features.size === data.features.length && data.bins === null) return true;
    const { subsets } = database.data;
    return subsets?.sample === null && subsets.method === projection;
  }

  /**
   * The columns of the features in use.
   * @param {Set<number>} features
   */
  columns(features) {
    return Int32Array.from({ length: this.bins.count }, (_, column) => column).filter((column) =>
      features.has(this.bins.featureOf(column)),
    );
  }

  /**
   * The map of the classes in use under the features in use.
   * @param {string} projection
   * @param {Use} step
   * @param {Listener} report
   * @param {Partial} partial
   * @returns {Job<ShapeMap>}
   */
  original(projection, step, report, partial) {
    /** @type {Layout} */
    const asked = { method: projection, ...this.#who(step), columns: this.columns(step.features), by: "features" };
    return this.#chain(async (run) => {
      const offline = this.hasMap("original", projection, step)
        ? await this.#offlineMap(projection, step.features)
        : null;
      return offline === null ? this.#layout(run, asked, report, partial) : this.#comparable(run, offline, step);
    });
  }

  /**
   * The map of the classes in use under the chosen bins.
   * @param {string} projection
   * @param {Use} step
   * @param {Listener} report
   * @param {Partial} partial
   * @returns {Job<ShapeMap>}
   */
  refined(projection, step, report, partial) {
    const columns = Int32Array.from(step.bins).sort();
    /** @type {Layout} */
    const asked = { method: projection, ...this.#who(step), columns, by: "bins" };
    const offline = this.hasMap("refined", projection, step) ? this.#siteMap(projection) : null;
    return this.#chain(async (run) =>
      offline === null
        ? ((await this.#foundMap(run, projection, step)) ?? this.#layout(run, asked, report, partial))
        : this.#comparable(run, offline, step),
    );
  }

  /**
   * A few bins that keep the classes in use apart, and their map: those that the build found where it searched for the
   * same classes, else those that a search among the best of the scored bins finds now.
   * @param {string} projection
   * @param {Use} step
   * @param {ArrayLike<number>} ranking columns, best first
   * @param {Listener} report
   * @returns {Job<{ columns: number[], map: ShapeMap }>}
   */
  choice(projection, step, ranking, report) {
    const known = this.foundBins(step);
    return this.#chain(async (run) => {
      const columns = known?.bins ?? (await this.#grow(run, step, ranking, report));
      /** @type {Layout} */
      const asked = {
        method: projection,
        ...this.#who(step),
        columns: Int32Array.from(columns).sort(),
        by: "bins",
      };
      const chosen = { ...step, bins: new Set(columns) };
      const map = (await this.#foundMap(run, projection, chosen)) ?? (await this.#layout(run, asked, report, () => {}));
      return { columns, map };
    });
  }

  /**
   * The bins that the build found for the classes and features in use, unless they are chosen already.
   * @param {Use} step
   */
  foundBins({ hidden, features, bins }) {
    const { found } = this.data;
    if (found === null || hidden.size > 0 || features.size < this.bins.features.length) return null;
    return isSame(bins, found.bins) ? null : found;
  }

  /**
   * The map by which the build found these bins, where it is of all shapes: another run would place them a little
   * differently, and reach another NH than was told. Null for others.
   * @param {Run} run
   * @param {string} projection
   * @param {Use} step
   */
  async #foundMap(run, projection, step) {
    const { found } = this.data;
    if (found === null || projection !== FOUND_BY || step.hidden.size > 0) return null;
    if (!isSame(step.bins, found.bins)) return null;
    const selection = await chunk("selection");
    const last = selection.path.at(-1);
    if (selection.rows !== null || last === undefined) return null;
    const base = this.#siteMap(projection);
    const map = mapOf(last, selection);
    const { x, y } = base === null ? map : turned(map, base);
    const who = this.#who(step);
    // Told is what the unrounded map reaches.
    const columns = Int32Array.from(found.bins).sort();
    return {
      ...(await this.#measured(
        run,
        { method: projection, ...who, columns, by: "bins" },
        placesOf({ x, y }, who.shapes),
      )),
      hitOfAll: found.nh,
    };
  }

  /**
   * @param {Run} run
   * @param {Use} step
   * @param {ArrayLike<number>} ranking
   * @param {Listener} report
   * @returns {Promise<number[]>}
   */
  async #grow(run, step, ranking, report) {
    const { groups } = this.database;
    const shapes = sampled(this.shapes(step), groups, SEARCHED_SHAPES);
    const columns = Int32Array.from(ranking).slice(0, SEARCHED_BINS);
    const task = {
      rows: this.#rows(shapes),
      ...this.#asked(columns, "bins"),
      groups: Int32Array.from(shapes, (shape) => groups[shape]),
      k: this.data.neighbours,
      limit: FOUND_BINS,
    };
    const found = await run("grow", task, report, 1);
    return Array.from(found.columns, (place) => columns[place]);
  }

  /**
   * Whether a question for scores can be answered: not every scorer runs in the browser.
   * @param {string} scorer
   * @param {Separation} separation
   * @param {Use} step
   */
  canScore(scorer, separation, { hidden, features }) {
    const live = this.data.scorers.some((known) => known.key === scorer && known.live);
    return live || this.#isScored(separation, hidden, features);
  }

  /**
   * Relative scores of all columns; no numbers for those of features that are not in use.
   * @param {string} scorer
   * @param {Separation} separation
   * @param {Use} step
   * @param {Listener} report
   * @returns {Job<Float64Array>}
   */
  scores(scorer, separation, step, report) {
    const { hidden, features } = step;
    const offline = this.#offlineScores(scorer, separation, hidden, features);
    if (offline !== null) return { done: offline, cancel: () => {} };
    const columns = this.columns(features);
    const groups = this.groups(hidden);
    const shapes = this.shapes(step);
    /** @param {number[]} chosen */
    const rowsOf = (chosen) => this.#rows(shapes.filter((shape) => chosen.includes(this.database.groups[shape])));
    const asked = contests(separation, groups);
    const done = new Array(asked.length).fill(0);
    /**
     * @param {number} number
     * @param {number} progress
     */
    const tell = (number, progress) => {
      done[number] = progress;
      report({ progress: done.reduce((sum, share) => sum + share, 0) / asked.length });
    };
    return this.#chain(async (run) => {
      /** @type {Float64Array[]} */
      const found = [];
      let next = 0;
      // Contests know nothing of each other, so several engines share them.
      /** @param {number} engine */
      const lane = async (engine) => {
        for (let number = next++; number < asked.length; number = next++) {
          const { positive, negative } = asked[number];
          const key = JSON.stringify([scorer, positive, negative, [...features].sort()]);
          let scores = this.#contests.get(key);
          if (scores === undefined) {
            const contest = { positive: rowsOf(positive), negative: rowsOf(negative) };
            const task = { method: scorer, contests: [contest], columns, seed: this.data.seed };
            const answer = await run("score", task, ({ progress }) => tell(number, progress), engine);
            scores = /** @type {Float64Array} */ (answer.scores);
            this.#remember(key, scores);
          }
          found[number] = scores;
          tell(number, 1);
        }
      };
      const held = Math.max(Math.floor(HELD / this.bins.steps.byteLength), 1);
      await Promise.all(Array.from({ length: Math.min(SCORING, held, asked.length) }, (_, place) => lane(1 + place)));
      const all = new Float64Array(this.bins.count).fill(NaN);
      for (const [place, column] of columns.entries()) {
        all[column] = found.reduce((sum, scores) => sum + scores[place], 0) / found.length;
      }
      return all;
    });
  }

  /**
   * @param {string} key
   * @param {Float64Array} scores
   */
  #remember(key, scores) {
    this.#contests.set(key, scores);
    if (this.#contests.size > MOST_CONTESTS) this.#contests.delete([...this.#contests.keys()][0]);
  }

  /**
   * Without labels nothing is to be separated; then a bin says most where shapes differ most.
   * @param {Pick<Use, "features">} use
   */
  spread({ features }) {
    const all = new Float64Array(this.bins.count).fill(NaN);
    for (const column of this.columns(features)) {
      const values = this.bins.column(column);
      const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
      all[column] = Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / values.length);
    }
    const most = all.reduce((highest, value) => Math.max(highest, value || 0), 0) || 1;
    return all.map((value) => value / most);
  }

  /**
   * Classes in use that have a shape.
   * @param {Set<number>} hidden
   */
  groups(hidden) {
    return this.database.classes.map((_, group) => group).filter((group) => !hidden.has(group));
  }

  /**
   * The map of all shapes under some features, if it travels with the site.
   * @param {string} projection
   * @param {Set<number>} features
   * @returns {Promise<ShapeMap | null>}
   */
  async #offlineMap(projection, features) {
    const { database, bins } = this;
    const { subsets } = database.data;
    if (features.size === bins.features.length && this.data.bins === null) return this.#siteMap(projection);
    if (subsets?.sample !== null || subsets.method !== projection) return null;
    const searched = new Subsets(await chunk("search"));
    const place = searched.find([...features].map((feature) => bins.features[feature].name));
    return place === undefined ? null : searched.map(place, database);
  }

  /**
   * The map that the whole site shows.
   * @param {string} projection
   */
  #siteMap(projection) {
    return this.database.projections.find(({ key }) => key === projection) ?? null;
  }

  /**
   * Whether the site has the scores that are asked for.
   * @param {Separation} separation
   * @param {Set<number>} hidden
   * @param {Set<number>} features
   */
  #isScored(separation, hidden, features) {
    const { data, database, bins } = this;
    const groups = database.classes.map((_, group) => group);
    const single = contests(separation, groups).every(
      ({ positive, negative }) => positive.length === 1 && negative.length === groups.length - 1,
    );
    return (
      data.scored && single && !groups.some((group) => hidden.has(group)) && features.size === bins.features.length
    );
  }

  /**
   * @param {string} scorer
   * @param {Separation} separation
   * @param {Set<number>} hidden
   * @param {Set<number>} features
   */
  #offlineScores(scorer, separation, hidden, features) {
    const { data, database } = this;
    if (!this.#isScored(separation, hidden, features)) return null;
    const groups = database.classes.map((_, group) => group);
    const asked = contests(separation, groups).map(({ positive: [group] }) => group);
    return this.#meanOfClasses(
      data.scorers.findIndex(({ key }) => key === scorer),
      asked,
    );
  }

  /**
   * @param {number} method
   * @param {number[]} groups
   */
  async #meanOfClasses(method, groups) {
    const steps = new Uint16Array(await chunk("scores"));
    const { count } = this.bins;
    const scores = new Float64Array(count);
    for (const group of groups) {
      const start = (method * this.database.classes.length + group) * count;
      for (let column = 0; column < count; column += 1)
        scores[column] += steps[start + column] / SCORE_STEPS / groups.length;
    }
    return scores;
  }

  /**
   * Lay out some shapes, then measure the map.
   * @param {Run} run
   * @param {Layout} layout
   * @param {Listener} report
   * @param {Partial} partial
   * @returns {Promise<ShapeMap>}
   */
  async #layout(run, layout, report, partial) {
    const { database, data } = this;
    const { method, shapes, others, columns, by } = layout;
    const share = others.length > 0 ? LAID_OUT : 0.97;
    // Every layout starts from the site's own map, not from the last one: a reader finds shapes about where they were,
    // and yet the same address gives the same map on any way there.
    const start = Float32Array.from(placesOf(this.#siteMap(method) ?? database.projections[0], shapes));
    // One for all that is to be seen on the way.
    const moving = this.#nowhere();
    /** @type {Listener} */
    const listen = (told) => {
      report({ progress: told.progress * share });
      if (told.partial) partial(...this.#spread(shapes, told.partial.xy, moving));
    };
    const task = { method, rows: this.#rows(shapes), ...this.#asked(columns, by), start, seed: data.seed };
    const { xy } = await run("layout", task, listen);
    const map = await this.#measured(run, layout, xy);
    return others.length === 0
      ? map
      : this.#withOthers(run, map, layout, xy, ({ progress }) => report({ progress: share + (1 - share) * progress }));
  }

  /**
   * A map of a sample with the others on it, each beside the one of the sample that it is most like.
   * @param {Run} run
   * @param {ShapeMap} map
   * @param {Layout} layout
   * @param {ArrayLike<number>} xy
   * @param {Listener} report
   * @returns {Promise<ShapeMap>}
   */
  async #withOthers(run, map, { shapes, others, columns, by }, xy, report) {
    const task = { ...(await this.#compared(columns, by)), shapes, xy, others };
    const found = await run("beside", task, report);
    const [x, y] = this.#spread(others, found.xy, this.#spread(shapes, xy));
    return { ...map, x, y, sample: shapes };
  }

  /**
   * What a map compares, of all shapes: columns of the engines' table, whose rows are all shapes; else as the site holds it
   * of so many.
   * @param {Int32Array} columns
   * @param {"features" | "bins"} by
   */
  async #compared(columns, by) {
    const { bins } = this;
    if (bins.sample === null) {
      const { table, ...compared } = this.#asked(columns, by);
      return { table, compared };
    }
    const numbers = await (by === "bins"
      ? numbersOfBins(bins, columns)
      : numbersOfFeatures(this.#features(columns), this.database.count));
    // The engines' table is of the sample.
    return { table: null, compared: { numbers } };
  }

  /**
   * The features that columns belong to.
   * @param {Int32Array} columns
   */
  #features(columns) {
    return [...new Set(Array.from(columns, (column) => this.bins.featureOf(column)))];
  }

  /**
   * The rows that shapes have in the engines' table.
   * @param {ArrayLike<number>} shapes
   */
  #rows(shapes) {
    return Int32Array.from(shapes, (shape) => this.bins.rowOf(shape));
  }

  /**
   * Places of all shapes, of which some have one.
   * @param {ArrayLike<number>} shapes
   * @param {ArrayLike<number>} xy
   * @param {Places} into
   */
  #spread(shapes, xy, into = this.#nowhere()) {
    const [x, y] = into;
    for (let index = 0; index < shapes.length; index += 1) {
      x[shapes[index]] = xy[2 * index];
      y[shapes[index]] = xy[2 * index + 1];
    }
    return into;
  }

  /** @returns {Places} where no shape has one yet */
  #nowhere() {
    const { count } = this.database;
    return [new Float32Array(count).fill(NaN), new Float32Array(count).fill(NaN)];
  }

  /**
   * A map of some shapes with its neighbourhood hits.
   * @param {Run} run
   * @param {Layout} layout
   * @param {ArrayLike<number>} xy
   * @returns {Promise<ShapeMap>}
   */
  async #measured(run, { method, shapes, columns, by }, xy) {
    const { data } = this;
    const [x, y] = this.#spread(shapes, xy);
    return {
      key: "live",
      ...(this.titles.get(method) ?? { title: method }),
      features: [],
      x,
      y,
      neighbours: Math.min(data.neighbours, shapes.length - 1),
      ...(await this.#hits(run, shapes, xy)),
      chanceSpread: null,
      compares: by === "bins" ? { columns: [...columns] } : { features: this.#features(columns) },
    };
  }

  /**
   * A map of the site with neighbourhood hits that can be set beside those of a map that is made here: where that is of a
   * sample, they are of the same.
   * @param {Run} run
   * @param {ShapeMap} map
   * @param {Use} step
   * @returns {Promise<ShapeMap>}
   */
  async #comparable(run, map, step) {
    const sample = this.shapes(step);
    if (sample.length === this.inUse(step).length) return map;
    return { ...map, sample, ...(await this.#hits(run, sample, placesOf(map, sample))) };
  }

  /**
   * The neighbourhood hits of some shapes by their places.
   * @param {Run} run
   * @param {Int32Array} shapes
   * @param {ArrayLike<number>} xy
   * @returns {Promise<Pick<ShapeMap, "hit" | "hitOfClass" | "hitOfAll" | "chance">>}
   */
  async #hits(run, shapes, xy) {
    const { database, data } = this;
    const groups = shapes.map((shape) => database.groups[shape]);
    const { hit, hitOfClass, hitOfAll } = await run("hit", { xy, groups, k: data.neighbours });
    // Neighbours of one class cannot disagree.
    const several = new Set(groups.filter((group) => group >= 0)).size > 1;
    return {
      hit: this.#onAll(shapes, hit),
      hitOfClass: database.classes.map((_, group) => (several ? known(hitOfClass[group]) : null)),
      hitOfAll: several ? known(hitOfAll) : null,
      chance: several ? chance(groups) : null,
    };
  }

  /**
   * How far a map that was made here shows who is like whom by what it is made from.
   * @param {ShapeMap} map
   * @param {Listener} report
   * @returns {Job<Faith>}
   */
  faith({ x, y, sample, compares, neighbours }, report) {
    const shapes = sample ?? Int32Array.from(this.database.groups.keys()).filter((shape) => !Number.isNaN(x[shape]));
    const xy = placesOf({ x, y }, shapes);
    const { columns, features } = /** @type {Choice} */ (compares);
    return this.#chain(async (run) => {
      const asked = columns
        ? this.#asked(Int32Array.from(columns), "bins")
        : this.#asked(this.columns(new Set(features)), "features");
      const found = await run("faith", { rows: this.#rows(shapes), xy, ...asked, k: neighbours }, report);
      return {
        kept: this.#onAll(shapes, found.kept),
        false: this.#onAll(shapes, found.false),
        missing: this.#onAll(shapes, found.missing),
        mean: found.mean,
        chance: found.chance,
        trustworthiness: known(found.trustworthiness),
        continuity: known(found.continuity),
        random: known(found.random),
        stress: known(found.stress),
        randomStress: known(found.randomStress),
      };
    });
  }

  /**
   * What is known of some shapes, as of all; null where there is no number.
   * @param {ArrayLike<number>} shapes
   * @param {ArrayLike<number>} values
   * @returns {(number | null)[]}
   */
  #onAll(shapes, values) {
    const all = new Array(this.database.count).fill(null);
    for (let index = 0; index < shapes.length; index += 1) all[shapes[index]] = known(values[index]);
    return all;
  }

  /**
   * Several tasks of the engines as one job; maps are made by the first engine, which is not kept waiting by scores.
   * @template Result
   * @param {(run: Run) => Promise<Result>} work
   * @returns {Job<Result>}
   */
  #chain(work) {
    /** @type {Set<Job>} */
    const running = new Set();
    let cancelled = false;
    /** @type {Run} */
    const run = async (name, parameters, report, number = 0) => {
      const job = (await this.#engine(number)).run(name, parameters, report);
      if (cancelled) job.cancel();
      running.add(job);
      return job.done.finally(() => running.delete(job));
    };
    return {
      done: work(run),
      cancel: () => {
        cancelled = true;
        for (const job of running) job.cancel();
      },
    };
  }
}

/**
 * Where some shapes are on a map, as the engines take places.
 * @param {{ x: ArrayLike<number>, y: ArrayLike<number> }} map
 * @param {Int32Array} shapes
 */
function placesOf({ x, y }, shapes) {
  return Float64Array.from({ length: 2 * shapes.length }, (_, place) => (place % 2 === 0 ? x : y)[shapes[place >> 1]]);
}

/** @param {number | undefined} value */
function known(value) {
  return value === undefined || Number.isNaN(value) ? null : value;
}

/**
 * The neighbourhood hit that labels dealt at random have on average, whatever the map.
 * @param {Int32Array} groups
 */
function chance(groups) {
  const sizes = new Map();
  for (const group of groups) if (group >= 0) sizes.set(group, (sizes.get(group) ?? 0) + 1);
  const counts = [...sizes.values()];
  const labelled = counts.reduce((sum, size) => sum + size, 0);
  if (labelled === 0 || groups.length < 2) return null;
  return counts.reduce((sum, size) => sum + size * (size - 1), 0) / labelled / (groups.length - 1);
}
