"""How far maps show who is like whom: measures that need no labels, each beside its level of chance."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import isotonic_regression
from scipy.spatial.distance import pdist
from threadpoolctl import threadpool_limits

from shapeviz_report.compilation import kernel
from shapeviz_report.neighbours import find_nearest, squared_blocks
from shapeviz_report.projections import canonical_order
from shapeviz_report.projections.kernels.nearest import EXACT_LIMIT
from shapeviz_report.quality import TIE
from shapeviz_report.types import Faithfulness, FloatArray, IntArray, Shepard

DRAWN = 1000
"""Most shapes whose pairs a Shepard diagram shows."""

RANKED = 2000
"""Shapes that are asked where others rank, of more than are asked for all their distances."""

CELLS = 48
"""Cells of a Shepard diagram in each direction."""


def rate_maps(points: FloatArray, maps: Mapping[str, FloatArray], k: int) -> dict[str, Faithfulness]:
    r"""Compare neighbours and distances on maps with those that the features have.

    Of the k nearest shapes by the features, :math:`N_k(m)`, a map has some among its own k nearest, :math:`N'_k(m)`.
    *Kept* is their share. Trustworthiness and continuity (Venna and Kaski 2001) weigh what is false or missing by how
    far away it is, by ranks :math:`r` in the features and :math:`r'` on the map:

    .. math:: T = 1 - \frac{1}{n} \sum_m f(m), \quad
        f(m) = \frac{2}{k (2 n - 3 k - 1)} \sum_{p \in N'_k(m) \setminus N_k(m)} (r(m, p) - k)

    and C with both exchanged; f, of each shape, are its *false* neighbours, and the same of C its *missing* ones.
    Shapes equally far at the k-th place share it, and have the mean of the ranks that they could have. A map on which
    shapes lie at random keeps :math:`k / (n - 1)`, and has
    :math:`1 - (n - 1 - k) (n - k) / ((n - 1) (2 n - 3 k - 1))` of T and C.

    The stress is the normalised one at the scale that is best for the map (Smelser et al. 2024), which no choice of
    units changes; of distances :math:`\delta` in the features and :math:`d` on the map, over all pairs,

    .. math:: S = \min_\alpha \sqrt{\frac{\sum (\delta - \alpha d)^2}{\sum \delta^2}}
        = \sqrt{1 - \frac{(\sum \delta d)^2}{\sum \delta^2 \sum d^2}}

    Shapes dealt out anew over the places of the map have the mean of :math:`\delta` times the sum of :math:`d` in place
    of :math:`\sum \delta d`.

    Of more than :data:`~shapeviz_report.projections.kernels.nearest.EXACT_LIMIT` shapes only ``RANKED`` are asked where
    all others rank, so that single shapes have no false and missing neighbours; those kept are of all.

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
    # Sorted by their values, so that sums do not follow the order of files.
    order = canonical_order(points)
    many = len(points) > EXACT_LIMIT
    if many:
        asked = np.zeros(len(order), bool)
        asked[np.arange(RANKED) * len(order) // RANKED] = True
        order = np.concatenate([order[asked], order[~asked]])
    back = np.argsort(order)
    with threadpool_limits(limits=1):
        sorted_points = points[order]
        laid = [np.ascontiguousarray(xy[order], dtype=np.float64) for xy in maps.values()]
        rated = _rate(squared_blocks(sorted_points), laid, k, RANKED if many else len(points))
        if many:
            near = find_nearest(sorted_points, k)
            rated = [_keep(found, near, find_nearest(xy, k)) for found, xy in zip(rated, laid, strict=True)]
        drawn = np.arange(min(len(points), DRAWN)) * len(points) // min(len(points), DRAWN)
        if many:
            drawn = drawn * RANKED // len(points)
        apart = pdist(sorted_points[drawn])
    return {
        name: Faithfulness(
            found.k,
            found.kept[back],
            found.chance,
            None if found.false is None else found.false[back],
            None if found.missing is None else found.missing[back],
            found.trustworthiness,
            found.continuity,
            found.random,
            found.stress,
            found.random_stress,
            _shepard(apart, pdist(xy[drawn])),
        )
        for name, found, xy in zip(maps, rated, laid, strict=False)
    }


def rate_distances(squared: FloatArray, xy: FloatArray, k: int) -> Faithfulness | None:
    """The same of one map, from squared distances; without a diagram.

    Parameters
    ----------
    squared : (n, n) float64 array
    xy : (n, 2) float64 array
    k : int
        Number of neighbours; less where there are fewer other shapes.

    Returns
    -------
    Faithfulness or None
        None for one shape.
    """
    return next(iter(_rate([(slice(0, len(xy)), squared)], [xy], k, len(xy))), None)


def _rate(
    blocks: Iterable[tuple[slice, FloatArray]], maps: Sequence[FloatArray], k: int, asked: int
) -> list[Faithfulness]:
    """The measures of every map, from squared distances of some rows to all at a time; none for one shape.

    Only the first rows, as many as are asked, tell what they rank.
    """
    count = len(maps[0]) if maps else 0
    k = min(k, count - 1)
    if k < 1:
        return []
    kept, false, missing = np.empty((3, len(maps), count))
    sums = np.empty((len(maps), count, 5))
    for rows, squared in blocks:
        if rows.start >= asked:
            break
        squared = squared[: asked - rows.start]
        for xy, *found in zip(maps, kept, false, missing, sums, strict=True):
            _rate_rows(rows.start, squared, xy, k, TIE, *found)
    ranked = 2 * k < count
    most = k * (2 * count - 3 * k - 1) / 2
    rated = []
    for place in range(len(maps)):
        stress, random_stress = _stress(sums[place, :asked].sum(axis=0), asked * (count - 1))
        rated.append(
            Faithfulness(
                k,
                kept[place],
                k / (count - 1),
                false[place] / most if ranked else None,
                missing[place] / most if ranked else None,
                1 - float(false[place, :asked].mean()) / most if ranked else None,
                1 - float(missing[place, :asked].mean()) / most if ranked else None,
                1 - (count - 1 - k) * (count - k) / ((count - 1) * (2 * count - 3 * k - 1))
                if ranked
                else None,
                stress,
                random_stress,
            )
        )
    return rated


def _keep(found: Faithfulness, near: IntArray, shown: IntArray) -> Faithfulness:
    """The same with the neighbours kept of all shapes, which are few of many, and no others of single shapes."""
    kept = np.array([np.isin(one, two).mean() for one, two in zip(near, shown, strict=True)])
    return replace(found, kept=kept, false=None, missing=None)


def _stress(sums: FloatArray, pairs: int) -> tuple[float | None, float | None]:
    """The stress of a map, and that of its shapes dealt out anew; None where all shapes are equal."""
    together, squares, shown, apart, far = sums.tolist()
    if squares == 0:
        return None, None
    if shown == 0:
        return 1.0, 1.0
    dealt = apart * far / pairs
    return (
        float(np.sqrt(max(1 - together**2 / (squares * shown), 0))),
        float(np.sqrt(max(1 - dealt**2 / (squares * shown), 0))),
    )


def _shepard(apart: FloatArray, shown: FloatArray) -> Shepard | None:
    """How often which distance on the map goes with which in the features; None where either are all zero."""
    scale = float(apart @ shown) / max(float(shown @ shown), np.finfo(float).tiny)
    width, height = float(apart.max(initial=0)), float(shown.max(initial=0)) * scale
    if width == 0 or height == 0:
        return None
    order = np.argsort(apart, kind="stable")
    rising = isotonic_regression(shown[order] * scale).x
    columns = np.minimum((apart / width * CELLS).astype(int), CELLS - 1)
    rows = np.minimum((shown * scale / height * CELLS).astype(int), CELLS - 1)
    pairs = np.bincount(columns * CELLS + rows, minlength=CELLS * CELLS).reshape(CELLS, CELLS)
    in_column = pairs.sum(axis=1)
    fit = np.bincount(columns[order], weights=rising, minlength=CELLS)
    with np.errstate(invalid="ignore"):
        return Shepard(pairs, fit / in_column / width, height / width)


@kernel(error_model="numpy")
def _beyond(squared: FloatArray, value: float, k: int, tie: float) -> float:
    """By how many places one at this distance lies beyond the k-th, on average over the places that it shares."""
    low, high = value * (1 - tie), value * (1 + tie)
    nearer, within = 0, 0
    for other in range(len(squared)):
        nearer += squared[other] < low
        within += squared[other] <= high
    if within <= k:
        return 0.0
    return (max(nearer, k) + 1 + within) / 2 - k


@kernel(error_model="numpy")
def _kth(squared: FloatArray, k: int, rising: FloatArray) -> float:
    """The k-th smallest."""
    rising[:] = np.inf
    for other in range(len(squared)):
        value = squared[other]
        if value < rising[k - 1]:
            place = k - 1
            while place > 0 and rising[place - 1] > value:
                rising[place] = rising[place - 1]
                place -= 1
            rising[place] = value
    return rising[k - 1]


@kernel(error_model="numpy")
def _rate_rows(
    first: int,
    squared: FloatArray,
    xy: FloatArray,
    k: int,
    tie: float,
    kept: FloatArray,
    false: FloatArray,
    missing: FloatArray,
    sums: FloatArray,
) -> None:
    """What a map makes of the neighbours of some rows, into their places of ``kept``, ``false``, ``missing`` (n,) and
    ``sums`` (n, 5): of products, of squares in the features and on the map, of distances in both."""
    count = len(xy)
    near, shown, rising = np.empty(count), np.empty(count), np.empty(k)
    for place in range(len(squared)):
        row = first + place
        together, squares, places, apart, far = 0.0, 0.0, 0.0, 0.0, 0.0
        for other in range(count):
            near[other] = squared[place, other]
            shown[other] = (xy[row, 0] - xy[other, 0]) ** 2 + (xy[row, 1] - xy[other, 1]) ** 2
            if other != row:
                one, two = np.sqrt(near[other]), np.sqrt(shown[other])
                together += one * two
                squares += near[other]
                places += shown[other]
                apart += one
                far += two
        sums[row] = np.array([together, squares, places, apart, far])
        near[row], shown[row] = np.inf, np.inf
        last, last_shown = _kth(near, k, rising), _kth(shown, k, rising)
        inner, tied, inner_shown, tied_shown = 0, 0, 0, 0
        for other in range(count):
            inner += near[other] < last * (1 - tie)
            tied += near[other] <= last * (1 + tie)
            inner_shown += shown[other] < last_shown * (1 - tie)
            tied_shown += shown[other] <= last_shown * (1 + tie)
        share = (k - inner) / (tied - inner)
        share_shown = (k - inner_shown) / (tied_shown - inner_shown)
        both, wrong, lost = 0.0, 0.0, 0.0
        for other in range(count):
            own, own_shown = 0.0, 0.0
            if near[other] <= last * (1 + tie):
                own = 1.0 if near[other] < last * (1 - tie) else share
            if shown[other] <= last_shown * (1 + tie):
                own_shown = 1.0 if shown[other] < last_shown * (1 - tie) else share_shown
            both += min(own, own_shown)
            if own_shown > own:
                wrong += (own_shown - own) * _beyond(near, near[other], k, tie)
            elif own > own_shown:
                lost += (own - own_shown) * _beyond(shown, shown[other], k, tie)
        kept[row] = both / k
        false[row], missing[row] = wrong, lost
