// What the parts of the page that set this shape beside others know, and what they say alike.

import { figure } from "../base/words.js";
import { copyEvidence } from "../database/facts.js";

/** @import { ShapeState } from "../addresses/shape.js" */
/** @import { Bins } from "../database/bins.js" */
/** @import { Database } from "../database/database.js" */
/** @import { LevelSimilarity } from "../database/level-similarity.js" */
/** @import { Similarity } from "../database/similarity.js" */
/** @import { Comparison } from "./comparison.js" */
/** @import { ShapeLinks } from "./links.js" */

export class Comparing {
  /**
   * @param {object} known
   * @param {Database} known.database
   * @param {Bins} known.bins
   * @param {ShapeState} known.state
   * @param {ShapeLinks} known.links
   * @param {Comparison} known.comparison
   * @param {Similarity | LevelSimilarity} known.similarity
   */
  constructor({ database, bins, state, links, comparison, similarity }) {
    this.database = database;
    this.bins = bins;
    this.state = state;
    this.links = links;
    this.comparison = comparison;
    this.similarity = similarity;
  }

  /**
   * That another shape is this one again, and what says so; null where it is not.
   * @param {Chunk.ShapeDetails} known
   * @param {number} other
   */
  copyInWords(known, other) {
    const evidence = copyEvidence(known, other);
    return evidence && `A copy of this shape: ${evidence}.`;
  }
}

/**
 * Whether a distance is none, as far as readers are told.
 * @param {number} distance
 */
export function isNone(distance) {
  return figure(distance) === figure(0);
}
