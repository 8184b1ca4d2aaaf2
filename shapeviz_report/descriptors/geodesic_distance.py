"""Average geodesic distance (Agd), paper Eq. 2."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.kernels.geodesics import shorten
from shapeviz_report.descriptors.surface import Surface
from shapeviz_report.types import FloatArray


def compute(surface: Surface) -> FloatArray:
    r"""Mean length of the shortest paths along edges from every vertex to all others.

    .. math:: Agd(x) = \frac{1}{|V|} \sum_{y \in V} d(x, y) \approx \sum_c \frac{|V_c|}{|V|} d(x, c)

    The sum over all vertices is estimated from the centres c of 64 even cells (:attr:`Surface.cells`), each
    weighted by the number of vertices nearest to it. With at most 64 vertices the result is exact.

    Parts that no path joins are bridged by straight edges (:attr:`Surface.graph`), so every distance is finite.

    Returns
    -------
    (n, 1) float64 array
        In units of the normalised shape (radius 1), not negative: small at the middle of a shape, large at
        the ends of its limbs.
    """
    graph, cells = surface.graph, surface.cells
    count = len(surface.vertices)
    mean = np.zeros(count)
    distances, waiting = np.empty(count), np.zeros(count, np.bool_)
    owners, queue = np.zeros(count, np.int32), np.empty(count, np.int32)
    for centre, size in zip(cells.centres, np.bincount(cells.owners)):
        distances[:] = np.inf
        distances[centre] = 0.0
        queue[0] = centre
        shorten(graph.indptr, graph.indices, graph.data, distances, owners, queue, 1, waiting)
        mean += size / count * distances
    return mean[:, None]


GEODESIC_DISTANCE = Descriptor(
    name="Agd",
    title="Average geodesic distance",
    measures="How far a point is, walking on the surface, from all the others: small at the middle, large at the "
    "ends of limbs.",
    dimensions=1,
    edges=tuple(float(x) for x in np.linspace(0.4, 2.4, 11)),
    compute=compute,
)
