"""The data that pages load, as JSON holds it: both ends keep to these types.

mypy holds the writers to them, and ``site/scripts/chunks.d.ts``, which ``make chunks`` makes of this module, the
browser's scripts. Kinds are those that JSON has, a tuple a list of so many values, and arrays of numbers, which the
browser has as arrays of the same type: what is as long as the database belongs into one.
"""

# Annotations are evaluated: what a TypedDict knows of keys that may be left out, it reads from them.
from typing import Any, Literal, NotRequired, TypedDict

import numpy as np
import numpy.typing as npt

from shapeviz_report.charts import ThemeName

#: A specification, or a configuration, of Vega-Lite.
Spec = dict[str, Any]


class Texts(TypedDict):
    """As many texts as there are shapes, in UTF-8 with a line each, and how many bytes each has."""

    bytes: npt.NDArray[np.uint8]
    lengths: npt.NDArray[np.uint32]


class ShapeList(TypedDict):
    """The shapes, one list a fact.

    Attributes
    ----------
    ids, names : Texts
    groups : (n,) int32 array
        The numbers of classes, -1 without one.
    pictures : list of str, or None
        The files below ``thumbnails``; None where there are too many shapes for files.
    """

    ids: Texts
    names: Texts
    groups: npt.NDArray[np.int32]
    pictures: list[str] | None


class WithoutCopies(TypedDict):
    """What a map reaches where copies of shapes are left out."""

    copies: int
    hitOfAll: float | None
    highest: float | None


class Shepard(TypedDict):
    """A Shepard diagram: a text a column, with a digit a cell from the lowest on, 0 for no pair; the monotone fit."""

    columns: list[str]
    fit: list[float | None]
    height: float


#: A share of each shape, in ``SHARE_STEPS`` steps from 0 to 1; ``NO_SHARE`` where it has none.
Shares = npt.NDArray[np.uint16]


class Faith(TypedDict):
    """How far a map shows who is like whom, and what that is at random.

    Attributes
    ----------
    kept : Shares
    mean : float
        Of ``kept``; at random ``chance``.
    trustworthiness, continuity : float or None
        At random ``random``.
    stress : float or None
        At random ``randomStress``.
    """

    kept: Shares
    mean: float
    chance: float
    trustworthiness: float | None
    continuity: float | None
    random: float | None
    stress: float | None
    randomStress: float | None
    shepard: Shepard | None


class Trust(TypedDict):
    """How false the neighbours of each shape are on a map, and how far missing ones; None where shapes are too few."""

    false: Shares | None
    missing: Shares | None


class Method(TypedDict):
    """A map of all shapes, with its quality; a class without a score has None. One that was brought along is of no
    features."""

    key: str
    title: str
    note: str
    features: list[str]
    x: npt.NDArray[np.float32]
    y: npt.NDArray[np.float32]
    hit: Shares
    neighbours: int
    hitOfClass: list[float | None]
    hitOfAll: float | None
    withoutCopies: WithoutCopies | None
    chance: float | None
    chanceSpread: float | None
    faith: Faith | None


class SheetsOfMap(TypedDict):
    """Shapes in the order of their pictures on the ``sheets``; each grid shows the first ``ends`` of them."""

    rows: npt.NDArray[np.int32]
    ends: list[int]
    sheets: list[str]


class Sheets(TypedDict):
    """Small pictures for maps of very many shapes: grids by their cells on a side; ``across`` pictures on a sheet's."""

    grids: list[int]
    across: int
    maps: dict[str, SheetsOfMap]


class BestMap(Method):
    """The map of the best subset; its key names the features."""

    trust: Trust


class ClassCounts(TypedDict):
    """How many shapes of a class have one of it nearest: by the features, and on a map; what others are taken for."""

    name: str
    shapes: int
    features: int
    map: int | None
    mistaken: str | None


class MapVerdict(TypedDict):
    """What a map makes of what the features know: shares whose nearest is of their class; what is lost most."""

    nearest: list[float | None]
    ofAll: float
    verdict: str
    lost: ClassCounts | None


class Separation(TypedDict):
    """How far the features tell classes apart: of the numbers of ``classes``, and over all their shapes."""

    neighbours: int
    classes: list[int]
    sizes: list[int]
    nearest: list[float | None]
    ofAll: float
    elected: float
    chance: float
    silhouette: float
    silhouetteByChance: float
    hardest: ClassCounts | None
    maps: dict[str, MapVerdict]


class SubsetChoice(TypedDict):
    """Whose maps the Overview can show beside its own.

    Attributes
    ----------
    sample : int or None
        How many shapes the search laid out where these are not all: the others are placed among them, by the parts
        "components".
    laidOut : bool
        Whether then the best subset has a map of all shapes: the chunk "best".
    """

    method: str
    features: list[str]
    bins: int | None
    bestByChance: float | None
    best: list[str] | None
    sample: int | None
    laidOut: bool


MapCharts = TypedDict("MapCharts", {"class": Spec, "hit": Spec, "thumbnail": Spec, "bars": Spec})


class ThemeMarks(TypedDict):
    """Colours of marks in a theme; ``config`` is that of charts, ``ramp`` of numbers, in even steps from the lowest."""

    config: Spec
    classes: list[str]
    hit: list[str]
    unlabelled: str
    outline: str
    ground: str
    ink: str
    ramp: list[str]
    categories: list[str]


class Marks(TypedDict):
    """Symbols as paths, and the colours of each theme.

    Attributes
    ----------
    symbols : list of str
        Of the classes.
    categories : list of str
        Of values of other fields, the most that are told apart.
    plain, missing : str
        Of a shape whose colour says all, and of one that nothing is known of.
    """

    symbols: list[str]
    categories: list[str]
    plain: str
    missing: str
    themes: dict[ThemeName, ThemeMarks]


class PartSizes(TypedDict):
    """Of how many shapes each part of a chunk in parts is."""

    details: int
    pictures: int


class Overview(TypedDict):
    """What every page knows of the database."""

    shapes: ShapeList
    partSizes: PartSizes
    classes: list[str]
    labeling: str | None
    standIn: bool
    methods: list[Method]
    separation: Separation | None
    subsets: SubsetChoice | None
    charts: MapCharts
    marks: Marks


class ShapeDetails(TypedDict):
    """What is known of a shape beyond its place.

    Attributes
    ----------
    labels, metadata : list of (str, str)
        By labeling and by column.
    copies : list of (int, str)
        Shapes that are the same shape, with what says so.
    related : list of int, or None
        The shapes most similar by neighbourhood, the most similar first; None where there are too many.
    gltf : str or None
        Its file below ``gltf/``.
    """

    labels: list[tuple[str, str]]
    metadata: list[tuple[str, str]]
    copies: list[tuple[int, str]]
    repairs: list[tuple[str, int]]
    faces: int
    vertices: int
    facesRead: int
    verticesRead: int
    components: int
    watertight: bool
    deviation: float | None
    area: float | None
    volume: float | None
    extents: list[float]
    related: list[int] | None
    gltf: str | None


class Cluster(TypedDict):
    """A group that the features make: its most central shape, and sentences on what is typical of it."""

    name: str
    central: int
    size: int
    typical: list[str]


class Clusters(TypedDict):
    """The groups that the features alone make; ``standIn`` where they are the active labels, as there are none."""

    standIn: bool
    of: npt.NDArray[np.int32]
    clusters: list[Cluster]
    quality: float


class Field(TypedDict):
    """What shapes can be grouped, filtered or sorted by.

    Attributes
    ----------
    key : str
        Names the field in an address.
    title, unit : str
    active : bool
        Whether it is the active labeling.
    date : bool
        Whether its numbers are days from the first of 1970.
    names : list of str, or None
        The values in their order; None for a field that has no few values.
    of : (n,) int32 array, or None
        The number of each shape's value, -1 without one; None as with ``names``.
    notes : list of str, or None
        A sentence on each of the values.
    numbers : (n,) float64 array, or None
        The number of each shape, NaN without one; None for a field that is no number.
    edges : list of float, or None
        Of intervals, which rise and hold all numbers; None also for a field of a few numbers.
    """

    key: str
    title: str
    unit: str
    active: bool
    date: bool
    names: list[str] | None
    of: npt.NDArray[np.int32] | None
    notes: list[str] | None
    numbers: npt.NDArray[np.float64] | None
    edges: list[float] | None


class Fields(TypedDict):
    """What shapes can be ordered by; ``byName`` are their rows in the order of their names."""

    byName: npt.NDArray[np.int32]
    fields: list[Field]


class TreeNode(TypedDict):
    """A class of shapes or of classes; ``parent`` is the number of a node before it, -1 at the top."""

    name: str
    parent: int


class Tree(TypedDict):
    """Classes of classes.

    Attributes
    ----------
    key : str
        That of the field it is of, or ``folders``.
    title : str
    active : bool
        Whether it is of the active labeling.
    nodes : list of TreeNode
        Each after its parent, siblings in natural order.
    of : (n,) int32 array
        The node of every shape, -1 without one.
    """

    key: str
    title: str
    active: bool
    nodes: list[TreeNode]
    of: npt.NDArray[np.int32]


class Hierarchy(TypedDict):
    """The trees of a database: its classes, and whatever else is ordered in levels."""

    trees: list[Tree]


class Side(TypedDict):
    """One side of an edge in plain words, as in :class:`~shapeviz_report.wording.base.Said`."""

    clause: str
    trend: str
    fewer: bool


class Sides(TypedDict):
    """What lies below and above each inner edge of a histogram, whose first column is ``start``."""

    start: int
    below: list[Side]
    above: list[Side]


class Comparison(TypedDict):
    """How well shapes fit their classes, and what a comparison needs beside the bins.

    Attributes
    ----------
    k : int
        Numbers a shape in each of the parts "neighbours".
    spaces : list of str
        The order of these parts.
    order : list of int
        The classes, alike ones beside each other.
    fit, rival : list
        A shape's fit to its class, and the class it fits next best; None and -1 without.
    weights : list of float
        What a squared difference in a feature's compared values counts.
    whole : str
        What shares are of, in words.
    clauses : list of str
        What the surface does that a bin counts, in plain words; None for a value that is no share.
    sides : list of Sides
        Of each histogram that a stranger can picture.
    """

    k: int
    spaces: list[str]
    order: list[int]
    fit: list[float | None]
    rival: list[int]
    weights: list[float]
    whole: str
    clauses: list[str | None]
    sides: list[Sides]


class FeatureMarks(TypedDict):
    """The colours of features, and of bars that stand for none."""

    features: list[str]
    bar: str


class Measure(TypedDict):
    """A measure of retrieval."""

    title: str
    explanation: str


class Rated(TypedDict):
    """Scores by measure, and precision by recall, on average over shapes and over classes; ``each`` by class."""

    shapes: list[int]
    classes: list[int]
    curveOfShapes: list[int]
    curveOfClasses: list[int]
    each: list[list[int]]


class Retrieval(TypedDict):
    """How well each choice of features finds shapes of a class, in ``steps`` from 0 to 1.

    Attributes
    ----------
    order : list of int
        The features by falling average precision of each alone.
    classes : list of int
        Those that were asked for, as the Overview numbers them; ``queries`` of each.
    members : list of str
        The features of each of ``subsets``: a ``1`` or ``0`` a feature.
    best : int
        The best of ``subsets``.
    bins : list of str, or None
        The chosen bins, and with ``byBins`` what they reach.
    """

    steps: int
    features: list[str]
    hues: list[int]
    order: list[int]
    classes: list[int]
    queries: list[int]
    measures: list[Measure]
    recall: list[float]
    members: list[str]
    best: int
    subsets: list[Rated]
    bins: list[str] | None
    byBins: Rated | None
    byNeighbourhood: Rated | None
    chance: Rated
    marks: dict[ThemeName, FeatureMarks]


class Box(TypedDict):
    """How a class's hit spreads over all subsets."""

    least: float | None
    lower: float | None
    median: float | None
    upper: float | None
    most: float | None


class GreedyPath(TypedDict):
    """A greedy search: the places of the subsets that it went through."""

    s: int
    runs: int
    path: list[int]


#: What a feature reaches alone, and maps with and without it on average.
Effect = TypedDict("Effect", {"feature": int, "alone": float, "with": float | None, "without": float | None})


class SeedHits(TypedDict):
    """How far the seed moves a subset, and whether it is told apart from the best."""

    place: int
    hits: list[float | None]
    mean: float
    margin: float
    apart: bool


class SubsetCharts(TypedDict):
    """The charts of the Features page."""

    bars: Spec
    matrix: Spec
    boxes: Spec
    effects: Spec
    seeds: Spec


class SubsetFaith(TypedDict):
    """The same of the map of each subset, by its features, but of single shapes and the diagram."""

    mean: list[float | None]
    chance: float
    trustworthiness: list[float | None] | None
    continuity: list[float | None] | None
    random: float | None
    stress: list[float | None]
    randomStress: list[float | None]


class Search(TypedDict):
    """What the subsets of the features reach, from best to worst.

    Attributes
    ----------
    hues : list of int
        The number of each feature's colour.
    order : list of int
        The features, those that help most first.
    classes : list of int
        The columns of ``hitOfClass``, as the Overview numbers them.
    paper : list of int, or None
        Those of ``features`` that are of the paper's Table 1, where there are others and all subsets of these were
        searched; ``boxesOfPaper`` is the spread over them.
    rows : list of int, or None
        The shapes that took part; None for all.
    members : list of str
        The features of each subset: a ``1`` or ``0`` a feature.
    """

    method: str
    methodTitle: str
    note: str
    neighbours: int
    features: list[str]
    hues: list[int]
    order: list[int]
    classes: list[int]
    paper: list[int] | None
    rows: list[int] | None
    members: list[str]
    hit: list[float | None]
    hitOfClass: list[list[float | None]]
    faith: SubsetFaith | None
    boxes: list[Box]
    boxesOfPaper: list[Box] | None
    chance: float | None
    highest: float | None
    chanceBest: float | None
    greedy: list[GreedyPath]
    effects: list[Effect]
    spread: list[SeedHits]
    charts: SubsetCharts
    marks: dict[ThemeName, FeatureMarks]


class SubsetMaps(TypedDict):
    """A map a subset: ``steps`` from the middle to the edge."""

    steps: int
    x: list[npt.NDArray[np.int16]]
    y: list[npt.NDArray[np.int16]]
    hit: list[Shares]


class SubsetNeighbours(TypedDict):
    """What the map of each subset makes of the neighbours of each shape."""

    kept: list[Shares]
    false: list[Shares] | None
    missing: list[Shares] | None


class FeatureWords(TypedDict):
    """What a feature is; ``sought`` are other words for small and for large values of each dimension.

    Values that are ``rooted`` are square roots of shares, which readers are told.
    """

    title: str
    aspect: str
    measures: str
    lowMeans: str
    highMeans: str
    sought: list[tuple[str, str]]
    rooted: bool
    ease: float


class Feature(FeatureWords):
    """A feature: its columns, its words, and between which values the parts "bins" are cut into steps."""

    name: str
    start: int
    dimensions: int
    bins: int
    weight: float
    hue: int
    low: float
    high: float


class Scorer(TypedDict):
    """A way to score bins; ``exact`` where the browser scores as the build does, ``live`` where it scores at all."""

    key: str
    title: str
    explanation: str
    exact: bool
    live: bool


class MixedClasses(TypedDict):
    """The two classes most mixed on the map of all features."""

    classes: tuple[int, int]
    mixed: float


class FoundSet(TypedDict):
    """The bins that a search found to keep all classes apart.

    Attributes
    ----------
    bins : list of int
    nh, allFeatures : float
        NH of their map, and of that of all features.
    heldOut : float
        NH of shapes that such a search never saw.
    shapes : int
        How many shapes took part; fewer than there are if it was a sample.
    pays : bool
        Whether shapes that the choice never saw are surely better off with chosen bins than with all features.
    """

    bins: list[int]
    nh: float
    allFeatures: float
    heldOut: float
    shapes: int
    pays: bool


class Workbench(TypedDict):
    """The bins but for their values.

    Attributes
    ----------
    sample : (m,) int32 array, or None
        The shapes whose values the parts "bins" hold, rising; None for all.
    bytesOfBins, bytesAPart : int
        Of all these parts together, and of each but the last.
    bins : list of int, or None
        The columns that the maps of the site are made from; None for all.
    """

    sample: npt.NDArray[np.int32] | None
    bytesOfBins: int
    bytesAPart: int
    features: list[Feature]
    called: list[str]
    sentences: list[str]
    scaling: Literal["balanced", "plain"]
    neighbours: int
    seed: int
    method: str
    scorers: list[Scorer]
    scored: bool
    bins: list[int] | None
    example: MixedClasses | None
    found: FoundSet | None
    marks: dict[ThemeName, FeatureMarks]


class Dimension(TypedDict):
    """What a dimension of a descriptor measures, and between which values its bins lie."""

    quantity: str
    unit: str
    edges: list[float]


class PaintedBin(TypedDict):
    """Pictures of a bin on a shape: its value, and what lies inside; and the share of the shape that does."""

    column: int
    shape: int
    share: float
    value: str
    inside: str


class BinSet(TypedDict):
    """Bins that separate a class, what they reach, and their map in steps."""

    bins: list[int]
    nhSpace: float
    nh: float
    x: list[int]
    y: list[int]


class ChanceHit(TypedDict):
    """What as many bins reach for shuffled labels."""

    nh: float
    nhSpace: float


class SeparatedClass(TypedDict):
    """The fewest bins that separate a class: ``other`` is the class it is mixed with most."""

    group: int
    other: int
    sets: list[BinSet]
    highest: float
    byChance: list[ChanceHit]


class PathStep(BinSet):
    """A step of the selection of bins for all classes."""

    added: list[int]
    removed: list[int]


class Fold(TypedDict):
    """Bins that were chosen without some shapes, and what these reach on their map, and on that of all bins."""

    bins: list[int]
    shapes: int
    deal: int
    nhSpace: float
    nh: float
    nhAll: float
    recognised: float
    recognisedAll: float


class FoundBins(TypedDict):
    """What the search for bins found; all but the first two left out where nothing was searched.

    Attributes
    ----------
    minimal : list of SeparatedClass
    path : list of PathStep
    rows, rowsOfClasses : list of int, or None
        The shapes that took part where bins were chosen for all classes, and for one class; None for all.
    allFeatures : float
        What the map of all features reaches.
    """

    minimal: list[SeparatedClass]
    path: list[PathStep]
    rows: NotRequired[list[int] | None]
    rowsOfClasses: NotRequired[list[int] | None]
    neighbours: NotRequired[int]
    seed: NotRequired[int]
    otherSeeds: NotRequired[list[float | None]]
    heldOut: NotRequired[list[Fold]]
    shuffled: NotRequired[list[Fold]]
    chance: NotRequired[float]
    allFeatures: NotRequired[float]


class Selection(FoundBins):
    """What the search for bins found, and what views of shapes need.

    Attributes
    ----------
    coordinateSteps : int
        From the middle of a map to its edge.
    dimensions : list of Dimension
        Of all features with histograms.
    models : list of str, or None
        The name of every shape's 3D model.
    ramp : list of str
        The colour of each bin of a dimension.
    clay, marked : list of float
        The colour of surfaces, and of what is marked on them, in linear light.
    """

    coordinateSteps: int
    dimensions: list[Dimension]
    paintings: list[PaintedBin]
    models: list[str] | None
    ramp: list[str]
    clay: list[float]
    marked: list[float]


class Levels(TypedDict):
    """What the parts "rows", "columns", "components" and "classes" are in terms of.

    Attributes
    ----------
    low, high : (w,) float32 array
        The compared values of a column that are level 0 and level 255.
    variances : (w,) float64 array
        Of the compared values of all shapes.
    weights : (f,) float64 array
        What a squared difference in a feature's compared values counts.
    order : (n,) int32 array
        The shapes as the parts "rows" have them: class by class, first those without one, within a class scattered.
    rowsAPart, columnsAPart : int
        Shapes a part of the rows; columns a part of the columns, where a feature has as many left.
    levelsACell : int
        Levels that a class counts together.
    """

    low: npt.NDArray[np.float32]
    high: npt.NDArray[np.float32]
    variances: npt.NDArray[np.float64]
    weights: npt.NDArray[np.float64]
    order: npt.NDArray[np.int32]
    rowsAPart: int
    columnsAPart: int
    levelsACell: int


class Chunks(TypedDict, total=False):
    """Every chunk by its name; one is left out where there is nothing to say. Bytes become an ``ArrayBuffer``.

    Attributes
    ----------
    trust : dict of str to Trust
        Of each map of the chunk "overview", by its key.
    sheets : Sheets
        Empty where every shape has a picture of its own.
    best : BestMap
        Where the search laid out a sample.
    texts : Texts
        What a search finds a shape by beside its id, name and class: labels and metadata.
    scores : bytes
        The score of every scorer, class and column in 65,535 steps; uint16.
    engine : str
        The script of the worker.
    levels : Levels
        Only where the compared values are too many for one chunk.
    paintings : dict of str to str
        The content of every painted bin in base64, by its path; not in a site of one file, where they are anyway.
    """

    overview: Overview
    trust: dict[str, Trust]
    sheets: Sheets
    best: BestMap
    texts: Texts
    clusters: Clusters | None
    fields: Fields
    hierarchy: Hierarchy
    compare: Comparison
    retrieval: Retrieval
    search: Search
    subsets: SubsetMaps
    faith: SubsetNeighbours
    workbench: Workbench
    scores: bytes
    selection: Selection
    engine: str
    levels: Levels
    paintings: dict[str, str]


class PicturePart(TypedDict):
    """WebP files, one after the other, and where each ends."""

    ends: npt.NDArray[np.uint32]
    content: npt.NDArray[np.uint8]


class ComponentPart(TypedDict):
    """Where all shapes lie along some principal components of a feature.

    Attributes
    ----------
    unit : float
        What a squared difference of one counts in squared distances.
    values : (c * n,) uint8 array
        Component after component.
    """

    unit: float
    values: npt.NDArray[np.uint8]


class ClassPart(TypedDict):
    """How the values of some shapes are spread, in levels.

    Attributes
    ----------
    shapes : int
    means, variances : (w,) float32 array
    upTo : (w,) float32 array
        Of each bin, the variance of the share of the surface that lies in it and in those before it of its dimension;
        not in levels, and 0 for a feature of whole shapes.
    cells : (w * c,) uint32 array
        Column after column, how many shapes have a value of each cell of ``Levels.levelsACell`` levels.
    """

    shapes: int
    means: npt.NDArray[np.float32]
    variances: npt.NDArray[np.float32]
    upTo: npt.NDArray[np.float32]
    cells: npt.NDArray[np.uint32]


class Parts(TypedDict, total=False):
    """Chunks that come in parts: what one of each holds. Those from ``rows`` on are only there with the chunk
    "levels".

    Attributes
    ----------
    details : list of ShapeDetails
        In the order of the shapes.
    pictures : PicturePart
        Class by class, first those without one; of a class in the order of the shapes. Not in a site of one file that
        has them as files.
    bins : bytes
        One after the other, the compared values, column after column, in 65,535 steps from ``low`` to ``high`` of the
        feature; uint16. Of the shapes of ``Workbench.sample`` where there are too many for a browser.
    neighbours : bytes
        A part a space of a comparison: the nearest shapes of every shape; uint32.
    rows : bytes
        The levels of all compared values, shape after shape, in the order of ``Levels``; uint8.
    columns : bytes
        The levels of some columns of a feature, column after column; uint8.
    components : ComponentPart
        A part a feature.
    classes : ClassPart
        A part a class, and the last one of all shapes.
    """

    details: list[ShapeDetails]
    pictures: PicturePart
    bins: bytes
    neighbours: bytes
    rows: bytes
    columns: bytes
    components: ComponentPart
    classes: ClassPart
