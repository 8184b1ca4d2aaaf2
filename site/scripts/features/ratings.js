// What was rated: each choice of what is compared, with what it reaches on average over shapes or over classes.

/**
 * What is drawn and listed: what is compared, and what it reaches; `row` is that of a subset.
 * @typedef {object} Choice
 * @property {string} key
 * @property {"chosen" | "everything" | "best" | "feature" | "neighbourhood" | "bins" | "chance"} kind
 * @property {number} [row]
 * @property {number} [feature]
 * @property {Chunk.Rated} rating
 */

export class Ratings {
  /**
   * `data` is the chunk "retrieval".
   * @param {Chunk.Retrieval} data
   */
  constructor(data) {
    this.data = data;
    this.features = data.features;
    this.everything = data.members.indexOf("1".repeat(data.features.length));
  }

  /**
   * The row of the subset with these features.
   * @param {string[]} names
   */
  find(names) {
    return this.data.members.indexOf(this.features.map((name) => (names.includes(name) ? "1" : "0")).join(""));
  }

  /** @param {number} row */
  names(row) {
    return this.features.filter((_, feature) => this.data.members[row][feature] === "1");
  }

  /** Whether more was rated than each feature alone and all together, so that one can be called the best. */
  get choosable() {
    return this.data.members.length > this.features.length + 1;
  }

  /**
   * Where a feature alone stands.
   * @param {number} feature
   */
  alone(feature) {
    return this.find([this.features[feature]]);
  }

  /**
   * What is drawn and listed: the chosen subset, all features and these by neighbourhood, the best subset where there was a
   * choice, each feature alone, bins, chance. What is two of these stands there once. `row` is that of a subset, else undefined.
   * @param {number} chosen
   * @returns {Choice[]}
   */
  choices(chosen) {
    const { data } = this;
    /** @type {((Omit<Choice, "rating"> & { row: number }) | false)[]} */
    const subsets = [
      { key: "chosen", kind: "chosen", row: chosen },
      { key: "everything", kind: "everything", row: this.everything },
      this.choosable &&
        !data.order.some((feature) => this.alone(feature) === data.best) && {
          key: "best",
          kind: "best",
          row: data.best,
        },
      ...data.order.map((feature) => ({
        key: `feature ${feature}`,
        kind: /** @type {const} */ ("feature"),
        feature,
        row: this.alone(feature),
      })),
    ];
    const given = subsets.filter((choice) => choice !== false);
    const rows = given.map(({ row }) => row);
    const once = given
      .filter(({ row }, place) => rows.indexOf(row) === place)
      .map((choice) => ({ ...choice, rating: data.subsets[choice.row] }));
    /** @type {["neighbourhood" | "bins" | "chance", Chunk.Rated | null][]} */
    const others = [
      ["neighbourhood", data.byNeighbourhood],
      ["bins", data.byBins],
      ["chance", data.chance],
    ];
    const rated = others.flatMap(([kind, rating]) => (rating ? [{ key: kind, kind, rating }] : []));
    const beside = rated.filter(({ kind }) => kind === "neighbourhood");
    const place = once.findIndex(({ row }) => row === this.everything) + 1;
    return [...once.slice(0, place), ...beside, ...once.slice(place), ...rated.slice(beside.length)];
  }

  /**
   * The six measures of a rating in [0, 1].
   * @param {Chunk.Rated} rating
   * @param {"shapes" | "classes"} over
   */
  scores(rating, over) {
    return rating[over].map((steps) => steps / this.data.steps);
  }

  /**
   * Precision at each level of recall.
   * @param {Chunk.Rated} rating
   * @param {"shapes" | "classes"} over
   */
  curve(rating, over) {
    return rating[over === "shapes" ? "curveOfShapes" : "curveOfClasses"].map((steps) => steps / this.data.steps);
  }

  /**
   * The six measures of each class.
   * @param {Chunk.Rated} rating
   */
  each(rating) {
    return rating.each.map((scores) => scores.map((steps) => steps / this.data.steps));
  }
}
