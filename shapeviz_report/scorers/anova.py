"""The F statistic of a one-way analysis of variance."""

from __future__ import annotations

import numpy as np

from shapeviz_report.scorers.base import Scorer
from shapeviz_report.types import BoolArray, FloatArray


def measure(values: FloatArray, positive: BoolArray, seed: int) -> FloatArray:
    r"""F scores, as scikit-learn's ``f_classif`` has them.

    .. math:: F_j = (n - 2) \frac{\sum_g n_g (\bar x_{gj} - \bar x_j)^2}{\sum_g \sum_{i \in g} (x_{ij} - \bar x_{gj})^2}

    Where neither group has any spread, F is infinite. Here a spread counts as no smaller than the rounding error
    of the table's widest column, which keeps F finite and ranks such columns by the distance of their groups.
    For two rows n - 2 counts as 1.

    Parameters
    ----------
    values : (n, d) float64 array
    positive : (n,) bool array
    seed : int
        Not used.

    Returns
    -------
    (d,) float64 array
        At least 0, without a unit.
    """
    first, second = values[positive], values[~positive]
    means = first.mean(axis=0), second.mean(axis=0)
    count = len(values)
    between = len(first) * len(second) / count * (means[0] - means[1]) ** 2
    within = ((first - means[0]) ** 2).sum(axis=0) + ((second - means[1]) ** 2).sum(axis=0)
    floor = np.finfo(np.float64).eps * (between + within).max()
    return max(count - 2, 1) * between / np.maximum(within, floor)


ANOVA = Scorer(
    name="anova",
    title="ANOVA F",
    explanation="High where the means of the two groups lie far apart compared with the spread within the groups.",
    source="Fisher 1925",
    range="0 to infinity",
    exact=True,
    measure=measure,
)
