"""Recursive feature elimination with a linear classifier."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from shapeviz_report.scorers.balance import balanced_weights, standardise
from shapeviz_report.scorers.base import Scorer
from shapeviz_report.types import BoolArray, FloatArray

PENALTY = 10.0
"""On squared coefficients, in units of the mean eigenvalue of the rows' matrix of scalar products.
docs/method/scorers.md compares it with weaker and stronger ones, and with support vector machines."""

SHARE = 0.1
"""Part of the columns left that leaves in a round."""

ONE_BY_ONE = 50
"""From so many columns on, one leaves in a round."""

TIE = 1e-9
"""Coefficients that differ by less than this fraction of the largest are equal."""


def measure(values: FloatArray, positive: BoolArray, seed: int) -> FloatArray:
    r"""The place at which each column leaves: the last has 1, the first of d has 1/d.

    Each round fits a classifier to the columns that are left, and those with the smallest coefficients leave. The
    classifier is ridge regression on +1 and -1 with groups of equal weight,

    .. math:: \min_w \sum_i s_i (x_i \cdot w - t_i)^2 + \lambda |w|^2, \quad \lambda = 10 \frac{d'}{n},

    on standardised columns, d' of which are left, with weights s that add up to 1. The eigenvalues of the n rows'
    matrix of scalar products add up to d': the penalty stays as strong while columns leave.

    Columns with equal coefficients, such as copies, leave together and share the mean of their places, so
    that no order of the columns matters.

    Parameters
    ----------
    values : (n, d) float64 array
    positive : (n,) bool array
    seed : int
        Not used.

    Returns
    -------
    (d,) float64 array
        In (0, 1].
    """
    weights = balanced_weights(positive)
    scaled = standardise(values, weights) * np.sqrt(weights)[:, None]
    target = np.where(positive, 1.0, -1.0) * np.sqrt(weights)
    count = scaled.shape[1]
    left = np.arange(count)
    places = np.empty(count)
    while len(left):
        sizes = np.abs(coefficients(scaled[:, left], target, PENALTY * len(left) / len(target)))
        order = np.argsort(sizes, kind="stable")
        sizes = sizes[order]
        ends = np.append(np.flatnonzero(np.diff(sizes) > TIE * sizes[-1]) + 1, len(left))
        leaving = max(1, int(SHARE * len(left))) if len(left) > ONE_BY_ONE else 1
        last = np.searchsorted(ends, leaving)
        start = 0
        for end in ends[: last + 1]:
            places[left[order[start:end]]] = count - len(left) + (start + 1 + end) / 2
            start = end
        left = np.delete(left, order[:start])
    return places / count


def coefficients(columns: FloatArray, target: FloatArray, penalty: float) -> FloatArray:
    """Ridge regression without an intercept; (d,) from (n, d) and (n,).

    It takes the smaller one of the two systems of equations that have the same solution.
    """
    if columns.shape[0] < columns.shape[1]:
        system = columns @ columns.T
        system.flat[:: len(system) + 1] += penalty
        return columns.T @ scipy.linalg.solve(system, target, assume_a="pos")
    system = columns.T @ columns
    system.flat[:: len(system) + 1] += penalty
    return scipy.linalg.solve(system, columns.T @ target, assume_a="pos")


RFE = Scorer(
    name="rfe",
    title="Recursive elimination",
    explanation="High where a linear classifier of the two groups keeps the bin for long, while it loses the bins that "
    "it needs least; bins that repeat others go early.",
    source="Guyon et al. 2002, with ridge regression as its classifier",
    range="0 to 1, by the order of leaving",
    exact=True,
    measure=measure,
)
