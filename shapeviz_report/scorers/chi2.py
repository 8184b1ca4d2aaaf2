"""The chi-squared statistic of a column's sums in the two groups."""

from __future__ import annotations

from shapeviz_report.scorers.base import Scorer
from shapeviz_report.types import BoolArray, FloatArray


def measure(values: FloatArray, positive: BoolArray, seed: int) -> FloatArray:
    r"""Chi-squared scores, as scikit-learn's ``chi2`` has them.

    .. math:: \chi^2_j = \sum_{g} \frac{(O_{gj} - E_{gj})^2}{E_{gj}}

    with the sum O of column j over the rows of group g, and the sum E that the group would have if every row had
    the column's mean.

    The statistic is one of counts, thus of values that are not negative. A column with negative values, which
    only external features can have, is shifted by its minimum.

    Parameters
    ----------
    values : (n, d) float64 array
    positive : (n,) bool array
    seed : int
        Not used.

    Returns
    -------
    (d,) float64 array
        At least 0. It has the unit of the values: a column times two has twice the score.
    """
    values = values - values.min(axis=0).clip(max=0.0)
    share = positive.mean()
    total = values.sum(axis=0)
    excess = values[positive].sum(axis=0) - share * total
    # What one group has in excess the other lacks.
    return excess**2 / total * (1 / share + 1 / (1 - share))


CHI2 = Scorer(
    name="chi2",
    title="Chi-squared",
    explanation="High where one group has much more of its shapes' surface in the bin than the other, by the sums over "
    "all shapes of a group; bins that hold much count for more than bins that hold little.",
    source="Pearson 1900; as a score of features: Liu and Setiono 1995",
    range="0 to infinity, in the unit of the values",
    exact=True,
    measure=measure,
)
