"""Average geodesic distance (Agd), paper Eq. 2."""

from __future__ import annotations

import numpy as np

from shapeviz_report.descriptors.base import Descriptor
from shapeviz_report.descriptors.kernels.geodesics import walk_from_sources
from shapeviz_report.descriptors.surface import Surface
from shapeviz_report.types import FloatArray

SOURCES = 100
"""Number of farthest-point sources; as many as vertices, where there are fewer."""


def compute(surface: Surface) -> FloatArray:
    r"""Mean length of the shortest paths along edges from every vertex to all others.

    .. math:: Agd(x) = \frac{1}{|V|} \sum_{y \in V} d(x, y) \approx \sum_s \frac{|V_s|}{|V|} d(x, s)

    The sum over all vertices is estimated from 100 sources s, each farthest from those before it and
    weighted by its Voronoi cell :math:`V_s`, the vertices nearest to it; the first is the vertex farthest
    from the barycentre. With at most 100 vertices the result is exact.

    Parts that no path joins are bridged by straight edges (:attr:`Surface.graph`), so every distance is finite.

    Returns
    -------
    (n, 1) float64 array
        In units of the normalised shape (radius 1), not negative: small at the middle of a shape, large at
        the ends of its limbs.
    """
    graph = surface.graph
    first = int(np.linalg.norm(surface.vertices - surface.barycentre, axis=1).argmax())
    count = min(SOURCES, len(surface.vertices))
    mean, _ = walk_from_sources(graph.indptr, graph.indices, graph.data, first, count)
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
