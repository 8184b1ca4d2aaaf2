"""The contract of a projection, and what all of them share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from shapeviz_report.types import FloatArray, Projection


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
        The fewest rows it can lay out; below it :func:`project` lays out by principal components.
    embed : callable
        ``(values (n, w), seed) -> (n, 2)``.
    """

    name: str
    title: str
    explanation: str
    smallest: int
    embed: Callable[[FloatArray, int], FloatArray]


def principal_components(values: FloatArray) -> FloatArray:
    """Coordinates (n, 2) of the rows of ``values`` (n, w) along their first two principal axes.

    Each axis points the way in which the farthest row lies. Axes that the data does not have are zero.
    """
    centred = values - values.mean(axis=0)
    left, singular, _ = np.linalg.svd(centred, full_matrices=False)
    scores = np.zeros((len(values), 2))
    found = min(2, len(singular))
    scores[:, :found] = left[:, :found] * singular[:found]
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
        Scaled features, one row a shape; at least one row.
    features : names of the features in ``values``
        Recorded in the result.
    seed : int

    Returns
    -------
    Projection
    """
    count = len(values)
    order = np.lexsort(values.T[::-1])
    with threadpool_limits(limits=1):
        if count < 2 or np.ptp(values, axis=0).max(initial=0.0) == 0:
            placed = np.zeros((count, 2))
        elif count < method.smallest:
            placed = principal_components(values[order])
        else:
            # Turned so that a map is wider than high, as windows are.
            placed = principal_components(np.asarray(method.embed(values[order], seed), dtype=np.float64))
    xy = np.empty((count, 2))
    xy[order] = placed
    return Projection(method.name, tuple(features), seed, fit_square(xy))


def fit_square(xy: FloatArray) -> FloatArray:
    """Centre points (n, 2) and scale them by one factor into [-1, 1]^2."""
    low, high = xy.min(axis=0), xy.max(axis=0)
    extent = float((high - low).max())
    return (xy - (low + high) / 2) * (2 / extent if extent > 0 else 1.0)


def align(projection: Projection, reference: Projection) -> Projection:
    """Turn and mirror a map so that shapes come to lie as close as possible to where ``reference`` has them.

    Distances within the map keep their ratios. Orthogonal Procrustes: a reader who switches between maps
    keeps their bearings.
    """
    left, _, right = np.linalg.svd(projection.xy.T @ reference.xy)
    turned = fit_square(projection.xy @ (left @ right))
    return Projection(projection.method, projection.features, projection.seed, turned)
