"""How well similar shapes are found."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report.types.arrays import FloatArray, IntArray


@dataclass(frozen=True)
class Rating:
    """How well a ranking of shapes by similarity brings those of the query's class to the front.

    Attributes
    ----------
    scores : (c, 6) float64 array
        The mean of each of :data:`shapeviz_report.retrieval.MEASURES` over the queries of each class; in [0, 1].
    precision : (c, 20) float64 array
        The same of the precision at each of :data:`shapeviz_report.retrieval.RECALL_LEVELS`; in [0, 1], not rising.
    """

    scores: FloatArray
    precision: FloatArray


@dataclass(frozen=True)
class Retrieval:
    """Every shape as a query for the others of its class, by many choices of what is compared.

    Attributes
    ----------
    features : tuple of str
        Columns of ``members``.
    rows : (m,) int32 array
        The shapes that took part, as rows of the feature table.
    shape_count : int
        Of the table. More than ``m`` if a sample stands for all.
    classes : (c,) tuple of str
        Those with two shapes or more among ``rows``, by name; at least one.
    queries : (c,) int32 array
        Shapes of each class.
    members : (S, f) bool array
        Which features make each subset: each alone, all together, and those that a search took.
    subsets : (S,) tuple of Rating
    bins : tuple of str or None
        A choice of bins that was rated too: of the maps of the site where they are of chosen bins, else those that
        separate all classes, if a search found some.
    by_bins : Rating or None
        By these.
    by_neighbourhood : Rating or None
        All features, by distances that know their neighbourhood; None where there are too many shapes for these.
    chance : Rating
        What a random order reaches on average.
    """

    features: tuple[str, ...]
    rows: IntArray
    shape_count: int
    classes: tuple[str, ...]
    queries: IntArray
    members: npt.NDArray[np.bool_]
    subsets: tuple[Rating, ...]
    bins: tuple[str, ...] | None
    by_bins: Rating | None
    by_neighbourhood: Rating | None
    chance: Rating

    def over_shapes(self, values: FloatArray) -> FloatArray:
        """The mean of values of each class (c, v) over all queries; (v,)."""
        return np.average(values, axis=0, weights=self.queries)

    def place(self, features: tuple[str, ...]) -> int:
        """The row of ``members`` that has these features and no others."""
        wanted = np.isin(self.features, features)
        return int(np.flatnonzero((self.members == wanted).all(axis=1))[0])

    def names(self, row: int) -> tuple[str, ...]:
        """The features of a subset, by its row of ``members``."""
        return tuple(name for name, has in zip(self.features, self.members[row], strict=True) if has)
