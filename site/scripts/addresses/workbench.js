// The work in the address: a link, and a reload, bring back the same maps and the same figures.

import { readHash } from "../base/place.js";
import { readSelection, writeSelection } from "../database/selection.js";
import { readShortNames, shortNames } from "./bin-names.js";
import { joinNames, splitNames } from "./names.js";

const PROJECTIONS = ["tsne", "umap"];

/** Its best bins make the best maps, on shapes that had no say too (docs/method/scorers.md). */
export const DEFAULT_SCORER = "rfe";

/** All classes in use, each from the rest: what a reader who asks nothing in particular wants to know. */
export const EVERY_CLASS = Object.freeze({ from: null, against: null, each: true });

/** Whether a site of chosen bins is made from just these. */
export function isSame(bins, ofSite) {
  return ofSite !== null && bins.size === ofSite.length && ofSite.every((column) => bins.has(column));
}

export function readWorkAddress(database, data) {
  const query = readHash();
  const groups = new Map(database.classes.map((name, group) => [name, group]));
  const named = (name) =>
    query
      .getAll(name)
      .map((label) => groups.get(label))
      .filter((group) => group !== undefined);
  const known = splitNames(
    query.get("features"),
    data.features.map(({ name }) => name),
  );
  const features = new Set(data.features.keys());
  if (known.length > 0)
    for (const [index, { name }] of data.features.entries()) if (!known.includes(name)) features.delete(index);
  const chosen = query.has("bins") ? readShortNames(query.get("bins"), data.features) : (data.bins ?? []);
  const bins = [...chosen].filter((column) => features.has(featureOf(column, data)));
  const scorers = data.scorers.map(({ key }) => key);
  return {
    hidden: readHidden(query, named, database),
    features,
    bins: new Set(bins),
    projection: PROJECTIONS.includes(query.get("map"))
      ? query.get("map")
      : PROJECTIONS.includes(data.method)
        ? data.method
        : PROJECTIONS[0],
    scorer: scorers.includes(query.get("scorer")) ? query.get("scorer") : DEFAULT_SCORER,
    separation: {
      from: query.has("separate") ? new Set(named("separate")) : EVERY_CLASS.from,
      against: query.has("from") ? new Set(named("from")) : EVERY_CLASS.against,
      each: !query.has("together"),
    },
    sample: query.has("sample"),
    color: query.get("color") === "hit" && database.labelled ? "hit" : "class",
    selection: readSelection(query, database),
  };
}

/** Classes are named as in use or as not in use, whichever are fewer. */
function readHidden(query, named, database) {
  const everyone = [...database.classes.keys(), -1];
  if (query.has("class") || query.has("unlabelled")) {
    const used = new Set([...named("class"), ...(query.has("unlabelled") ? [-1] : [])]);
    return new Set(everyone.filter((group) => database.sizes.has(group) && !used.has(group)));
  }
  return new Set([...named("hide"), ...(query.has("hide-unlabelled") && database.sizes.has(-1) ? [-1] : [])]);
}

function featureOf(column, data) {
  return data.features.findLastIndex(({ start }) => start <= column);
}

/** The parameters of the work's address. */
export function workAddress(database, data, state) {
  const query = new URLSearchParams();
  const hidden = state.get("hidden");
  const used = [...database.sizes.keys()].filter((group) => !hidden.has(group)).sort((a, b) => a - b);
  const fewer = used.length < hidden.size;
  for (const group of fewer ? used : [...hidden].sort((a, b) => a - b)) {
    if (group < 0) query.set(fewer ? "unlabelled" : "hide-unlabelled", "");
    else query.append(fewer ? "class" : "hide", database.classes[group]);
  }
  // No class in use has no name to give.
  if (used.length === 0) query.append("class", "");
  const features = state.get("features");
  if (features.size < data.features.length)
    query.set("features", joinNames([...features].sort((a, b) => a - b).map((index) => data.features[index].name)));
  if (!isSame(state.get("bins"), data.bins ?? [])) query.set("bins", shortNames(state.get("bins"), data.features));
  if (state.get("projection") !== (PROJECTIONS.includes(data.method) ? data.method : PROJECTIONS[0]))
    query.set("map", state.get("projection"));
  if (state.get("scorer") !== DEFAULT_SCORER) query.set("scorer", state.get("scorer"));
  const { from, against, each } = state.get("separation");
  const names = (name, groups) => {
    for (const group of groups) query.append(name, database.classes[group]);
    if (groups.size === 0) query.set(name, "");
  };
  if (from !== null) names("separate", from);
  if (against !== null) names("from", against);
  if (!each) query.set("together", "");
  if (state.get("sample")) query.set("sample", "");
  if (state.get("color") !== "class") query.set("color", state.get("color"));
  writeSelection(query, database, state.get("selection"));
  return query;
}
