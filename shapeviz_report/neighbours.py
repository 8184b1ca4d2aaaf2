"""Which shapes are each other's nearest, and how well each fits its class.

``docs/using/compare.md`` says how the measure of fit was chosen.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.cluster.hierarchy import leaves_list, linkage
from scipy.spatial import KDTree
from scipy.spatial.distance import pdist
from threadpoolctl import threadpool_limits

from shapeviz_report.diffusion import diffuse
from shapeviz_report.projections import canonical_order, squared_distances
from shapeviz_report.projections.kernels.nearest import EXACT_LIMIT, nearest_rows
from shapeviz_report.types import FloatArray, IntArray

KIN = 5
"""Nearest shapes of a class that say how far one is from it. Three to five find swapped labels best."""

RELATED = 48
"""Most similar shapes by neighbourhood that are kept of each."""

FITTED = 4000
"""Shapes that stand for their classes where there are very many, at least ten a class."""

_BLOCK = 8_000_000
"""Distances at a time."""


@dataclass(frozen=True)
class Fits:
    """How well every shape fits its class.

    Attributes
    ----------
    fit : (n,) float64 array
        In [-1, 1]: ``(b - a) / max(a, b)``, where a is the mean distance to the ``KIN`` nearest other shapes of its own
        class, and b that to the ``KIN`` nearest of the other class that is nearest in this sense. Below 0 another class
        is nearer than its own. A silhouette (Rousseeuw 1987) of the nearest instead of all, because classes are seldom
        round. NaN for a shape without a label, alone in its class, or without another class.
    rival : (n,) int32 array
        That other class; -1 where there is none.
    """

    fit: FloatArray
    rival: IntArray


def find_nearest(points: FloatArray, k: int) -> IntArray:
    """The k nearest other rows of every row, nearest first.

    Parameters
    ----------
    points : (n, d) float array
        Of a map (d = 2) or of all features.
    k : int
        From 0 to n - 1.

    Returns
    -------
    (n, k) int32 array
        By features of more than :data:`~shapeviz_report.projections.kernels.nearest.EXACT_LIMIT` rows nearly all of
        the nearest, and all of them near.
    """
    count, dimensions = points.shape
    nearest = np.empty((count, k), np.int32)
    if k == 0:
        return nearest
    if dimensions > 2 and count > EXACT_LIMIT:
        return nearest_rows(points, k, 0)[0]
    if dimensions == 2:
        # One more, because a row finds itself; among equal points not always first.
        _, found = KDTree(points).query(points, k + 1)
        own = found == np.arange(count)[:, None]
        own[~own.any(axis=1), k] = True
        return found[~own].reshape(count, k).astype(np.int32)
    for rows, squared in squared_blocks(points):
        candidates = np.argpartition(squared, k - 1, axis=1)[:, :k]
        candidates.sort(axis=1)
        order = np.argsort(np.take_along_axis(squared, candidates, axis=1), axis=1, kind="stable")
        nearest[rows] = np.take_along_axis(candidates, order, axis=1)
    return nearest


def find_related(points: FloatArray, count: int) -> IntArray:
    """The rows most similar to each by distances that know their neighbourhood, the most similar first.

    Parameters
    ----------
    points : (n, d) float array
        At most :data:`~shapeviz_report.projections.base.PAIRWISE_LIMIT` rows.
    count : int
        Most rows to find for each.

    Returns
    -------
    (n, min(count, n - 1)) int32 array
        Of rows that are equally near by :func:`~shapeviz_report.diffusion.diffuse`, those first that are nearer by
        plain distances.
    """
    order = canonical_order(points)
    with threadpool_limits(limits=1):
        squared = squared_distances(points[order])
        diffused = diffuse(squared)
    for distances in (squared, diffused):
        np.fill_diagonal(distances, np.inf)
    # Rounding makes no order.
    nearest = np.lexsort((squared, np.round(diffused, 9)))[:, : min(count, len(points) - 1)]
    found = np.empty(nearest.shape, np.int32)
    found[order] = order[nearest]
    return found


def most_standing(count: int, classes: int) -> int | None:
    """How many shapes of a class stand for it at most where their fit is found; None where all do."""
    return max(FITTED // classes, 2 * KIN) if count > EXACT_LIMIT else None


def find_fits(points: FloatArray, codes: npt.NDArray[np.integer]) -> Fits:
    """How well every shape fits its class, by the distances of points.

    Of more than :data:`~shapeviz_report.projections.kernels.nearest.EXACT_LIMIT` points some of every class stand for
    it, ``FITTED`` in all.

    Parameters
    ----------
    points : (n, d) float array
    codes : (n,) int array
        The class of each, from 0; -1 without a label.
    """
    count, classes = len(points), int(codes.max(initial=-1)) + 1
    fit, rival = np.full(count, np.nan), np.full(count, -1, np.int32)
    if classes < 2:
        return Fits(fit, rival)
    members = [np.flatnonzero(codes == code) for code in range(classes)]
    standing = None
    most = most_standing(count, classes)
    if most is not None:
        standing = np.concatenate([evenly(own, points, most) for own in members])
        members = [np.flatnonzero(codes[standing] == code) for code in range(classes)]
    for rows, squared in squared_blocks(points, standing):
        means = np.full((len(squared), classes), np.inf)
        for code, own in enumerate(members):
            distances = np.sort(_smallest(squared[:, own], KIN), axis=1)
            # A row's distance to itself is infinite, so that the last place of a small class may hold no shape.
            found = np.isfinite(distances)
            with np.errstate(invalid="ignore"):
                means[:, code] = np.where(found, np.sqrt(distances), 0).sum(axis=1) / found.sum(axis=1)
        chosen = codes[rows]
        here = np.arange(len(squared))
        own = means[here, chosen]
        means[here, chosen] = np.inf
        nearest = means.argmin(axis=1)
        other = means[here, nearest]
        known = (chosen >= 0) & np.isfinite(own)
        larger = np.maximum(own, other)
        with np.errstate(invalid="ignore"):
            fit[rows] = np.where(known, np.where(larger > 0, (other - own) / larger, 0.0), np.nan)
        rival[rows] = np.where(known, nearest, -1)
    return Fits(fit, rival)


def order_classes(points: FloatArray, codes: npt.NDArray[np.integer]) -> list[int]:
    """The classes in an order that puts those beside each other whose means are near.

    Average linkage of the means; of the orders that its tree allows, the one with the shortest way from class to class
    (Bar-Joseph et al. 2001).

    Parameters
    ----------
    points, codes
        As for :func:`find_fits`; every class has a shape.
    """
    classes = int(codes.max(initial=-1)) + 1
    if classes < 3:
        return list(range(classes))
    means = np.stack([points[codes == code].mean(axis=0) for code in range(classes)])
    return leaves_list(linkage(pdist(means), "average", optimal_ordering=True)).tolist()


def _smallest(squared: FloatArray, count: int) -> FloatArray:
    if squared.shape[1] <= count:
        return squared
    return np.partition(squared, count - 1, axis=1)[:, :count]


def evenly(rows: npt.NDArray[np.integer], points: FloatArray, most: int) -> npt.NDArray[np.integer]:
    """At most so many of some rows of ``points``, by what they hold and not by where they stand; rising."""
    order = rows[canonical_order(points[rows])]
    count = min(most, len(rows))
    return np.sort(order[np.arange(count) * len(rows) // count])


def squared_blocks(points: FloatArray, others: IntArray | None = None) -> Iterator[tuple[slice, FloatArray]]:
    """Squared distances of a slice of rows to all rows, or to some ``others``, at a time, infinite to themselves."""
    centred = points - points.mean(axis=0)
    norms = np.einsum("ij,ij->i", centred, centred)
    there, their_norms = (centred, norms) if others is None else (centred[others], norms[others])
    columns = np.arange(len(points)) if others is None else others
    step = max(1, _BLOCK // len(columns))
    for start in range(0, len(points), step):
        rows = slice(start, min(start + step, len(points)))
        squared = norms[rows, None] + their_norms - 2 * centred[rows] @ there.T
        np.maximum(squared, 0, out=squared)
        own = np.flatnonzero((columns >= rows.start) & (columns < rows.stop))
        squared[columns[own] - rows.start, own] = np.inf
        yield rows, squared
