"""The contract of a projection, and what all of them share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import scipy.linalg
from scipy.spatial.distance import pdist, squareform
from threadpoolctl import threadpool_limits

from shapeviz_report.types import FloatArray, Projection

PAIRWISE_LIMIT = 4000
"""Up to this many rows a method works on all pairwise distances. Beyond, exact t-SNE no longer pays
(docs/method/search.md has the measurements)."""


@dataclass(frozen=True)
class Method:
    """A way of laying out shapes in the plane.

    Attributes
    ----------
    name : str
        As in options and files.
    title : str
        As people write it.
    explanation : str
        What near and far mean on such a map, in a sentence for its reader.
    smallest : int
        The fewest rows it can lay out; fewer are laid out by principal components.
    arrange : callable
        ``(squared distances (n, n), seed) -> (n, 2)``, for up to ``PAIRWISE_LIMIT`` rows.
    embed : callable or None
        ``(values (n, w), seed) -> (n, 2)``, for more; None where more cannot be laid out.
    rounds : int
        Seeds by which a search of the features repeats its maps (paper, Table 2); 0 where none is offered.
    """

    name: str
    title: str
    explanation: str
    smallest: int
    arrange: Callable[[FloatArray, int], FloatArray]
    embed: Callable[[FloatArray, int], FloatArray] | None
    rounds: int = 0

    def takes(self, count: int) -> bool:
        """Whether it can lay out so many rows."""
        return self.embed is not None or count <= PAIRWISE_LIMIT


def principal_components(values: FloatArray) -> FloatArray:
    """Coordinates (n, 2) of the rows of ``values`` (n, w) along their first two principal axes.

    Each axis points the way in which the farthest row lies. Axes that the data does not have are zero. Where there are
    more rows than columns, they come from the covariance of the columns.
    """
    centred = values - values.mean(axis=0)
    count, width = values.shape
    scores = np.zeros((count, 2))
    found = min(2, count, width)
    if count > width:
        _, axes = scipy.linalg.eigh(centred.T @ centred, subset_by_index=[width - found, width - 1])
        scores[:, :found] = centred @ axes[:, ::-1]
    else:
        left, singular, _ = np.linalg.svd(centred, full_matrices=False)
        scores[:, :found] = left[:, :found] * singular[:found]
    return _point(scores)


def classical_scaling(squared: FloatArray) -> FloatArray:
    """The coordinates (n, 2) that :func:`principal_components` finds, from squared distances (n, n) alone.

    Torgerson's scaling: the doubly centred matrix holds the scalar products of the centred rows. At least two
    rows.
    """
    # scipy's solver for a few eigenvectors, not an iterative one: that starts anew from random vectors where
    # the rank is small, and the smallest difference makes another map.
    products = -0.5 * (squared - squared.mean(axis=0) - squared.mean(axis=1)[:, None] + squared.mean())
    count = len(squared)
    values, vectors = scipy.linalg.eigh(products, subset_by_index=[count - 2, count - 1])
    return _point((vectors * np.sqrt(np.maximum(values, 0.0)))[:, ::-1])


def squared_distances(values: FloatArray) -> FloatArray:
    """Squared Euclidean distances between the rows of ``values`` (n, w); (n, n), symmetric, exactly 0 for equal
    rows. Those of several features add up."""
    return squareform(pdist(values, "sqeuclidean"))


def _point(scores: FloatArray) -> FloatArray:
    """Turn each axis the way in which its farthest row lies."""
    farthest = np.abs(scores).argmax(axis=0)
    return scores * np.where(scores[farthest, [0, 1]] < 0, -1.0, 1.0)


def project(method: Method, values: FloatArray, features: Sequence[str], seed: int) -> Projection:
    """Lay out the rows of a feature table.

    Rows are put in an order that their values alone decide before the method sees them, and one thread does
    the sums, so neither the order of the shapes nor the number of cores can change the map.

    Parameters
    ----------
    method : Method
    values : (n, w) float array
        Scaled features, one row a shape; at least one row, and as many as the method takes.
    features : names of the features in ``values``
        Recorded in the result.
    seed : int

    Returns
    -------
    Projection
    """
    order = canonical_order(values)
    with threadpool_limits(limits=1):
        if method.embed is None or len(values) <= PAIRWISE_LIMIT:
            placed = arrange(method, squared_distances(values[order]), seed)
        else:
            placed = _upright(method.embed(values[order], seed))
    xy = np.empty((len(values), 2))
    xy[order] = placed
    return Projection(method.name, tuple(features), seed, xy)


def canonical_order(values: FloatArray) -> npt.NDArray[np.intp]:
    """Indices that sort the rows of ``values`` (n, w), first column first."""
    for width in (8, 64):
        # Rarely do more columns decide, and to sort by thousands takes long.
        order = np.lexsort(values[:, :width].T[::-1])
        ordered = values[order, :width]
        if (ordered[1:] != ordered[:-1]).any(axis=1).all():
            return order
    return np.lexsort(values.T[::-1])


def arrange(method: Method, squared: FloatArray, seed: int) -> FloatArray:
    """Lay out rows that are known by their squared distances; the map as in :class:`Projection`.

    The order of the rows decides the map's last digits, and the number of threads may: see :func:`project`.

    Parameters
    ----------
    method : Method
    squared : (n, n) float array
        Symmetric; at least one row.
    seed : int

    Returns
    -------
    (n, 2) float64 array
    """
    count = len(squared)
    if count < 2 or squared.max() == 0:
        return np.zeros((count, 2))
    if count < method.smallest:
        return fit_square(classical_scaling(squared))
    return _upright(method.arrange(squared, seed))


def _upright(xy: FloatArray) -> FloatArray:
    """Turn a map so that it is wider than high, as windows are, and fit it."""
    return fit_square(principal_components(np.asarray(xy, dtype=np.float64)))


def fit_square(xy: FloatArray) -> FloatArray:
    """Centre points (n, 2) and scale them by one factor into [-1, 1]^2."""
    low, high = xy.min(axis=0), xy.max(axis=0)
    extent = float((high - low).max())
    return (xy - (low + high) / 2) * (2 / extent if extent > 0 else 1.0)


def bring_along(name: str, xy: FloatArray) -> Projection:
    """A map that is no projection of features: places (n, 2) from elsewhere, moved and scaled, but neither turned nor
    mirrored."""
    return Projection(name, (), 0, fit_square(xy), brought=True)


def align(projection: Projection, reference: Projection) -> Projection:
    """Turn and mirror a map so that shapes come to lie as close as possible to where ``reference`` has them.

    Distances within the map keep their ratios. Orthogonal Procrustes: a reader who switches between maps
    keeps their bearings.
    """
    turned = turn_towards(projection.xy, reference.xy)
    return replace(projection, xy=turned)


def turn_towards(xy: FloatArray, reference: FloatArray) -> FloatArray:
    """As :func:`align`, for the points (n, 2) alone."""
    left, _, right = np.linalg.svd(xy.T @ reference)
    return fit_square(xy @ (left @ right))
