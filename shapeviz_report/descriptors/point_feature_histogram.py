"""Point feature histogram (PFH), paper Eq. 4 and 5, after Rusu et al. 2009."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.kernels.pairs import count_pfh
from shapeviz_report.descriptors.surface import NEIGHBOURS, Surface


def compute(surface: Surface) -> np.ndarray:
    r"""Joint histogram of the angles between all pairs of points in a neighbourhood.

    For every ordered pair of the 30 vertices nearest to x, with the frame u, v, w of Eq. 4 (v normalised):

    .. math:: \alpha = v \cdot \bar m, \quad \phi = u \cdot \frac{\bar y - y}{\|\bar y - y\|}, \quad
              \theta = \arctan2(w \cdot \bar m, u \cdot \bar m)

    Each angle is cut into 5 equal parts, :math:`\alpha` and :math:`\phi` over [-1, 1] and :math:`\theta` over
    :math:`[-\pi, \pi]`, which makes 125 cells.

    Returns
    -------
    (n, 125) float32 array
        Share of the pairs in each cell, in [0, 1]; each row adds up to 1. Dimension
        ``25 * alpha + 5 * phi + theta``. Zero where a vertex has fewer than two neighbours. Of two points at
        one place phi and alpha are 0; of two points along u alpha is 0.
    """
    if surface.neighbours.shape[1] < 2:
        return np.zeros((len(surface.vertices), 125), np.float32)
    return count_pfh(surface.vertices, surface.normals, surface.neighbours)


POINT_FEATURE_HISTOGRAM = Descriptor(
    name="PFH",
    title="Point feature histogram",
    measures="How the surface curves in a small patch, from how the directions of every two points in it differ.",
    dimensions=125,
    edges=tuple(float(x) for x in np.linspace(0.0, 0.8, 11) ** 2),
    compute=compute,
    totals=tuple(size * (size - 1) for size in range(2, NEIGHBOURS + 1)),
)
