"""The data that flows from stage to stage: frozen dataclasses, checked where they are made.

``Database`` of ``ShapeEntry`` -> ``Mesh`` -> per-vertex descriptors -> ``FeatureTable`` -> ``Projection``
-> ``Quality`` -> pages. A ``Failure`` travels beside them to the About page.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]


@dataclass(frozen=True)
class ShapeEntry:
    """One shape of a database: where its mesh is and what is known of it.

    Attributes
    ----------
    id : str
        Unique in the database: the path of the file below the database's root, ``/`` between folders,
        without its suffix (with it where two files differ by the suffix alone). Any Unicode text.
    path : Path
        The mesh file.
    name : str
        What people call it; need not be unique.
    labels : mapping of str to str
        Labeling -> class. A labeling that does not name this shape has no entry here.
    metadata : mapping of str to str
        Further columns of a table, as text, in the table's order.
    """

    id: str
    path: Path
    name: str
    labels: Mapping[str, str] = field(default_factory=dict)
    metadata: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Failure:
    """A file that did not make it: which, at which stage, and why, in words for its owner."""

    path: str
    stage: str
    reason: str


@dataclass(frozen=True)
class Database:
    """A shape database as it was read.

    Attributes
    ----------
    name : str
        Title of the database.
    root : Path
        The folder that ``ShapeEntry.id`` and ``Failure.path`` are relative to.
    layout : str
        Name of the reader that recognised it.
    shapes : tuple of ShapeEntry
        Sorted by id.
    labelings : tuple of str
        The labelings there are; the first is the one to use when none is chosen. Empty without labels.
    parents : mapping
        Labeling -> class -> parent class, for labelings with a hierarchy. A top class has no entry.
    failures : tuple of Failure
        Files that belong to the database but cannot be taken: unknown format, listed but missing.
    warnings : tuple of str
        What its owner should know although nothing failed.
    """

    name: str
    root: Path
    layout: str
    shapes: tuple[ShapeEntry, ...]
    labelings: tuple[str, ...] = ()
    parents: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    failures: tuple[Failure, ...] = ()
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Mesh:
    """A triangle mesh.

    Attributes
    ----------
    vertices : (n, 3) float64 array
        Positions; finite.
    faces : (m, 3) int32 array
        Vertex indices, counter-clockwise seen from outside.
    """

    vertices: FloatArray
    faces: IntArray


@dataclass(frozen=True)
class FeatureBlock:
    """The columns of one feature: ``dimensions`` histograms of ``bins`` bins, dimension by dimension.

    An external feature without histograms has ``bins == 1``.
    """

    name: str
    dimensions: int
    bins: int

    @property
    def width(self) -> int:
        """Number of columns."""
        return self.dimensions * self.bins

    @property
    def columns(self) -> tuple[str, ...]:
        """Names such as ``FPFH[14]:3`` (dimension from 0, bin from 1) or, in one dimension, ``Agd:6``."""
        places = [""] if self.dimensions == 1 else [f"[{d}]" for d in range(self.dimensions)]
        if self.bins == 1:
            return tuple(f"{self.name}{place}" for place in places)
        return tuple(f"{self.name}{place}:{b + 1}" for place in places for b in range(self.bins))


@dataclass(frozen=True)
class FeatureTable:
    """One row of feature values a shape.

    Attributes
    ----------
    shape_ids : tuple of str
        The shape of each row.
    blocks : tuple of FeatureBlock
        The features, in the order of their columns.
    values : (n, w) float64 array
        Finite; ``w`` is the sum of the blocks' widths.
    """

    shape_ids: tuple[str, ...]
    blocks: tuple[FeatureBlock, ...]
    values: FloatArray

    @property
    def columns(self) -> tuple[str, ...]:
        """The name of every column."""
        return tuple(column for block in self.blocks for column in block.columns)

    def slice_of(self, feature: str) -> slice:
        """The columns of one feature. Raises ``KeyError`` for a feature that is not there."""
        start = 0
        for block in self.blocks:
            if block.name == feature:
                return slice(start, start + block.width)
            start += block.width
        raise KeyError(feature)


@dataclass(frozen=True)
class Projection:
    """A map of the database.

    Attributes
    ----------
    method : str
        ``tsne``, ``umap`` or ``pca``.
    features : tuple of str
        The features it was made from.
    seed : int
    xy : (n, 2) float64 array
        One point a shape, in the order of the feature table. Centred, and scaled by one factor into [-1, 1]^2.
    bins : tuple of str or None
        The bins it was made from; None for all bins of its features.
    """

    method: str
    features: tuple[str, ...]
    seed: int
    xy: FloatArray
    bins: tuple[str, ...] | None = None


@dataclass(frozen=True)
class Quality:
    """Neighbourhood hit of a projection (paper, Eq. 7 and 8), in [0, 1], higher is better separated.

    Attributes
    ----------
    k : int
        Number of neighbours; at most the number of shapes less one.
    nh : (n,) float64 array
        Per shape; NaN where the shape has no label or no neighbour.
    nh_c : mapping of str to float
        Per class, by falling value, then by name. Empty without labels.
    nh_s : float or None
        Of the whole database; None without labels.
    null_mean, null_std : float or None
        What random labels with the same class sizes reach on the same map.
    """

    k: int
    nh: FloatArray
    nh_c: Mapping[str, float]
    nh_s: float | None
    null_mean: float | None
    null_std: float | None


@dataclass(frozen=True)
class SubsetScores:
    """One map for every subset of features that was evaluated, and how well it separates the classes.

    Attributes
    ----------
    members : (S, f) bool array
        Which features make each subset; no row is empty, none repeats. With all subsets, row i has the binary
        digits of i + 1, the first feature lowest.
    xy : (S, m, 2) float32 array
        The maps, as in :class:`Projection`, all turned towards that of all features.
    nh : (S, m) float32 array
        NH of each shape; NaN without a label.
    nh_s : (S,) float64 array
        NH_s; NaN for a database without labels.
    nh_c : (S, c) float64 array
        NH_c, in the order of ``FeatureSearch.classes``.
    cpu_seconds : (S,) float64 array
        What each map cost.
    """

    members: npt.NDArray[np.bool_]
    xy: npt.NDArray[np.float32]
    nh: npt.NDArray[np.float32]
    nh_s: FloatArray
    nh_c: FloatArray
    cpu_seconds: FloatArray


@dataclass(frozen=True)
class GreedyStep:
    """A place on the path of Algorithm 1: the best subset after one pass of its outer loop.

    Attributes
    ----------
    features : tuple of str
    changed : tuple of str
        The features that joined or left in this step.
    nh_s : float
    """

    features: tuple[str, ...]
    changed: tuple[str, ...]
    nh_s: float


@dataclass(frozen=True)
class GreedySearch:
    """One run of Algorithm 1 (paper, 4.2), accounted as if nothing had been computed before.

    Attributes
    ----------
    s : int
        How many features may change in a step.
    path : tuple of GreedyStep
        From the empty set on, which is left out, to the result; NH_s rises.
    runs : int
        Distinct subsets that it had to evaluate.
    considered : int
        The same with repetitions, as the paper counts.
    cpu_seconds : float
        Of the distinct ones.
    """

    s: int
    path: tuple[GreedyStep, ...]
    runs: int
    considered: int
    cpu_seconds: float


@dataclass(frozen=True)
class SearchRow:
    """A row of Table 2.

    Attributes
    ----------
    round : int
        From 1; each round has its own seed.
    method : str
        ``exhaustive`` or ``greedy``.
    s : int or None
        Of the greedy search.
    features : tuple of str
        The best subset found.
    nh_s, cpu_seconds : float
    runs : int
        Distinct maps.
    """

    round: int
    method: str
    s: int | None
    features: tuple[str, ...]
    nh_s: float
    cpu_seconds: float
    runs: int


@dataclass(frozen=True)
class SeedSpread:
    """How the NH_s of one subset varies from seed to seed.

    Attributes
    ----------
    features : tuple of str
    nh_s : (seeds,) float64 array
    mean, std : float
        Of ``nh_s``; the sample's standard deviation.
    behind : float
        How far the mean lies below the best one's; 0 for the best itself.
    margin : float
        Half the 95 % interval of ``behind``, paired by shape.
    told_apart : bool
        Whether ``behind`` exceeds ``margin``. If not, this subset may be as good as the best.
    """

    features: tuple[str, ...]
    nh_s: FloatArray
    mean: float
    std: float
    behind: float
    margin: float
    told_apart: bool


@dataclass(frozen=True)
class HeldOutFold:
    """Choosing a subset without the labels of some shapes, then scoring it on these.

    Attributes
    ----------
    features : tuple of str
        The subset that the labels of the other shapes choose.
    shapes : int
        Number held out.
    nh_s_seen : float
        What the choice went by: NH_s of the other shapes, counting only neighbours that are not held out.
    nh_s : float
        NH_s of the held-out shapes on the chosen map.
    nh_s_all : float
        NH_s of the same shapes on the map of all features.
    """

    features: tuple[str, ...]
    shapes: int
    nh_s_seen: float
    nh_s: float
    nh_s_all: float


@dataclass(frozen=True)
class FeatureEffect:
    """What a feature adds or spoils.

    Attributes
    ----------
    feature : str
    alone : float
        NH_s of the map of this feature only.
    mean_with, mean_without : float or None
        Mean NH_s over all subsets with it and without it; None unless the search was exhaustive.
    added : float or None
        Mean change of NH_s when it joins a subset; negative if it spoils. None unless exhaustive, and for the
        only feature.
    """

    feature: str
    alone: float
    mean_with: float | None
    mean_without: float | None
    added: float | None


@dataclass(frozen=True)
class FeatureSearch:
    """The search for the subset of features whose map separates the classes best (paper, 4.1 and 4.2).

    Attributes
    ----------
    method : str
        ``tsne`` or ``umap``.
    seed : int
        Of the maps in ``subsets``; round r of Table 2 has ``seed + r - 1``.
    k : int
        Of the neighbourhood hit.
    features : tuple of str
        Columns of ``subsets.members``.
    classes : tuple of str
        Columns of ``subsets.nh_c``, sorted by name.
    rows : (m,) int32 array
        The shapes that took part, as rising rows of the feature table.
    shape_count : int
        Of the table. More than ``m`` if the search went over a sample.
    subsets : SubsetScores
    exhaustive : bool
        Whether ``subsets`` holds all of them.
    refusal : str or None
        Why not, in words.
    greedy : tuple of GreedySearch
        On the first seed, by rising ``s``. Empty without labels, as all that follows.
    table : tuple of SearchRow
        Table 2.
    spread : tuple of SeedSpread
        Of the best subsets and of all features, by falling mean.
    held_out : tuple of HeldOutFold
    null_best : FloatArray
        The best NH_s that the same search finds for labels dealt out at random, sorted.
    effects : tuple of FeatureEffect
        In the order of ``features``.
    """

    method: str
    seed: int
    k: int
    features: tuple[str, ...]
    classes: tuple[str, ...]
    rows: IntArray
    shape_count: int
    subsets: SubsetScores
    exhaustive: bool
    refusal: str | None
    greedy: tuple[GreedySearch, ...]
    table: tuple[SearchRow, ...]
    spread: tuple[SeedSpread, ...]
    held_out: tuple[HeldOutFold, ...]
    null_best: FloatArray
    effects: tuple[FeatureEffect, ...]


@dataclass(frozen=True)
class BinScores:
    """How well every bin separates every class from the rest (paper, 4.3).

    Attributes
    ----------
    methods : tuple of str
        Names of the scorers.
    classes : tuple of str
        Sorted by name.
    values : (methods, classes, columns) float32 array
        Relative scores in [0, 1]: the best bin of a method and class has 1, and all have 0 where none tells the
        class from the rest. Columns as in the feature table.
    """

    methods: tuple[str, ...]
    classes: tuple[str, ...]
    values: npt.NDArray[np.float32]


@dataclass(frozen=True)
class BinStep:
    """A place on the path of the automatic selection of bins.

    Attributes
    ----------
    bins : tuple of str
        The chosen ones, in the order of the columns.
    added, removed : tuple of str
        What changed against the step before.
    nh_space : float
        NH_s of the shapes in the space of the bins.
    nh_s : float
        NH_s of their t-SNE map.
    xy : (m, 2) float32 array
        The map, as in :class:`Projection`, turned towards that of the step before.
    """

    bins: tuple[str, ...]
    added: tuple[str, ...]
    removed: tuple[str, ...]
    nh_space: float
    nh_s: float
    xy: npt.NDArray[np.float32]


@dataclass(frozen=True)
class BinSelection:
    """A small set of bins whose map separates all classes, and how it was found (paper, 4.4 B, Fig. 7).

    Attributes
    ----------
    seed : int
        Of the maps.
    k : int
        Of the neighbourhood hit.
    rows : (m,) int32 array
        The shapes that took part, as rising rows of the feature table.
    shape_count : int
        Of the table. More than ``m`` if the search went over a sample.
    path : tuple of BinStep
        From one bin to the result. Up to where ``nh_s`` of the map takes over from ``nh_space``, the latter rises;
        from there on the former does. Empty if there are not two classes.
    nh_s_other_seeds : FloatArray
        NH_s of maps of the result with seeds that had no say in it.
    cpu_seconds : float
    """

    seed: int
    k: int
    rows: IntArray
    shape_count: int
    path: tuple[BinStep, ...]
    nh_s_other_seeds: FloatArray
    cpu_seconds: float

    @property
    def bins(self) -> tuple[str, ...]:
        """The result."""
        return self.path[-1].bins if self.path else ()

    @property
    def nh_s(self) -> float:
        """NH_s of its map; NaN without one."""
        return self.path[-1].nh_s if self.path else float("nan")


@dataclass(frozen=True)
class HeldOutBins:
    """Selecting bins without some shapes, then scoring these.

    Attributes
    ----------
    bins : tuple of str
        What the other shapes select.
    shapes : int
        Number held out.
    nh_s_seen : float
        NH_s of the map of the other shapes, at which the selection stopped.
    nh_space, nh_s : float
        Mean NH of the held-out shapes among all, in the space of the bins and on their map.
    nh_s_all : float
        The same on the map of all features.
    knn_accuracy, knn_accuracy_all : float
        Share of the held-out shapes that their k nearest others recognise, by the bins and by all features.
    """

    bins: tuple[str, ...]
    shapes: int
    nh_s_seen: float
    nh_space: float
    nh_s: float
    nh_s_all: float
    knn_accuracy: float
    knn_accuracy_all: float


@dataclass(frozen=True)
class MinimalSet:
    """The bins of one number that separate a class best.

    Attributes
    ----------
    bins : tuple of str
        In the order of the columns.
    nh_c_space, nh_c : float
        NH_c of the class in the space of the bins, and on their t-SNE map.
    xy : (m, 2) float32 array
        The map, as in :class:`Projection`.
    """

    bins: tuple[str, ...]
    nh_c_space: float
    nh_c: float
    xy: npt.NDArray[np.float32]


@dataclass(frozen=True)
class MinimalBins:
    """The fewest bins that separate a class from the rest (paper, 4.4 A, Fig. 6).

    Attributes
    ----------
    label : str
        The class.
    rows : (m,) int32 array
        The shapes that took part, as rising rows of the feature table.
    sets : tuple of MinimalSet
        Of 1, 2, ... bins.
    """

    label: str
    rows: IntArray
    sets: tuple[MinimalSet, ...]

    def fewest(self, nh_c: float) -> MinimalSet:
        """The smallest set that reaches an NH_c in the space of the bins and on the map; else the best one."""
        reached = (found for found in self.sets if min(found.nh_c_space, found.nh_c) >= nh_c)
        return next(reached, max(self.sets, key=lambda found: min(found.nh_c_space, found.nh_c)))


@dataclass(frozen=True)
class BinSearch:
    """The search for bins (paper, 4.4), and what its result is worth.

    Attributes
    ----------
    automatic : BinSelection
    held_out : tuple of HeldOutBins
        The automatic selection repeated without each part of the shapes in turn.
    shuffled : tuple of HeldOutBins
        The same for labels dealt out at random, anew for each of a few parts.
    chance : float
        NH_s that labels without meaning reach on average.
    minimal : tuple of MinimalBins
        Of every class of at least two shapes, by name.
    """

    automatic: BinSelection
    held_out: tuple[HeldOutBins, ...]
    shuffled: tuple[HeldOutBins, ...]
    chance: float
    minimal: tuple[MinimalBins, ...]


@dataclass(frozen=True)
class Painting:
    """A bin painted on a shape (paper, Fig. 8). Square WebP images with transparent background.

    Attributes
    ----------
    column : str
        The bin.
    shape : int
        Row of the feature table.
    value : bytes
        The descriptor's value at every vertex, by its place among the ten bins.
    inside : bytes
        The vertices whose value falls into the bin, against the others.
    """

    column: str
    shape: int
    value: bytes
    inside: bytes


@dataclass(frozen=True)
class ShapeFacts:
    """What was measured of one prepared shape.

    Attributes
    ----------
    sha256 : str
        Of the mesh file's content.
    faces_read, vertices_read : int
        As the file has them.
    faces, vertices : int
        After remeshing.
    components : int
        Connected parts of the prepared mesh.
    watertight : bool
        Whether every edge of the cleaned mesh has two faces.
    repairs : mapping of str to int
        What was mended and how often, for instance ``{"duplicate faces removed": 4}``; empty if nothing was.
    deviation : float
        Largest distance found between the input surface and the prepared one, as a fraction of the
        bounding-box diagonal.
    """

    sha256: str
    faces_read: int
    vertices_read: int
    faces: int
    vertices: int
    components: int
    watertight: bool
    repairs: Mapping[str, int]
    deviation: float


@dataclass(frozen=True)
class Report:
    """All that a site shows: the input of the pages.

    ``shapes``, ``facts``, ``thumbnails``, ``labels``, the rows of ``features`` and of every projection and
    quality have the same order: that of ``shapes``, sorted by id.

    Attributes
    ----------
    labeling : str or None
        The active labeling; None for a database without labels.
    labels : tuple of (str or None)
        The active class of each shape.
    thumbnails : tuple of bytes
        One square WebP image with transparent background a shape.
    edges : (d, 11) float64 array
        The bin edges of every dimension of the features that are histograms, in the order of the table; external
        features have none.
    projections : mapping of str to (Projection, Quality)
        By method, in the order in which a reader should meet them.
    parameters : mapping of str to JSON value
        Every option of the build.
    versions : mapping of str to str
        Of this package, Python, and the libraries that shape the result.
    seconds, cpu_seconds : mapping of str to float
        Per stage, in order: wall-clock, and CPU of all processes.
    search : FeatureSearch or None
        None if it was left out.
    scores : BinScores or None
        None where fewer than two classes have a shape.
    bins : BinSearch or None
        None if the search was left out, or where fewer than two classes have two shapes.
    paintings : tuple of Painting
        Of the bins that ``bins`` found, on shapes that show the contrast; those of external features have none.
    models : tuple of bytes, or None
        The 3D model of each shape as :func:`shapeviz_report.models.pack_model` packs it, gzipped. None if they were
        left out.
    """

    database: Database
    shapes: tuple[ShapeEntry, ...]
    facts: tuple[ShapeFacts, ...]
    thumbnails: tuple[bytes, ...]
    labeling: str | None
    labels: tuple[str | None, ...]
    features: FeatureTable
    edges: FloatArray
    projections: Mapping[str, tuple[Projection, Quality]]
    failures: tuple[Failure, ...]
    parameters: Mapping[str, object]
    versions: Mapping[str, str]
    seconds: Mapping[str, float]
    cpu_seconds: Mapping[str, float]
    search: FeatureSearch | None = None
    scores: BinScores | None = None
    bins: BinSearch | None = None
    paintings: tuple[Painting, ...] = ()
    models: tuple[bytes, ...] | None = None
