"""Fast point feature histogram (FPFH), paper Eq. 6, after Rusu et al. 2009."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.kernels.pairs import average_spfh, count_spfh
from shapeviz_report.descriptors.surface import Surface

NEAREST = 1e-4
"""Distances below this count as this, so that vertices at one place do not drown all others."""


def compute(surface: Surface) -> np.ndarray:
    r"""Histograms of the angles to the neighbours, averaged over the neighbourhood.

    SPFH(x) holds three histograms of 11 bins, of :math:`\alpha, \phi, \theta` (Eq. 5) over the pairs of x and
    its 30 nearest vertices. Then

    .. math:: FPFH(x) = SPFH(x) + \frac{1}{k} \sum_{y \in N_{x,k}} \frac{SPFH(y)}{\|x - y\|}

    and each of its three histograms is divided by its sum. The paper leaves out that division; without it the
    values follow the distance to the nearest neighbour, an accident of the meshing, rather than the shape.

    Returns
    -------
    (n, 33) float32 array
        In [0, 1]; dimensions 0-10 alpha, 11-21 phi, 22-32 theta, each group adding up to 1. Zero where a
        vertex has no neighbours.
    """
    if surface.neighbours.shape[1] == 0:
        return np.zeros((len(surface.vertices), 33), np.float32)
    spfh = count_spfh(surface.vertices, surface.normals, surface.neighbours)
    values = average_spfh(spfh, surface.neighbours, surface.neighbour_distances, NEAREST)
    groups = values.reshape(-1, 3, 11)
    return (groups / groups.sum(axis=2, keepdims=True)).reshape(-1, 33)


FAST_POINT_FEATURE_HISTOGRAM = Descriptor(
    name="FPFH",
    title="Fast point feature histogram",
    measures="How the surface curves around a point, from how its direction differs from that of its neighbours.",
    dimensions=33,
    edges=tuple(float(x) for x in np.linspace(0.0, 1.0, 11) ** 2),
    compute=compute,
)
