"""Scores of bins, what a search for bins found, and how bins look."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report.types.arrays import FloatArray, IntArray


@dataclass(frozen=True)
class BinScores:
    """How well every bin separates every class from the rest (paper, 4.3).

    Attributes
    ----------
    methods : tuple of str
        Names of the scorers.
    classes : tuple of str
        In natural order.
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
    deal : int
        From 1: each deals the shapes into folds anew.
    bins : tuple of str
        What the other shapes select.
    shapes : int
        Number held out.
    nh_s_seen : float
        NH_s of the map of the other shapes, at which the selection stopped.
    nh_space, nh_s : float
        Mean NH of the held-out shapes among all, in the space of the bins and on their map; the latter over a few seeds
        of the map.
    nh_s_all : float
        The same on maps of all features.
    nh_max : float
        What no map exceeds for these shapes.
    knn_accuracy, knn_accuracy_all : float
        Share of the held-out shapes that their k nearest others recognise, by the bins and by all features.
    nh_s_distinct, nh_s_all_distinct : float or None
        ``nh_s`` and ``nh_s_all`` where one shape of each group of copies stands for all of it, as neighbour too; None
        where there are no copies.
    """

    deal: int
    bins: tuple[str, ...]
    shapes: int
    nh_s_seen: float
    nh_space: float
    nh_s: float
    nh_s_all: float
    nh_max: float
    knn_accuracy: float
    knn_accuracy_all: float
    nh_s_distinct: float | None = None
    nh_s_all_distinct: float | None = None


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
        NH_s that labels without meaning reach on average where bins were chosen for all classes.
    minimal : tuple of MinimalBins
        Of every class of at least two shapes, by name.
    minimal_by_chance : mapping of int to MinimalBins
        The same for random shapes, by their number: that of every class.
    sizes : mapping of str to int
        The number of shapes of each class among which bins were sought for one class.
    """

    automatic: BinSelection
    held_out: tuple[HeldOutBins, ...]
    shuffled: tuple[HeldOutBins, ...]
    chance: float
    minimal: tuple[MinimalBins, ...]
    minimal_by_chance: Mapping[int, MinimalBins]
    sizes: Mapping[str, int]

    def by_chance(self, separated: MinimalBins) -> MinimalBins:
        """What the same search finds for as many random shapes as a class has."""
        return self.minimal_by_chance[self.sizes[separated.label]]


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
