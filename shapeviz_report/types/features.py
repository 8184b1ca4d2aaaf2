"""Rows of features."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from shapeviz_report.types.arrays import FloatArray


@dataclass(frozen=True)
class FeatureBlock:
    """The columns of one feature: ``dimensions`` histograms of ``bins`` bins, dimension by dimension.

    A feature without histograms, of whole shapes or external, has ``bins == 1``.

    Attributes
    ----------
    name : str
    dimensions, bins : int
    weight : float
        What its squared distances count beside those of other features, where features are balanced.
    """

    name: str
    dimensions: int
    bins: int
    weight: float = 1.0

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

    @cached_property
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
