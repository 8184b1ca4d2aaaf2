// The state of each page in its address, and bins and features as words of it.

import assert from "node:assert/strict";
import { test } from "node:test";
import { readShortNames, shortNames } from "../../site/scripts/addresses/bin-names.js";
import { binsAddress } from "../../site/scripts/addresses/bins.js";
import { comparePageAddress } from "../../site/scripts/addresses/compare.js";
import { featuresAddress } from "../../site/scripts/addresses/features.js";
import { joinNames, splitNames } from "../../site/scripts/addresses/names.js";
import { overviewAddress } from "../../site/scripts/addresses/overview.js";
import { shapePageAddress } from "../../site/scripts/addresses/shape.js";
import { galleryAddress } from "../../site/scripts/addresses/shapes.js";
import { workAddress } from "../../site/scripts/addresses/workbench.js";
import { commonTo } from "../../site/scripts/base/address.js";
import { missingWords } from "../../site/scripts/base/missing.js";
import { readSelection } from "../../site/scripts/database/selection.js";
import { textsOf } from "./texts.js";

const FEATURES = [
  { name: "Gc", start: 0, dimensions: 1, bins: 10 },
  { name: "FPFH", start: 10, dimensions: 33, bins: 10 },
  { name: "50 % of it", start: 340, dimensions: 4, bins: 1 },
];
const COLUMNS = 344;

test("names of features survive an address, whatever is in them", () => {
  const names = FEATURES.map(({ name }) => name);
  for (const chosen of [[], ["Gc"], ["50 % of it"], names]) {
    const query = new URLSearchParams({ features: joinNames(chosen) }).toString();
    assert.deepEqual(splitNames(new URLSearchParams(query).get("features"), names), chosen);
  }
});

test("bins are named by the shortest words", () => {
  assert.equal(shortNames([0, 1, 2, 3, 4, 5, 6, 7, 8, 9], FEATURES), "Gc");
  assert.equal(shortNames([2, 0, 1, 5], FEATURES), "Gc:1-3 Gc:6");
  assert.equal(shortNames([150, 151, 152, 153, 154, 155, 156, 157, 158, 159, 161], FEATURES), "FPFH[14] FPFH[15]:2");
});

test("any choice of bins survives an address", () => {
  let state = 1;
  const random = () => {
    state = (Math.imul(state, 48271) >>> 0) % 0x7fffffff;
    return state / 0x7fffffff;
  };
  for (const share of [0, 0.01, 0.2, 0.6, 1]) {
    const chosen = Array.from({ length: COLUMNS }, (_, column) => column).filter(() => random() < share);
    assert.deepEqual(
      [...readShortNames(shortNames(chosen, FEATURES), FEATURES)].sort((a, b) => a - b),
      chosen,
    );
  }
});

test("words that name no bin are passed over", () => {
  for (const text of [
    null,
    "",
    "Gc:NaN",
    "FPFH[Infinity]:1-1",
    "FPFH[0x1]",
    `Gc:${"9".repeat(400)}`,
    "Gc:0",
    "Gc:11",
    "Gc:3-2",
    "FPFH[33]",
    "FPFH:3",
    "Xy",
    "Gc:1;",
  ]) {
    assert.equal(readShortNames(text, FEATURES).size, 0, String(text));
  }
});

// The tables of the pages, on a database of three classes.

const IDS = ["ant/1", "ant/2", "bee/1", "cup & plate/1", "lost"];
const CLASSES = ["ant", "bee", "cup & plate"];

const database = {
  ids: textsOf(...IDS),
  count: IDS.length,
  indexOfId: new Map(IDS.map((id, index) => [id, index])),
  classes: CLASSES,
  sizes: new Map([
    [0, 2],
    [1, 1],
    [2, 1],
    [-1, 1],
  ]),
  labelled: true,
  separable: true,
  methods: [
    { key: "tsne", base: 0 },
    { key: "pca", base: 1 },
    { key: "tsne Gc", base: 0, features: ["Gc"] },
  ],
  data: {
    standIn: false,
    subsets: { features: ["Gc", "FPFH"] },
    methods: [
      { key: "tsne", features: ["Gc", "FPFH", "50 % of it"] },
      { key: "pca", features: ["Gc", "FPFH", "50 % of it"] },
    ],
  },
};

const field = (key, more) => ({ key, names: null, edges: null, tree: null, ...more });
const kind = field("kind", { active: true, names: ["flying", "not/flying"] });
const faces = field("faces", { edges: [0, 10] });
const folders = field("folders", { tree: { nodes: [{}, {}], ways: [["a"], ["a", "b/c"]] } });
const fields = {
  active: kind,
  groupable: [kind, faces],
  sortable: [faces],
  filters: [kind, faces, folders],
  byKey: new Map([kind, faces, folders].map((each) => [each.key, each])),
};

const search = { greedy: [{ s: 1 }, { s: 3 }] };
const SUBSETS = [["Gc", "FPFH"], ["Gc"], ["FPFH"]];
const subsets = {
  labelled: true,
  everything: 0,
  features: ["Gc", "FPFH"],
  data: search,
  measures: [{ name: "nh" }, { name: "kept" }],
  names: (place) => SUBSETS[place],
  find: (names) => [0, 1, 2].find((place) => SUBSETS[place].join() === names.join()),
};

const work = {
  features: FEATURES,
  bins: [3, 11],
  method: "pca",
  scorers: [{ key: "rfe" }, { key: "anova" }],
};
const bins = { names: Array.from({ length: COLUMNS }, (_, column) => `bin ${column}`) };
const selection = { path: [{}, {}, {}] };
const spaces = { spaces: ["features", "tsne"] };
const neighbours = { likest: () => [{ group: 1, other: 2 }] };

/** Each page's address, and what may stand in it, in the form that it has had in links since. */
const PAGES = {
  overview: [
    overviewAddress(database),
    [
      "",
      "view=three&exact=&lines=none",
      "color=column%3Aplace&pictures=",
      "map=pca&color=hit&hide=ant&hide=cup+%26+plate&hide-unlabelled=",
      "select=ant%2F1&select=lost&open=bee%2F1&find=two+words&at=0.5%2C-0.25%2C3",
    ],
  ],
  features: [
    featuresAddress(subsets, database),
    [
      "",
      "features=Gc&s=3&rank=kept&color=map%3Afalse&select=lost&open=ant%2F1&lines=none&at=0%2C1%2C40",
      "features=FPFH&s=none&color=bin%3AGc%3A1",
    ],
  ],
  bins: [
    binsAddress(database, bins, selection, { bin: 5, group: 1 }),
    ["", "size=2&step=1&bin=bin+7&of=bee&shape=least&reading=inside", "bin=bin+5&id=cup+%26+plate%2F1&select=ant%2F2"],
  ],
  shape: [
    shapePageAddress(database),
    [
      "",
      "id=ant%2F2&map=pca&features=Gc&bins=Gc%3A1-3&neighbourhood=&bin=Gc%3A2&clay=&parts=FPFH%5B3%5D&beside=ant%2F1&within=Gc&select=lost",
      "id=nobody",
    ],
  ],
  shapes: [
    galleryAddress(database, fields),
    [
      "",
      "find=a+b&only=&is.kind=flying&is.kind=not%2Fflying&range.faces=2..7.5&select=ant%2F1&at=bee%2F1",
      "lacks.kind=&is.folders=a%2Fb%252Fc&group=faces&sort=faces&down=&size=200&closed=x&closed=y",
      "group=",
    ],
  ],
  compare: [
    comparePageAddress(database, spaces, neighbours, ["one:two"]),
    [
      "",
      "a=class%3Acup+%26+plate&b=class%3Abee",
      "select=bee%2F1",
      "view=outliers&a=shapes&a-select=ant%2F1&b=rest&bin=Gc%3A3&reading=inside&of=ant&by=tsne",
      "select=lost&view=classes&a=cluster%3Aone%3Atwo&b=search%3Aa+%26+b&row=ant&column=bee",
    ],
  ],
  workbench: [
    workAddress({ ...database, count: 5000 }, work),
    [
      "",
      "hide=ant&features=FPFH+50%2520%2525%2520of%2520it&bins=FPFH%5B1%5D%3A2&map=umap&scorer=anova",
      "class=bee&bins=&separate=ant&separate=bee&from=cup+%26+plate&together=&color=hit&select=ant%2F1",
      "hide-unlabelled=&hide=ant&hide=bee&hide=cup+%26+plate&separate=&from=",
      "unlabelled=",
      "hide-unlabelled=",
    ],
  ],
};

/** What stands nowhere for a number, a place among others, or a range. */
const NONSENSE = [
  ...["NaN", "Infinity", "-Infinity", "9".repeat(400), "0x", "%00", "constructor"],
  ...[
    "nope",
    "-1",
    "1e99",
    "NaN,0,1",
    "0,0",
    "0,0,Infinity",
    "1e99,0,2",
    "0,0,1e99",
    "0,0,0",
    "0,0,-1",
    "NaN..1",
    "1..Infinity",
    "..2..",
    "-",
  ],
];

for (const [page, [address, queries]] of Object.entries(PAGES)) {
  const writtenAgain = (query) => {
    const values = address.read(new URLSearchParams(query));
    return address.write(new Map(Object.entries(values))).toString();
  };

  test(`what stands in the address of ${page} is written as it was read`, () => {
    for (const query of queries) assert.equal(writtenAgain(query), query);
  });

  test(`what is common to pages is known to ${page}, or passes through it`, () => {
    for (const query of queries) {
      const common = commonTo(new URLSearchParams(query));
      assert.deepEqual(address.passing(new URLSearchParams(query)), [], query);
      const all = new URLSearchParams([...common, ["is.stranger", "x"], ["range.year", "1..2"], ["view", "y"]]);
      const passing = address.passing(all).map(([name]) => name);
      assert.deepEqual(passing, page === "shapes" ? [] : ["is.stranger", "range.year"]);
    }
  });

  test(`${page} passes over what it cannot read`, () => {
    const usual = writtenAgain("");
    const prefixed = ["range.faces", "is.kind", "is.folders", "hide", "a", "select", "selected", "view", "map"];
    if (page === "workbench") prefixed.push("class", "separate", "from", "features", "bins");
    const keys = new Set([...address.rows.flatMap(({ key }) => key ?? []), ...prefixed]);
    // Any text is valid there.
    for (const key of ["find", "bin", "parts", "closed", "down", "sample", "exact", "by", "pictures", "color"])
      keys.delete(key);
    if (page === "shape") for (const key of ["features", "bins", "within", "neighbourhood", "clay"]) keys.delete(key);
    for (const key of keys)
      for (const word of NONSENSE) assert.equal(writtenAgain([[key, word]]), usual, `${key}=${word}`);
  });
}

test("the selection of another page is compared with the rest", () => {
  const [address] = PAGES.compare;
  const { a, b } = address.read(new URLSearchParams("select=bee/1"));
  assert.deepEqual([a, b], [{ kind: "shapes", shapes: new Set([2]) }, { kind: "rest" }]);
});

test("an unlabelled database has no classes to be coloured by, to keep to or to hide", () => {
  const bare = { ...database, labelled: false, classes: [], sizes: new Map([[-1, 5]]) };
  for (const address of [overviewAddress(bare), workAddress(bare, work)]) {
    const usual = address.write(new Map(Object.entries(address.read(new URLSearchParams())))).toString();
    for (const query of ["color=hit", "view=three", "view=hit", "class=ant", "unlabelled=&class=x", "hide=ant"])
      assert.equal(address.write(new Map(Object.entries(address.read(new URLSearchParams(query))))).toString(), usual);
  }
  assert.equal(overviewAddress(bare).read(new URLSearchParams("hide-unlabelled=")).hidden.size, 0);
});

test("two groups go along through another page; those that follow from the selection follow the next one", () => {
  const [[compare], [overview]] = [PAGES.compare, PAGES.overview];
  /** @param {string} query */
  const through = (query) => {
    const written = compare.write(new Map(Object.entries(compare.read(new URLSearchParams(query)))));
    return overview.passing(new URLSearchParams(commonTo(written))).map(([name]) => name);
  };
  assert.deepEqual(through("a=class:ant&b=shapes&b-select=bee/1&b-select=lost"), ["a", "b", "b-select", "b-select"]);
  assert.deepEqual(through("select=bee/1"), []);
  assert.deepEqual(through("select=bee/1&a=class:bee&b=class:cup %26 plate"), ["a", "b"]);
  assert.deepEqual(through(""), []);
});

test("bins of features that are not in use are none", () => {
  const [address] = PAGES.workbench;
  assert.deepEqual(address.read(new URLSearchParams("features=FPFH&bins=Gc:1 FPFH[0]:2")).bins, new Set([11]));
});

test("a link says in words what it holds", () => {
  const [address] = PAGES.overview;
  const held = (query) => address.holds(new Map(Object.entries(address.read(new URLSearchParams(query)))));
  assert.deepEqual(held(""), []);
  assert.deepEqual(held("map=pca&hide=ant&select=lost"), ["the map", "which classes are hidden", "the selection"]);
});

test("a row says which values of the state it has", () => {
  const [address] = PAGES.overview;
  const isPlace = ({ place }) => place;
  assert.ok(address.has(new Set(["selection"]), isPlace));
  assert.ok(!address.has(new Set(["camera", "theme"]), isPlace));
  assert.ok(address.has(new Set(["camera"])));
  assert.ok(!address.has(new Set(["theme"])));
});

/** What an address names in vain, by its page: "noun name", in the order in which it is read. */
const MISSED = {
  overview: {
    "map=mds&features=Gc Xy 50%2525": ["map mds", "feature Xy", "feature 50%"],
    "view=bar&class=wyvern&hide=dragon&hide=ant&open=ant/9&select=ghost&select=lost&selected=old.AA": [
      "class dragon",
      "class wyvern",
      "view bar",
      "selection ",
      "shape ghost",
      "shape ant/9",
    ],
  },
  features: {
    "features=Xy FPFH&rank=luck&among=few&open=ant/9&separate=dragon": [
      "feature Xy",
      "measure luck",
      "setting few",
      "shape ant/9",
      "class dragon",
    ],
  },
  bins: {
    "step=4&bin=bin 999&of=dragon&id=ant/9": ["step 4", "bin bin 999", "class dragon", "shape ant/9"],
    "step=last&size=9&reading=x&class=wyvern": ["step last", "setting 9", "setting x", "class wyvern"],
  },
  shape: { "id=nobody&map=mds&beside=ant/9&from=dragon": ["map mds", "shape ant/9", "class dragon"] },
  shapes: {
    "is.kind=flying&is.kind=swimming&is.folders=a/x%2525&lacks.planet=&range.column:year=1..2&at=ant/9": [
      "column planet",
      "column year",
      "class swimming",
      "folder a/x%",
      "shape ant/9",
    ],
    "group=label:style&sort=nh:mds": ["column style", "map mds"],
    "range.faces=low..1": ["range low..1"],
    "class=dragon&class=ant": ["class dragon"],
  },
  compare: {
    "a=class:dragon&b=class:bee&of=dragon&by=mds": ["class dragon", "map mds"],
    "a=cluster:one:two&b=cluster:nine&row=dragon&column=ant": ["cluster nine", "class dragon"],
    "a=shapes&a-select=ghost&a-select=ant/1&b=rest": ["shape ghost"],
    "a=nope&view=bar&reading=x&hide=dragon": ["group nope", "view bar", "setting x", "class dragon"],
  },
  workbench: {
    "class=dragon&separate=ant&separate=wyvern&from=drake&together=": ["class dragon", "class wyvern", "class drake"],
    "features=Gc Xy&bins=Gc:1 Gc:11 FPFH[40] <b>&map=mds&scorer=luck": [
      "feature Xy",
      "bin Gc:11",
      "bin FPFH[40]",
      "bin <b>",
      "map mds",
      "scorer luck",
    ],
  },
};

/** Parameters that no address of a page has. */
const UNKNOWN = ["chosen", "hidden", "toString", "IS.kind", "at ", "ids"];

const missedBy = (address, query) => {
  /** @type {Set<string>} */
  const missed = new Set();
  address.read(new URLSearchParams(query), (noun, name) => missed.add(`${noun} ${name}`));
  return [...missed];
};

for (const [page, [address, queries]] of Object.entries(PAGES)) {
  test(`${page} tells which names in its address are not there`, () => {
    for (const [query, missed] of Object.entries(MISSED[page]))
      assert.deepEqual(missedBy(address, query).sort(), missed.sort(), query);
  });

  test(`${page} tells which parameters in its address are none, and no others`, () => {
    for (const key of UNKNOWN) assert.deepEqual(missedBy(address, `${key}=1`), [`setting ${key}`]);
    assert.deepEqual(missedBy(address, "&=&=1&&"), []);
  });

  test(`${page} misses nothing that is there, or that another page has`, () => {
    for (const query of queries) assert.deepEqual(missedBy(address, query), [], query);
    const common =
      "map=pca&map=umap&features=50%2520%2525%2520of%2520it&hide=ant&class=bee&separate=&a=rest&scorer=rfe";
    assert.deepEqual(missedBy(address, common), []);
    assert.deepEqual(missedBy(address, "map=umap&find=dragon&color=hit&a=&class=&select="), []);
  });
}

test("an id of no letters is none", () => {
  const [address] = PAGES.shape;
  assert.equal(address.read(new URLSearchParams("id=")).unknown, null);
  assert.equal(address.read(new URLSearchParams("id=x")).unknown, "x");
});

test("clusters that stand in for classes are called so", () => {
  const clustered = { ...database, data: { ...database.data, standIn: true } };
  assert.deepEqual(missedBy(overviewAddress(clustered), "hide=dragon"), ["cluster dragon"]);
  const compare = comparePageAddress(clustered, spaces, neighbours, []);
  assert.deepEqual(missedBy(compare, "a=cluster:ant&b=cluster:dragon"), ["cluster dragon"]);
});

test("what is missing is one sentence, whose names are apart, few and short", () => {
  const said = (missed) =>
    missingWords(new Map(Object.entries(missed).map(([noun, names]) => [noun, new Set(names)])))
      .map((word) => (typeof word === "string" ? word : `“${word.name}”`))
      .join("");
  assert.equal(said({}), "");
  assert.equal(said({ class: ["dragon"] }), "This link names the class “dragon”, which is not in this database.");
  assert.equal(
    said({ class: ["dragon", "drake"], shape: ["x"] }),
    "This link names the classes “dragon” and “drake”, and the shape “x”, which are not in this database.",
  );
  assert.equal(
    said({ class: ["dragon"], bin: ["Gc:11"], map: ["mds"] }),
    "This link names the class “dragon”, the bin “Gc:11” and the map “mds”, which this page does not offer.",
  );
  assert.equal(
    said({ shape: Array.from({ length: 1203 }, (_, number) => `s${number}`) }),
    "This link names the shapes “s0”, “s1”, “s2” and 1\u202f200 more, which are not in this database.",
  );
  assert.equal(
    said({ selection: [""] }),
    "This link names a selection of other shapes, which is not in this database.",
  );
  const [, , { name }] = missingWords(new Map([["class", new Set(["<img onerror=x>\u202e".repeat(900)])]]));
  assert.equal(Array.from(name).length, 40);
});

test("a selection is found by few names and by many, and who is not there is told", () => {
  const names = Array.from({ length: 60 }, (_, index) => `bee/${index}`);
  const large = /** @type {any} */ ({
    ids: textsOf(...names),
    indexOfId: new Map(names.map((id, index) => [id, index])),
  });
  for (const count of [2, 50]) {
    const wanted = names.slice(5, 5 + count);
    const query = new URLSearchParams([...wanted, "bee/x"].map((id) => ["select", id]));
    /** @type {string[]} */
    const missed = [];
    const found = readSelection(query, large, (_noun, name) => missed.push(name));
    assert.deepEqual(
      [...found].map((index) => names[index]),
      wanted,
    );
    assert.deepEqual(missed, ["bee/x"]);
  }
});
