"""Neighbourhood hit: how well a map keeps shapes of one class together (paper, Eq. 7 and 8)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.sparse import csr_matrix
from scipy.spatial import KDTree

from shapeviz_report.order import classes_of, natural
from shapeviz_report.types import FloatArray, HitRange, Quality

NEIGHBOURS = 10
"""k of the paper (3.5)."""

PERMUTATIONS = 1000
"""Number of random labelings behind the null's mean and standard deviation."""

TIE = 1e-9
"""Distances that differ by less than this fraction are equal."""

MOST_PAIRED = 4000
"""Points of a map whose distances are all computed; of more, those to some candidates."""

SPARE = 16
"""Candidates beside the nearest: those that tie for the last places are among them nearly always."""


def score(xy: FloatArray, labels: Sequence[str | None], *, k: int = NEIGHBOURS, seed: int = 0) -> Quality:
    r"""Neighbourhood hit of every shape, class and the whole map, and what random labels would reach.

    .. math:: NH(m) = \frac{1}{k} |\{ p \in N_k(m) : c(p) = c(m) \}|

    Where several points are equally far at the k-th place, each counts with the same fraction, so that the
    value does not depend on the order of the shapes. A neighbour without a label is a miss. NH of a shape
    without a label is undefined, and such shapes have no part in the averages.

    The null keeps the map and deals the labels out anew, ``PERMUTATIONS`` times.

    Parameters
    ----------
    xy : (n, d) float array
        Points; of a map d = 2.
    labels : n labels
        None for a shape without one.
    k : int
        Number of neighbours; less where there are fewer other shapes.
    seed : int
        Of the permutations.

    Returns
    -------
    Quality
    """
    count = len(labels)
    k = min(k, count - 1)
    classes = classes_of(labels)
    number = {label: i for i, label in enumerate(classes)}
    codes = np.array([-1 if label is None else number[label] for label in labels])
    labelled = codes >= 0
    nh = np.full(count, np.nan)
    if k < 1 or not classes:
        return Quality(max(k, 0), nh, {}, None, None, None, hit_range(labels, k))

    weights = neighbour_weights(xy, k)
    hits = neighbourhood_hits(weights, codes)
    nh[labelled] = hits[labelled]
    nh_c = {label: float(nh[codes == i].mean()) for i, label in enumerate(classes)}
    # A canonical order of the points makes the same permutations meet the same shapes in any input order.
    order = np.lexsort((*xy.T, codes))
    order = order[labelled[order]]
    random = np.random.default_rng(seed)
    null = np.empty(PERMUTATIONS)
    shuffled = codes.copy()
    for i in range(PERMUTATIONS):
        shuffled[order] = random.permutation(codes[order])
        null[i] = neighbourhood_hits(weights, shuffled)[labelled].mean()
    return Quality(
        k=k,
        nh=nh,
        nh_c=dict(sorted(nh_c.items(), key=lambda item: (-item[1], natural(item[0])))),
        nh_s=float(nh[labelled].mean()),
        null_mean=float(null.mean()),
        null_std=float(null.std()),
        range=hit_range(labels, k),
    )


def hit_range(labels: Sequence[str | None], k: int = NEIGHBOURS) -> HitRange:
    """Between what chance gives and what no map exceeds NH of these shapes lies.

    Parameters
    ----------
    labels : m labels
        Of the shapes of a map; None for a shape without one.
    k : int
        Number of neighbours; less where there are fewer other shapes.
    """
    named = Counter(label for label in labels if label is not None)
    others = len(labels) - 1
    if not named or min(k, others) < 1:
        return HitRange({}, {}, None, None)
    sizes = {label: named[label] for label in classes_of(named)}
    codes = np.repeat(np.arange(len(sizes)), list(sizes.values()))
    highest = highest_hits(codes, min(k, others))
    return HitRange(
        highest_of_class={label: float(highest[codes == i][0]) for i, label in enumerate(sizes)},
        chance_of_class={label: (size - 1) / others for label, size in sizes.items()},
        highest=float(highest.mean()),
        chance=float(np.mean([(sizes[label] - 1) / others for label in named.elements()])),
    )


def highest_hits(codes: np.ndarray, k: int) -> FloatArray:
    """The highest NH that each shape can have: min(k, n - 1) / k in a class of n.

    Parameters
    ----------
    codes : (m,) int array
        The class of each shape; -1 without one, which gives 0.
    k : int
        From 1 to m - 1.

    Returns
    -------
    (m,) float64 array
    """
    sizes = np.bincount(codes[codes >= 0], minlength=1)
    return np.where(codes >= 0, np.minimum(sizes[codes] - 1, k) / k, 0.0)


def share_of_range(value: float | None, chance: float | None, highest: float | None) -> float | None:
    """How far a hit lies on the way from chance (0) to the maximum (1); negative below chance.

    None where the two are equal, which is so where every map reaches the same: there is but one class, or a class of
    one shape, or all other shapes are neighbours.
    """
    if value is None or chance is None or highest is None or highest - chance < 1e-9:
        return None
    return (value - chance) / (highest - chance)


def hits_among(points: FloatArray, codes: np.ndarray, kept: np.ndarray, k: int) -> FloatArray:
    """NH of some points, with neighbours among these alone.

    Parameters
    ----------
    points : (n, d) float array
    codes : (n,) int array
        The class of each point, -1 without one.
    kept : (m,) int array
        Which points count.
    k : int
        Number of neighbours; less where fewer points count.

    Returns
    -------
    (n,) float64 array
        NaN for the other points, for those without a class, and where no two points count.
    """
    hits = np.full(len(points), np.nan)
    k = min(k, len(kept) - 1)
    if k >= 1:
        found = neighbourhood_hits(neighbour_weights(points[kept], k), codes[kept])
        hits[kept] = np.where(codes[kept] >= 0, found, np.nan)
    return hits


def share_places(squared: FloatArray, k: int | npt.NDArray[np.integer]) -> FloatArray:
    """Who has the k places next to each point: 1 if nearer than the k-th, an equal share if as near, otherwise 0.

    Parameters
    ----------
    squared : (m, n) float array
        Squared distances, infinite from a point to itself.
    k : int or (m,) int array
        From 1 to n - 1; one for all points or one for each.

    Returns
    -------
    (m, n) float64 array
        Rows add up to k.
    """
    places = np.broadcast_to(k, len(squared))[:, None]
    last = kth_smallest(squared, k)
    nearer = squared < last * (1 - TIE)
    tied = (squared <= last * (1 + TIE)) & ~nearer
    return nearer + tied * ((places - nearer.sum(axis=1, keepdims=True)) / tied.sum(axis=1, keepdims=True))


def kth_smallest(values: FloatArray, k: int | npt.NDArray[np.integer]) -> FloatArray:
    """The k-th smallest value of every row, k being one for all rows or one for each; (m, 1)."""
    places = np.broadcast_to(k, len(values))[:, None] - 1
    return np.take_along_axis(np.partition(values, np.unique(places), axis=1), places, axis=1)


def neighbour_weights(points: FloatArray, k: int | npt.NDArray[np.integer]) -> csr_matrix:
    """The k nearest neighbours of every point, as weights that add up to 1 in every row.

    Parameters
    ----------
    points : (n, d) float array
    k : int or (n,) int array
        From 1 to n - 1; one for all points or one for each.

    Returns
    -------
    (n, n) sparse matrix
        1 / k for a neighbour; those that tie for the last places share them equally. Zero on the diagonal.
    """
    count = len(points)
    wanted = np.broadcast_to(k, count)
    rows, columns, values = [], [], []
    left = np.arange(count)
    if points.shape[1] == 2 and count > MOST_PAIRED:
        near = KDTree(points).query(points, min(int(wanted.max()) + SPARE, count))[1]
        squared = _squared(points, points[near])
        squared[near == left[:, None]] = np.inf
        # Whose last candidate ties with the k-th may have others that tie.
        whole = squared.max(axis=1, where=np.isfinite(squared), initial=0) > kth_smallest(squared, wanted)[
            :, 0
        ] * (1 + TIE)
        left = np.flatnonzero(~whole)
        place, row, column = _weigh(squared[whole], wanted[whole])
        rows.append(np.flatnonzero(whole)[row])
        columns.append(near[whole][row, column])
        values.append(place)
    chunk = max(1, 4_000_000 // count)
    for start in range(0, len(left), chunk):
        block = left[start : start + chunk]
        squared = _squared(points[block], points[None])
        squared[np.arange(len(block)), block] = np.inf
        place, row, column = _weigh(squared, wanted[block])
        rows.append(block[row])
        columns.append(column)
        values.append(place)
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return csr_matrix(entries, shape=(count, count))


def _squared(points: FloatArray, others: FloatArray) -> FloatArray:
    """Squared distances of (m, d) points to (m or 1, n, d) others; (m, n)."""
    squared = np.zeros(np.broadcast_shapes((len(points), 1), others.shape[:2]))
    for dimension in range(points.shape[1]):
        squared += (points[:, dimension, None] - others[..., dimension]) ** 2
    return squared


def _weigh(
    squared: FloatArray, wanted: npt.NDArray[np.integer]
) -> tuple[FloatArray, npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """The weights that are not zero, with their rows and columns."""
    places = share_places(squared, wanted)
    row, column = np.nonzero(places)
    return places[row, column] / wanted[row], row, column


def neighbourhood_hits(weights: csr_matrix, codes: np.ndarray) -> FloatArray:
    """The NH of every shape on one map or several: the weight of the neighbours with its own class.

    Parameters
    ----------
    weights : (S n, n) sparse matrix
        As :func:`neighbour_weights` gives them, those of several maps one below the other.
    codes : (n,) int array
        The class of each shape.

    Returns
    -------
    (S n,) float64 array
    """
    own = np.repeat(np.resize(codes, weights.shape[0]), np.diff(weights.indptr))
    same = weights.data * (own == codes[weights.indices])
    return np.add.reduceat(same, weights.indptr[:-1])
