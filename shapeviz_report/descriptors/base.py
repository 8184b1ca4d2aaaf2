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
    dimensions : int
        Number of values a vertex.
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
    dimensions: int
    edges: tuple[float, ...]
    compute: Callable[[Surface], np.ndarray]
    totals: tuple[int, ...] = ()
