"""Weights that widen the margin between each row's nearest neighbours in either group."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from scipy.special import expit

from shapeviz_report.scorers.base import Scorer
from shapeviz_report.types import BoolArray, FloatArray

KERNEL = 0.1
"""Width of the kernel that says how likely a row is the nearest, as a fraction of the mean distance of two rows."""

ROWS = 400
"""Most rows that are compared with each other: of larger groups, rows spread evenly stand for all."""

SETTLED, MOST_ROUNDS = 3e-3, 30
"""The weights, a vector of length 1, have settled once a round would move them by less."""


def measure(values: FloatArray, positive: BoolArray, seed: int) -> FloatArray:
    r"""Weights of iterative Relief.

    The margin of a row is how much farther than its nearest row of its own group, the hit, its nearest row of the
    other group, the miss, lies. Which rows are nearest depends on the weights, so all rows are taken, each with the
    probability of being the nearest under the weights of the round before:

    .. math::
        v_k = \sum_n a_n \gamma_n \left( \sum_{i \in M_n} P_M(i) |x_{nk} - x_{ik}|
              - \sum_{i \in H_n} P_H(i) |x_{nk} - x_{ik}| \right), \quad
        w = \frac{\max(v, 0)}{\|\max(v, 0)\|}

    with probabilities in proportion to :math:`\exp(-d_w(n, i) / \sigma)`, the distance :math:`d_w` of weighted absolute
    differences, and the probability :math:`\gamma_n` that row n is no outlier: that the nearest row of all is of its
    group. Columns are divided by their range first. Rounds go on until the weights have settled.

    Three choices are ours. The kernel's width follows the mean distance, so no unit matters. Both groups count
    equally, in the sum and in :math:`\gamma`, however much larger one is. A row that is alone in its group has no
    hit; its misses count alone.

    Parameters
    ----------
    values : (n, d) float64 array
        Columns that vary.
    positive : (n,) bool array
    seed : int
        Not used.

    Returns
    -------
    (d,) float64 array
        In [0, 1], the squares add up to 1; 0 for columns that narrow the margin.
    """
    from shapeviz_report.scorers.kernels import relief

    scaled = (values - values.min(axis=0)) / np.ptp(values, axis=0)
    rows = _spread(scaled, positive)
    scaled, positive = scaled[rows].astype(np.float32), positive[rows]
    weights = np.full(scaled.shape[1], scaled.shape[1] ** -0.5)
    step, before = 1.0, np.zeros_like(weights)
    for _ in range(MOST_ROUNDS):
        used = weights > 0
        distances = relief.distances(scaled[:, used] * weights[used].astype(np.float32)).astype(np.float64)
        shares = _shares(distances, positive)
        margins = relief.differences(scaled, (shares + shares.T).astype(np.float32)).astype(np.float64)
        widening = np.maximum(margins, 0.0)
        if not widening.any():
            return widening
        move = widening / np.linalg.norm(widening) - weights
        if np.linalg.norm(move) < SETTLED:
            break
        # Two columns that each need the other can take turns for ever: shorter steps meet in the middle.
        if move @ before < 0:
            step /= 2
        before = move
        weights = weights + step * move
        weights /= np.linalg.norm(weights)
    return weights


def _spread(scaled: FloatArray, positive: BoolArray) -> npt.NDArray[np.intp]:
    """At most ``ROWS`` rows, of both groups the same number as far as they go, spread evenly by their sums."""
    groups = [np.flatnonzero(group) for group in (positive, ~positive)]
    smaller = min(len(group) for group in groups)
    most = max(ROWS // 2, ROWS - smaller)
    sums = scaled.sum(axis=1)
    chosen = []
    for group in groups:
        count = min(len(group), most)
        ordered = group[np.argsort(sums[group], kind="stable")]
        chosen.append(ordered[((np.arange(count) + 0.5) * len(group) / count).astype(np.intp)])
    return np.concatenate(chosen)


def _shares(distances: FloatArray, positive: BoolArray) -> FloatArray:
    """What each pair (n, i) counts in the sum over n, negative for hits; (n, n)."""
    count = len(distances)
    itself = np.eye(count, dtype=bool)
    width = KERNEL * distances.sum() / (count * (count - 1))
    if width == 0:
        return np.zeros_like(distances)
    same = positive[:, None] == positive
    nearest, chances, shares = [], [], []
    for group in (same & ~itself, ~same):
        away = np.where(group, distances, np.inf)
        least = away.min(axis=1, keepdims=True)
        least[np.isinf(least)] = 0.0  # no row in this group: every chance is 0
        likely = np.exp(-(away - least) / width)
        total = likely.sum(axis=1, keepdims=True)
        nearest.append(least)
        chances.append(total / np.maximum(group.sum(axis=1, keepdims=True), 1))
        shares.append(np.divide(likely, total, out=np.zeros_like(likely), where=total > 0))
    # As if both groups were of the same size.
    alone = chances[0] == 0
    advantage = np.log(np.where(alone, 1.0, chances[0]) / chances[1]) + (nearest[1] - nearest[0]) / width
    no_outlier = np.where(alone, 1.0, expit(advantage))
    counts = np.where(positive, 0.5 / positive.sum(), 0.5 / (~positive).sum())[:, None]
    return counts * no_outlier * (shares[1] - shares[0])


RELIEF = Scorer(
    name="relief",
    title="Iterative Relief",
    explanation="High where shapes differ from their nearest neighbours in the other group more than from those in "
    "their own, among all bins together; 0 where the bin narrows this margin.",
    source="Sun 2007; Relief: Kira and Rendell 1992",
    range="0 to 1, all squares together 1",
    exact=True,
    measure=measure,
)
