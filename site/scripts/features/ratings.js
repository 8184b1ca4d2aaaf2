// What was rated: each choice of what is compared, with what it reaches on average over shapes or over classes.

export class Ratings {
  /** `data` is the chunk "retrieval". */
  constructor(data) {
    this.data = data;
    this.features = data.features;
    this.everything = data.members.indexOf("1".repeat(data.features.length));
  }

  /** The row of the subset with these features. */
  find(names) {
    return this.data.members.indexOf(this.features.map((name) => (names.includes(name) ? "1" : "0")).join(""));
  }

  names(row) {
    return this.features.filter((_, feature) => this.data.members[row][feature] === "1");
  }

  /** Whether more was rated than each feature alone and all together, so that one can be called the best. */
  get choosable() {
    return this.data.members.length > this.features.length + 1;
  }

  /** Where a feature alone stands. */
  alone(feature) {
    return this.find([this.features[feature]]);
  }

  /**
   * What is drawn and listed: the chosen subset, all features, the best subset where there was a choice, each feature
   * alone, bins, chance. What is two of these stands there once. `row` is that of a subset, else undefined.
   */
  choices(chosen) {
    const { data } = this;
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
        kind: "feature",
        feature,
        row: this.alone(feature),
      })),
    ].filter(Boolean);
    const rows = subsets.map(({ row }) => row);
    const once = subsets
      .filter(({ row }, place) => rows.indexOf(row) === place)
      .map((choice) => ({ ...choice, rating: data.subsets[choice.row] }));
    const others = [
      data.byBins && { key: "bins", kind: "bins", rating: data.byBins },
      { key: "chance", kind: "chance", rating: data.chance },
    ];
    return [...once, ...others.filter(Boolean)];
  }

  /** The six measures of a rating in [0, 1], `over` "shapes" or "classes". */
  scores(rating, over) {
    return rating[over].map((steps) => steps / this.data.steps);
  }

  /** Precision at each level of recall. */
  curve(rating, over) {
    return rating[over === "shapes" ? "curveOfShapes" : "curveOfClasses"].map((steps) => steps / this.data.steps);
  }

  /** The six measures of each class. */
  each(rating) {
    return rating.each.map((scores) => scores.map((steps) => steps / this.data.steps));
  }
}
