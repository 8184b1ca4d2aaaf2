// Made of shapeviz_report/pages/chunks.py by `make chunks`. Only the type checker reads this file.

declare namespace Chunk {
  /** As many texts as there are shapes, in UTF-8 with a line each, and how many bytes each has. */
  interface Texts {
    bytes: Uint8Array;
    lengths: Uint32Array;
  }
  /** The shapes, one list a fact. */
  interface ShapeList {
    ids: Texts;
    names: Texts;
    groups: Int32Array;
    pictures: string[] | null;
  }
  /** What a map reaches where copies of shapes are left out. */
  interface WithoutCopies {
    copies: number;
    hitOfAll: number | null;
    highest: number | null;
  }
  /** A Shepard diagram: a text a column, with a digit a cell from the lowest on, 0 for no pair; the monotone fit. */
  interface Shepard {
    columns: string[];
    fit: (number | null)[];
    height: number;
  }
  /** How far a map shows who is like whom, and what that is at random. */
  interface Faith {
    kept: Uint16Array;
    mean: number;
    chance: number;
    trustworthiness: number | null;
    continuity: number | null;
    random: number | null;
    stress: number | null;
    randomStress: number | null;
    shepard: Shepard | null;
  }
  /** How false the neighbours of each shape are on a map, and how far missing ones; None where shapes are too few. */
  interface Trust {
    false: Uint16Array | null;
    missing: Uint16Array | null;
  }
  /** A map of all shapes, with its quality; a class without a score has None. One that was brought along is of no */
  interface Method {
    key: string;
    title: string;
    note: string;
    features: string[];
    x: Float32Array;
    y: Float32Array;
    hit: Uint16Array;
    neighbours: number;
    hitOfClass: (number | null)[];
    hitOfAll: number | null;
    withoutCopies: WithoutCopies | null;
    chance: number | null;
    chanceSpread: number | null;
    faith: Faith | null;
  }
  /** Shapes in the order of their pictures on the `sheets`; each grid shows the first `ends` of them. */
  interface SheetsOfMap {
    rows: Int32Array;
    ends: number[];
    sheets: string[];
  }
  /** Small pictures for maps of very many shapes: grids by their cells on a side; `across` pictures on a sheet's. */
  interface Sheets {
    grids: number[];
    across: number;
    maps: Record<string, SheetsOfMap>;
  }
  /** The map of the best subset; its key names the features. */
  interface BestMap {
    key: string;
    title: string;
    note: string;
    features: string[];
    x: Float32Array;
    y: Float32Array;
    hit: Uint16Array;
    neighbours: number;
    hitOfClass: (number | null)[];
    hitOfAll: number | null;
    withoutCopies: WithoutCopies | null;
    chance: number | null;
    chanceSpread: number | null;
    faith: Faith | null;
    trust: Trust;
  }
  /** How many shapes of a class have one of it nearest: by the features, and on a map; what others are taken for. */
  interface ClassCounts {
    name: string;
    shapes: number;
    features: number;
    map: number | null;
    mistaken: string | null;
  }
  /** What a map makes of what the features know: shares whose nearest is of their class; what is lost most. */
  interface MapVerdict {
    nearest: (number | null)[];
    ofAll: number;
    verdict: string;
    lost: ClassCounts | null;
  }
  /** How far the features tell classes apart: of the numbers of `classes`, and over all their shapes. */
  interface Separation {
    neighbours: number;
    classes: number[];
    sizes: number[];
    nearest: (number | null)[];
    ofAll: number;
    elected: number;
    chance: number;
    silhouette: number;
    silhouetteByChance: number;
    hardest: ClassCounts | null;
    maps: Record<string, MapVerdict>;
  }
  /** Whose maps the Overview can show beside its own. */
  interface SubsetChoice {
    method: string;
    features: string[];
    bins: number | null;
    bestByChance: number | null;
    best: string[] | null;
    sample: number | null;
    laidOut: boolean;
  }
  interface MapCharts {
    class: Record<string, any>;
    hit: Record<string, any>;
    thumbnail: Record<string, any>;
    bars: Record<string, any>;
  }
  /** Colours of marks in a theme; `config` is that of charts, `ramp` of numbers, in even steps from the lowest. */
  interface ThemeMarks {
    config: Record<string, any>;
    classes: string[];
    hit: string[];
    unlabelled: string;
    outline: string;
    ground: string;
    ink: string;
    ramp: string[];
    categories: string[];
  }
  /** Symbols as paths, and the colours of each theme. */
  interface Marks {
    symbols: string[];
    categories: string[];
    plain: string;
    missing: string;
    themes: Record<"light" | "dark", ThemeMarks>;
  }
  /** Of how many shapes each part of a chunk in parts is. */
  interface PartSizes {
    details: number;
    pictures: number;
  }
  /** What every page knows of the database. */
  interface Overview {
    shapes: ShapeList;
    partSizes: PartSizes;
    classes: string[];
    labeling: string | null;
    standIn: boolean;
    methods: Method[];
    separation: Separation | null;
    subsets: SubsetChoice | null;
    charts: MapCharts;
    marks: Marks;
  }
  /** What is known of a shape beyond its place. */
  interface ShapeDetails {
    labels: ([string, string])[];
    metadata: ([string, string])[];
    copies: ([number, string])[];
    repairs: ([string, number])[];
    faces: number;
    vertices: number;
    facesRead: number;
    verticesRead: number;
    components: number;
    watertight: boolean;
    deviation: number | null;
    area: number | null;
    volume: number | null;
    extents: number[];
    related: number[] | null;
    gltf: string | null;
  }
  /** A group that the features make: its most central shape, and sentences on what is typical of it. */
  interface Cluster {
    name: string;
    central: number;
    size: number;
    typical: string[];
  }
  /** The groups that the features alone make; `standIn` where they are the active labels, as there are none. */
  interface Clusters {
    standIn: boolean;
    of: Int32Array;
    clusters: Cluster[];
    quality: number;
  }
  /** What shapes can be grouped, filtered or sorted by. */
  interface Field {
    key: string;
    title: string;
    unit: string;
    active: boolean;
    date: boolean;
    names: string[] | null;
    of: Int32Array | null;
    notes: string[] | null;
    numbers: Float64Array | null;
    edges: number[] | null;
  }
  /** What shapes can be ordered by; `byName` are their rows in the order of their names. */
  interface Fields {
    byName: Int32Array;
    fields: Field[];
  }
  /** A class of shapes or of classes; `parent` is the number of a node before it, -1 at the top. */
  interface TreeNode {
    name: string;
    parent: number;
  }
  /** Classes of classes. */
  interface Tree {
    key: string;
    title: string;
    active: boolean;
    nodes: TreeNode[];
    of: Int32Array;
  }
  /** The trees of a database: its classes, and whatever else is ordered in levels. */
  interface Hierarchy {
    trees: Tree[];
  }
  /** One side of an edge in plain words, as in :class:`~shapeviz_report.wording.base.Said`. */
  interface Side {
    clause: string;
    trend: string;
    fewer: boolean;
  }
  /** What lies below and above each inner edge of a histogram, whose first column is `start`. */
  interface Sides {
    start: number;
    below: Side[];
    above: Side[];
  }
  /** How well shapes fit their classes, and what a comparison needs beside the bins. */
  interface Comparison {
    k: number;
    spaces: string[];
    order: number[];
    fit: (number | null)[];
    rival: number[];
    weights: number[];
    whole: string;
    clauses: (string | null)[];
    sides: Sides[];
  }
  /** The colours of features, and of bars that stand for none. */
  interface FeatureMarks {
    features: string[];
    bar: string;
  }
  /** A measure of retrieval. */
  interface Measure {
    title: string;
    explanation: string;
  }
  /** Scores by measure, and precision by recall, on average over shapes and over classes; `each` by class. */
  interface Rated {
    shapes: number[];
    classes: number[];
    curveOfShapes: number[];
    curveOfClasses: number[];
    each: number[][];
  }
  /** How well each choice of features finds shapes of a class, in `steps` from 0 to 1. */
  interface Retrieval {
    steps: number;
    features: string[];
    hues: number[];
    order: number[];
    classes: number[];
    queries: number[];
    measures: Measure[];
    recall: number[];
    members: string[];
    best: number;
    subsets: Rated[];
    bins: string[] | null;
    byBins: Rated | null;
    byNeighbourhood: Rated | null;
    chance: Rated;
    marks: Record<"light" | "dark", FeatureMarks>;
  }
  /** How a class's hit spreads over all subsets. */
  interface Box {
    least: number | null;
    lower: number | null;
    median: number | null;
    upper: number | null;
    most: number | null;
  }
  /** A greedy search: the places of the subsets that it went through. */
  interface GreedyPath {
    s: number;
    runs: number;
    path: number[];
  }
  interface Effect {
    feature: number;
    alone: number;
    with: number | null;
    without: number | null;
  }
  /** How far the seed moves a subset, and whether it is told apart from the best. */
  interface SeedHits {
    place: number;
    hits: (number | null)[];
    mean: number;
    margin: number;
    apart: boolean;
  }
  /** The charts of the Features page. */
  interface SubsetCharts {
    bars: Record<string, any>;
    matrix: Record<string, any>;
    boxes: Record<string, any>;
    effects: Record<string, any>;
    seeds: Record<string, any>;
  }
  /** The same of the map of each subset, by its features, but of single shapes and the diagram. */
  interface SubsetFaith {
    mean: (number | null)[];
    chance: number;
    trustworthiness: (number | null)[] | null;
    continuity: (number | null)[] | null;
    random: number | null;
    stress: (number | null)[];
    randomStress: (number | null)[];
  }
  /** What the subsets of the features reach, from best to worst. */
  interface Search {
    method: string;
    methodTitle: string;
    note: string;
    neighbours: number;
    features: string[];
    hues: number[];
    order: number[];
    classes: number[];
    paper: number[] | null;
    rows: number[] | null;
    members: string[];
    hit: (number | null)[];
    hitOfClass: ((number | null)[])[];
    faith: SubsetFaith | null;
    boxes: Box[];
    boxesOfPaper: Box[] | null;
    chance: number | null;
    highest: number | null;
    chanceBest: number | null;
    greedy: GreedyPath[];
    effects: Effect[];
    spread: SeedHits[];
    charts: SubsetCharts;
    marks: Record<"light" | "dark", FeatureMarks>;
  }
  /** A map a subset: `steps` from the middle to the edge. */
  interface SubsetMaps {
    steps: number;
    x: Int16Array[];
    y: Int16Array[];
    hit: Uint16Array[];
  }
  /** What the map of each subset makes of the neighbours of each shape. */
  interface SubsetNeighbours {
    kept: Uint16Array[];
    false: Uint16Array[] | null;
    missing: Uint16Array[] | null;
  }
  /** What a feature is; `sought` are other words for small and for large values of each dimension. */
  interface FeatureWords {
    title: string;
    aspect: string;
    measures: string;
    lowMeans: string;
    highMeans: string;
    sought: ([string, string])[];
    rooted: boolean;
    ease: number;
  }
  /** A feature: its columns, its words, and between which values the parts "bins" are cut into steps. */
  interface Feature {
    title: string;
    aspect: string;
    measures: string;
    lowMeans: string;
    highMeans: string;
    sought: ([string, string])[];
    rooted: boolean;
    ease: number;
    name: string;
    start: number;
    dimensions: number;
    bins: number;
    weight: number;
    hue: number;
    low: number;
    high: number;
  }
  /** A way to score bins; `exact` where the browser scores as the build does, `live` where it scores at all. */
  interface Scorer {
    key: string;
    title: string;
    explanation: string;
    exact: boolean;
    live: boolean;
  }
  /** The two classes most mixed on the map of all features. */
  interface MixedClasses {
    classes: [number, number];
    mixed: number;
  }
  /** The bins that a search found to keep all classes apart. */
  interface FoundSet {
    bins: number[];
    nh: number;
    allFeatures: number;
    heldOut: number;
    shapes: number;
    pays: boolean;
  }
  /** The bins but for their values. */
  interface Workbench {
    sample: Int32Array | null;
    bytesOfBins: number;
    bytesAPart: number;
    features: Feature[];
    called: string[];
    sentences: string[];
    scaling: "balanced" | "plain";
    neighbours: number;
    seed: number;
    method: string;
    scorers: Scorer[];
    scored: boolean;
    bins: number[] | null;
    example: MixedClasses | null;
    found: FoundSet | null;
    marks: Record<"light" | "dark", FeatureMarks>;
  }
  /** What a dimension of a descriptor measures, and between which values its bins lie. */
  interface Dimension {
    quantity: string;
    unit: string;
    edges: number[];
  }
  /** Pictures of a bin on a shape: its value, and what lies inside; and the share of the shape that does. */
  interface PaintedBin {
    column: number;
    shape: number;
    share: number;
    value: string;
    inside: string;
  }
  /** Bins that separate a class, what they reach, and their map in steps. */
  interface BinSet {
    bins: number[];
    nhSpace: number;
    nh: number;
    x: number[];
    y: number[];
  }
  /** What as many bins reach for shuffled labels. */
  interface ChanceHit {
    nh: number;
    nhSpace: number;
  }
  /** The fewest bins that separate a class: `other` is the class it is mixed with most. */
  interface SeparatedClass {
    group: number;
    other: number;
    sets: BinSet[];
    highest: number;
    byChance: ChanceHit[];
  }
  /** A step of the selection of bins for all classes. */
  interface PathStep {
    bins: number[];
    nhSpace: number;
    nh: number;
    x: number[];
    y: number[];
    added: number[];
    removed: number[];
  }
  /** Bins that were chosen without some shapes, and what these reach on their map, and on that of all bins. */
  interface Fold {
    bins: number[];
    shapes: number;
    deal: number;
    nhSpace: number;
    nh: number;
    nhAll: number;
    recognised: number;
    recognisedAll: number;
  }
  /** What the search for bins found; all but the first two left out where nothing was searched. */
  interface FoundBins {
    minimal: SeparatedClass[];
    path: PathStep[];
    rows?: number[] | null;
    rowsOfClasses?: number[] | null;
    neighbours?: number;
    seed?: number;
    otherSeeds?: (number | null)[];
    heldOut?: Fold[];
    shuffled?: Fold[];
    chance?: number;
    allFeatures?: number;
  }
  /** What the search for bins found, and what views of shapes need. */
  interface Selection {
    minimal: SeparatedClass[];
    path: PathStep[];
    rows?: number[] | null;
    rowsOfClasses?: number[] | null;
    neighbours?: number;
    seed?: number;
    otherSeeds?: (number | null)[];
    heldOut?: Fold[];
    shuffled?: Fold[];
    chance?: number;
    allFeatures?: number;
    coordinateSteps: number;
    dimensions: Dimension[];
    paintings: PaintedBin[];
    models: string[] | null;
    ramp: string[];
    clay: number[];
    marked: number[];
  }
  /** What the parts "rows", "columns", "components" and "classes" are in terms of. */
  interface Levels {
    low: Float32Array;
    high: Float32Array;
    variances: Float64Array;
    weights: Float64Array;
    order: Int32Array;
    rowsAPart: number;
    columnsAPart: number;
    levelsACell: number;
  }
  /** Every chunk by its name; one is left out where there is nothing to say. Bytes become an `ArrayBuffer`. */
  interface Chunks {
    overview: Overview;
    trust: Record<string, Trust>;
    sheets: Sheets;
    best: BestMap;
    texts: Texts;
    clusters: Clusters | null;
    fields: Fields;
    hierarchy: Hierarchy;
    compare: Comparison;
    retrieval: Retrieval;
    search: Search;
    subsets: SubsetMaps;
    faith: SubsetNeighbours;
    workbench: Workbench;
    scores: ArrayBuffer;
    selection: Selection;
    engine: string;
    levels: Levels;
    paintings: Record<string, string>;
  }
  /** WebP files, one after the other, and where each ends. */
  interface PicturePart {
    ends: Uint32Array;
    content: Uint8Array;
  }
  /** Where all shapes lie along some principal components of a feature. */
  interface ComponentPart {
    unit: number;
    values: Uint8Array;
  }
  /** How the values of some shapes are spread, in levels. */
  interface ClassPart {
    shapes: number;
    means: Float32Array;
    variances: Float32Array;
    upTo: Float32Array;
    cells: Uint32Array;
  }
  /** Chunks that come in parts: what one of each holds. Those from `rows` on are only there with the chunk */
  interface Parts {
    details: ShapeDetails[];
    pictures: PicturePart;
    bins: ArrayBuffer;
    neighbours: ArrayBuffer;
    rows: ArrayBuffer;
    columns: ArrayBuffer;
    components: ComponentPart;
    classes: ClassPart;
  }
}
