"""How far classes are groups at all, by the features and on maps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from shapeviz_report.types.arrays import FloatArray, IntArray


@dataclass(frozen=True)
class ClassRates:
    """How well places tell classes apart; a value a class.

    Attributes
    ----------
    nearest : (c,) float64 array
        The share of the shapes of a class whose nearest other shape is of it.
    elected : (c,) float64 array
        The share whose class most of the k nearest others have.
    silhouette : (c,) float64 array
        The mean silhouette of its shapes, in [-1, 1].
    """

    nearest: FloatArray
    elected: FloatArray
    silhouette: FloatArray


@dataclass(frozen=True)
class Separation:
    """How well classes are told apart by what the maps compare, on each map, and with labels dealt at random.

    :func:`shapeviz_report.separation.rate_separation` has the definitions.

    Attributes
    ----------
    k : int
        Number of neighbours that elect a class.
    shapes, shape_count : int
        The labelled shapes that took part, and all: a sample of large databases.
    classes : (c,) tuple of str
        Those with two shapes or more that took part, in natural order.
    sizes : (c,) int array
        The shapes of each that took part.
    features : ClassRates
    maps : mapping of str to ClassRates
        By projection.
    chance : ClassRates
        The mean by the features over labels dealt at random.
    chance_spread : float
        Standard deviation of the mean silhouette of all shapes over labels dealt at random.
    likely : (c,) float64 array
        What the silhouette of each class does not exceed in 95 of 100 such deals.
    mistaken : (c,) int array
        The place among ``classes`` of the other one that is nearest most often; -1 where none is.
    """

    k: int
    shapes: int
    shape_count: int
    classes: tuple[str, ...]
    sizes: IntArray
    features: ClassRates
    maps: Mapping[str, ClassRates]
    chance: ClassRates
    chance_spread: float
    likely: FloatArray
    mistaken: IntArray

    def over_shapes(self, values: FloatArray) -> float:
        """The mean of the values (c,) of classes over their shapes."""
        return float(np.average(values, weights=self.sizes))
