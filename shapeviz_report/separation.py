"""How far classes are groups at all: by the features, whatever a map makes of them, and on every map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import numpy.typing as npt
from threadpoolctl import threadpool_limits

from shapeviz_report.order import classes_of
from shapeviz_report.projections import canonical_order, squared_distances
from shapeviz_report.quality import share_places
from shapeviz_report.search.space import stratified_sample
from shapeviz_report.types import ClassRates, FloatArray, Separation

MOST_SHAPES = 2000
"""Shapes that take part; of more, a sample in which every class has its share. Time grows with its square."""

DEALS = 100
"""Labelings at random behind the level of chance."""


def rate_separation(
    points: FloatArray, maps: Mapping[str, FloatArray], labels: Sequence[str | None], k: int, *, seed: int = 0
) -> Separation | None:
    r"""Whether shapes of a class are nearest to each other, and form a group.

    Every labelled shape is classified by the labelled others, as a nearest-neighbour classifier does with one shape
    left out: the shape has no part in its own answer, so that the figure is one of shapes held out. Neighbours that tie
    for the last places share them, and classes that tie share the success.

    The silhouette (Rousseeuw 1987) of a shape is :math:`(b - a) / \max(a, b)`, where a is its mean distance from the
    others of its class, and b the smallest mean distance from another class: 1 in a tight group far from all others, 0
    on the border of two, negative where another class is nearer.

    Shapes without a label have no part. Classes of one shape are others to be taken for, but are not rated.

    Parameters
    ----------
    points : (n, d) float array
        What the maps compare.
    maps : mapping of str to (n, 2) float array
        By name.
    labels : n labels
        None for a shape without one.
    k : int
        Number of neighbours that elect a class; less where there are fewer other shapes.
    seed : int
        Of the sample, and of labels at random.

    Returns
    -------
    Separation or None
        None with fewer than two classes, or none of two shapes.
    """
    order = canonical_order(points)
    order = order[[labels[row] is not None for row in order]]
    if len(order) > MOST_SHAPES:
        order = order[stratified_sample([labels[row] for row in order], MOST_SHAPES, seed)]
    names = classes_of([labels[row] for row in order])
    number = {name: place for place, name in enumerate(names)}
    codes = np.array([number[label] for row in order if (label := labels[row]) is not None], dtype=np.intp)
    # Shapes with the same values stand in an order that their classes decide, not their files.
    order = order[np.argsort(codes, kind="stable")]
    codes = np.sort(codes)
    sizes = np.bincount(codes, minlength=len(names))
    rated = np.flatnonzero(sizes > 1)
    if len(names) < 2 or not len(rated):
        return None
    k = min(k, len(codes) - 1)

    def of_classes(values: FloatArray) -> FloatArray:
        return (np.bincount(codes, values) / sizes)[rated]

    def rates(squared: FloatArray) -> ClassRates:
        one, several = (_votes(squared, count) for count in (1, k))
        return ClassRates(
            of_classes(_success(one, codes)),
            of_classes(_success(several, codes)),
            of_classes(silhouettes(np.sqrt(squared), codes)),
        )

    with threadpool_limits(limits=1):
        squared = squared_distances(points[order])
        found = rates(squared)
        on_maps = {name: rates(squared_distances(xy[order])) for name, xy in maps.items()}
        dealt = _deal(np.sqrt(squared), _votes(squared, k), codes, seed)
    nearest = _votes(squared, 1)
    to_class = [nearest[:, codes == place].sum(axis=1) for place in rated]
    taken = np.stack([np.bincount(codes, votes)[rated] for votes in to_class], axis=1)
    np.fill_diagonal(taken, 0)
    elected, silhouette = (np.array([of_classes(values) for values in kind]) for kind in dealt)
    overall = silhouette @ sizes[rated] / sizes[rated].sum()
    return Separation(
        k=k,
        shapes=len(codes),
        shape_count=len(labels),
        classes=tuple(names[place] for place in rated),
        sizes=sizes[rated].astype(np.int32),
        features=found,
        maps=on_maps,
        chance=ClassRates(
            (sizes[rated] - 1) / (len(codes) - 1), elected.mean(axis=0), silhouette.mean(axis=0)
        ),
        chance_spread=float(overall.std()),
        likely=np.quantile(silhouette, 0.95, axis=0),
        mistaken=np.where(taken.any(axis=1), taken.argmax(axis=1), -1).astype(np.int32),
    )


def silhouettes(distances: FloatArray, codes: npt.NDArray[np.intp]) -> FloatArray:
    """The silhouette of every shape; 0 of one alone in its class.

    Parameters
    ----------
    distances : (n, n) float array
    codes : (n,) int array
        The class of each shape, from 0; at least two classes, none of them empty.

    Returns
    -------
    (n,) float64 array
    """
    sizes = np.bincount(codes)
    rows = np.arange(len(codes))
    sums = distances @ np.eye(len(sizes))[codes]
    own = sums[rows, codes] / np.maximum(sizes[codes] - 1, 1)
    means = sums / sizes
    means[rows, codes] = np.inf
    other = means.min(axis=1)
    most = np.maximum(own, other)
    alone = (sizes[codes] == 1) | (most == 0)
    return np.where(alone, 0.0, (other - own) / np.where(alone, 1.0, most))


def _votes(squared: FloatArray, k: int) -> FloatArray:
    """(n, n) how much of its vote each shape gives to each other."""
    others = squared.copy()
    np.fill_diagonal(others, np.inf)
    return share_places(others, k)


def _success(votes: FloatArray, codes: npt.NDArray[np.intp]) -> FloatArray:
    """(n,) 1 where most votes go to a shape's own class; of classes that tie, a share."""
    counts = votes @ np.eye(codes.max() + 1)[codes]
    elected = counts > counts.max(axis=1, keepdims=True) - 1e-9
    return elected[np.arange(len(codes)), codes] / elected.sum(axis=1)


def _deal(
    distances: FloatArray, votes: FloatArray, codes: npt.NDArray[np.intp], seed: int
) -> tuple[list[FloatArray], list[FloatArray]]:
    """Success and silhouette of every shape for labels dealt out anew, ``DEALS`` times.

    Shapes are put in the order of the classes that are dealt to them, so that each keeps the place of its class.
    """
    random = np.random.default_rng(seed)
    elected, silhouette = [], []
    for _ in range(DEALS):
        shapes = random.permutation(len(codes))
        own = np.ix_(shapes, shapes)
        elected.append(_success(votes[own], codes))
        silhouette.append(silhouettes(distances[own], codes))
    return elected, silhouette
