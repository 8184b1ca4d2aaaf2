// The answer to "what makes these two groups alike or different?", before all figures: a few sentences.

import { element } from "../dom.js";
import { count } from "../words.js";
import { varied } from "./contrasts.js";
import { binCount, called, meaning, share, statement } from "./words.js";

const MOST_TOLD = 3;

/** Single bins tell the groups apart: nearly every shape of one has more of it than nearly every shape of the other. */
const CLEARLY = 0.95;
const WELL = 0.8;

export function answer(contrast, a, b, data, kin) {
  const { apart, beyond, bins } = contrast;
  const deals = `${share(apart.all.chance)} on average, and more than ${share(apart.all.limit)} in one of 100 deals`;
  const spread = ["Of all that these shapes differ in, ", element("b", {}, share(apart.all.share)), ` goes with the group; groups of the same sizes dealt at random reach ${deals}.`];
  if (!contrast.differ) {
    return [
      element("h2", {}, "Nothing sets ", called(a), " and ", called(b), " apart beyond chance."),
      element("p", {}, spread, ` None of ${count(bins.count, "bin")} differs more than some bin does when shapes are dealt out at random.`, tooFew(contrast)),
      kin && element("p", {}, kin),
    ].filter(Boolean);
  }
  const told = plainest(contrast);
  return [
    element("h2", {}, headline(contrast, a, b)),
    told.length > 0 && element("ul", { class: "told" }, told.map((column) => element("li", {}, statement(column, contrast, a, b, data), said(meaning(column, bins))))),
    element("p", {}, spread, " ", beyond.length > 0
      ? [element("b", {}, binCount(beyond.length, bins.count)), ` ${beyond.length === 1 ? "differs" : "differ"} more than chance lets any bin differ.`]
      : "No single bin differs beyond chance: the difference lies in many small ones together."),
    kin && element("p", {}, kin),
  ].filter(Boolean);
}

function headline(contrast, a, b) {
  const [best] = contrast.beyond;
  if (best === undefined) return [called(a), " and ", called(b), " differ, but only as wholes."];
  const ahead = contrast.ahead(best);
  const apart = Math.max(ahead, 1 - ahead);
  if (apart >= CLEARLY) return [called(a), " and ", called(b), " are clearly different."];
  return [called(a), " and ", called(b), apart >= WELL ? " differ." : " differ a little: on average, not shape by shape."];
}

/** Of the bins that differ, those that are easiest to picture: of features with one value a point, the best of each. */
function plainest({ beyond, bins, difference }) {
  const most = Math.abs(difference[beyond[0]] ?? 0);
  const simple = beyond.filter((column) => bins.features[bins.featureOf(column)].dimensions === 1 && Math.abs(difference[column]) >= most / 3);
  const features = new Set();
  const chosen = simple.filter((column) => !features.has(bins.featureOf(column)) && features.add(bins.featureOf(column)));
  return chosen.length > 0 ? chosen.slice(0, MOST_TOLD) : varied(beyond, bins, 1);
}

function said(text) {
  return text && element("span", { class: "quiet" }, ` ${text}`);
}

function tooFew({ sample }) {
  const fewest = Math.min(sample.a.length, sample.b.length);
  return fewest < 5 ? ` With ${count(fewest, "shape")} in a group, only very large differences could show.` : "";
}

/** How often the shapes of two groups are each other's nearest. */
export function kinship(a, b, neighbours) {
  const [there, back] = [neighbours.between(a.shapes, b.shapes), neighbours.between(b.shapes, a.shapes)];
  const told = (value) => `${Math.round(100 * value)} %`;
  if (there === null) return null;
  if (there === 0 && back === 0) return ["No shape of the one is among the ", count(neighbours.k, "nearest neighbour"), " of a shape of the other."];
  return ["Of the ", count(neighbours.k, "nearest neighbour"), " of a shape of ", called(a), `, ${told(there)} on average are of `, called(b), `; the other way round it is ${told(back)}.`];
}
