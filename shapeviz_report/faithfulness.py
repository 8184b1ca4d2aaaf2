"""How far maps show who is like whom: measures that need no labels, each beside its level of chance."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt
from threadpoolctl import threadpool_limits

from shapeviz_report.neighbours import find_nearest
from shapeviz_report.projections import canonical_order
from shapeviz_report.types import Faithfulness, FloatArray

RANKED = 1000
"""Most shapes whose neighbours are ranked, for trustworthiness and continuity."""


def rate_maps(points: FloatArray, maps: Mapping[str, FloatArray], k: int) -> dict[str, Faithfulness]:
    r"""Compare neighbours on maps with those that the features have.

    Of the k nearest shapes by the features, :math:`N_k(m)`, a map has some among its own k nearest, :math:`N'_k(m)`.
    *Kept* is their share. Trustworthiness and continuity (Venna and Kaski 2001) weigh what is false or missing by how
    far away it is, by ranks :math:`r` in the features and :math:`r'` on the map:

    .. math:: T = 1 - \frac{2}{n k (2 n - 3 k - 1)} \sum_m \sum_{p \in N'_k(m) \setminus N_k(m)} (r(m, p) - k)

    and C with both exchanged. A map on which shapes lie at random keeps :math:`k / (n - 1)`, and has
    :math:`1 - (n - 1 - k) (n - k) / ((n - 1) (2 n - 3 k - 1))` of the other two.

    Parameters
    ----------
    points : (n, d) float array
        What the maps compare.
    maps : mapping of str to (n, 2) float array
        By name.
    k : int
        Number of neighbours; less where there are fewer other shapes.

    Returns
    -------
    dict of str to Faithfulness
        Empty for one shape.
    """
    count = len(points)
    k = min(k, count - 1)
    if k < 1:
        return {}
    # Sorted by their values, so that neither sums nor ties follow the order of files.
    order = canonical_order(points)
    back = np.argsort(order)
    sampled = np.arange(min(count, RANKED)) * count // min(count, RANKED)
    ranked = 2 * k < count
    with threadpool_limits(limits=1):
        sorted_points = points[order]
        near = find_nearest(sorted_points, k)
        ranks = _rank(sorted_points, sampled) if ranked else None
        found = {}
        for name, xy in maps.items():
            shown = find_nearest(xy[order], k)
            kept = (near[:, :, None] == shown[:, None, :]).any(axis=2).mean(axis=1)
            trust = continuity = chance = None
            if ranks is not None:
                own = _rank(xy[order], sampled)
                most = k * (2 * count - 3 * k - 1) / 2
                trust = 1 - float(_beyond(ranks, shown[sampled], k).mean()) / most
                continuity = 1 - float(_beyond(own, near[sampled], k).mean()) / most
                chance = 1 - (count - 1 - k) * (count - k) / ((count - 1) * (2 * count - 3 * k - 1))
            found[name] = Faithfulness(k, kept[back], k / (count - 1), trust, continuity, chance)
    return found


def _rank(points: FloatArray, rows: npt.NDArray[np.intp]) -> npt.NDArray[np.int32]:
    """(r, n) the place of every row among the others as seen from some: 1 is the nearest, 0 the row itself."""
    ranks = np.empty((len(rows), len(points)), np.int32)
    squares = np.einsum("ij,ij->i", points, points)
    for place, row in enumerate(rows):
        distances = squares - 2 * points @ points[row]
        distances[row] = -np.inf
        ranks[place, np.argsort(distances, kind="stable")] = np.arange(len(points), dtype=np.int32)
    return ranks


def _beyond(ranks: npt.NDArray[np.int32], neighbours: npt.NDArray[np.int32], k: int) -> npt.NDArray[np.int64]:
    """By how many places neighbours lie beyond the k-th, added up for each row."""
    places = np.take_along_axis(ranks, neighbours.astype(np.intp), axis=1)
    return np.maximum(places.astype(np.int64) - k, 0).sum(axis=1)
