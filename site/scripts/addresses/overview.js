// The state of the Overview in its address.

import { Address, flag, named, text } from "../base/address.js";
import { pageAddress } from "../base/place.js";
import { CAMERA } from "./camera.js";
import { namedElsewhere, classesNamed } from "./classes.js";
import { colors, OWN_COLORS } from "./colors.js";
import { LINES } from "./lines.js";
import { missMap } from "./maps.js";
import { joinNames, splitNames } from "./names.js";
import { selected } from "./selected.js";

/** @import { Ways } from "../base/address.js" */
/** @import { State } from "../base/state.js" */
/** @import { Database } from "../database/database.js" */
/** @import { Shared } from "../database/selection.js" */
/** @import { Camera, MapValues } from "../map/scene.js" */

/**
 * What the Overview has in its state, beside what maps have.
 * @typedef {object} OverviewValues
 * @property {string} view what the map shows, or `three` for the three linked maps beside each other
 * @property {string} by key of the field, or `bin:` and the name of the bin, that `color` shows, or showed last
 * @property {boolean} pictures whether it shows pictures, on grounds of these colours
 * @property {boolean} exact whether pictures stand at their exact places, where they may cover each other
 * @property {string} query of the search
 * @property {Camera | null} camera the part in view; all where it is null
 *
 * @typedef {State<OverviewValues & MapValues & Shared>} OverviewState
 */

/**
 * What the map can show: classes, and how well shapes keep to theirs, where there are some.
 * @param {Database} database
 */
export function viewsOf({ labelled }) {
  return labelled ? ["thumbnail", "class", "hit", "color", "three"] : ["thumbnail", "class", "color"];
}

/** @param {Database} database */
export function overviewAddress(database) {
  return new Address([
    { names: ["method", "features"], ...mapOfFeatures(database), place: true, words: "the map" },
    { names: ["view", "by"], ...viewAndColors(database), place: true, words: "what the map shows" },
    { name: "pictures", key: "pictures", kind: flag, standard: false, place: true },
    { name: "exact", key: "exact", kind: flag, standard: false, place: true },
    { name: "hidden", ...hiddenClasses(database), place: true, words: "which classes are hidden" },
    selected(database),
    namedElsewhere(database),
    {
      name: "opened",
      key: "open",
      kind: named(database.ids, "shape"),
      standard: null,
      place: true,
      words: "the open shape",
    },
    { name: "query", key: "find", kind: text, standard: "", often: true, words: "the search" },
    LINES,
    CAMERA,
  ]);
}

/**
 * The address of a subset's map on the Overview.
 * @param {string[]} names
 */
export function subsetAddress(names) {
  return pageAddress("index.html", { features: joinNames(names) });
}

/**
 * A map, and the features that it is of where these are a subset: one that was searched, whatever else is said.
 * @param {Database} database
 * @returns {Ways}
 */
function mapOfFeatures(database) {
  const { subsets } = database.data;
  const known = [...(subsets?.features ?? []), ...database.data.methods.flatMap(({ features }) => features)];
  return {
    keys: /^(map|features)$/,
    read(query, miss) {
      const map = query.get("map");
      missMap(map, database, miss);
      return {
        method: Math.max(
          database.methods.findIndex(({ key }) => key === map),
          0,
        ),
        features: subsets ? splitNames(query.get("features"), subsets.features, miss, known) : [],
      };
    },
    write(query, { method }) {
      const { base, features } = database.methods[method];
      if (base !== 0) query.set("map", database.methods[base].key);
      if (base !== method) query.set("features", joinNames(features));
    },
  };
}

/**
 * The view, where no other page of maps has the same: there its colours say it.
 * @param {Database} database
 * @returns {Ways}
 */
function viewAndColors(database) {
  const views = viewsOf(database);
  const kind = colors(database);
  return {
    keys: /^(view|color)$/,
    read(query, miss) {
      const view = query.get("view") ?? "";
      const color = kind.read(query.getAll("color"), miss);
      if (view !== "" && !views.includes(view)) miss("view", view);
      if (view !== "color" && views.includes(view)) return { view };
      if (color === undefined) return { view: views[0] };
      return OWN_COLORS.includes(color) ? { view: color } : { view: "color", by: color };
    },
    write(query, { view, by }) {
      if (view === "color") query.set("color", by);
      else if (OWN_COLORS.includes(view)) query.set("color", view);
      else if (view !== views[0]) query.set("view", view);
    },
  };
}

/**
 * @param {Database} database
 * @returns {Ways}
 */
function hiddenClasses(database) {
  const { classes, sizes, labelled } = database;
  return {
    keys: /^hide(-unlabelled)?$/,
    read: (query, miss) => {
      const hidden = classesNamed(query.getAll("hide"), database, miss);
      return new Set(query.has("hide-unlabelled") && labelled && sizes.has(-1) ? [...hidden, -1] : hidden);
    },
    write(query, hidden) {
      for (const group of hidden) {
        if (group < 0) query.set("hide-unlabelled", "");
        else query.append("hide", classes[group]);
      }
    },
  };
}
