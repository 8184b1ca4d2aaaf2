"""The contract of a local descriptor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from shapeviz_report.descriptors.surface import Surface


@dataclass(frozen=True)
class Descriptor:
    """A local shape descriptor: d values at every vertex.

    Attributes
    ----------
    name : str
        Short name, as in the paper's Table 1; begins the names of its bins.
    title : str
        Its full name.
    measures : str
        What it measures, in a sentence that needs no mathematics.
    quantities : tuple of str
        What the value in each dimension is, as it stands in "where ... is from 1.4 to 1.6".
    unit : str
        Of the values, as it follows a number: a word, ``%`` where they are fractions of 1, or empty.
    low, high : str
        Where on a shape, or in what surroundings, small and large values are found.
    edges : tuple of float
        The 11 rising edges of the 10 histogram bins of the default preset, the same for every dimension.
        Values beyond the first or last edge belong to the first or last bin. Histograms take them as
        :func:`shapeviz_report.features.clear_edges` moves them.
    compute : callable
        ``Surface -> (n, dimensions)`` float array, finite for every surface.
    totals : tuple of int
        Where values are shares of a number of things, the numbers that there may be of them: every value is a
        whole multiple of one over one of these. Empty where values vary continuously.
    """

    name: str
    title: str
    measures: str
    quantities: tuple[str, ...]
    unit: str
    low: str
    high: str
    edges: tuple[float, ...]
    compute: Callable[[Surface], np.ndarray]
    totals: tuple[int, ...] = ()

    @property
    def dimensions(self) -> int:
        """Number of values a vertex."""
        return len(self.quantities)
