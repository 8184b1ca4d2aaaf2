"""Importances of columns in extremely randomised trees."""

from __future__ import annotations

import math

import numpy as np

from shapeviz_report.scorers.base import Scorer
from shapeviz_report.types import BoolArray, FloatArray

COUNT = 1000
"""A second in a browser, for a class of 280 shapes against the rest; another seed shares three quarters of the best 30
columns (docs/method/scorers.md). The error falls with the root of the number."""


def measure(values: FloatArray, positive: BoolArray, seed: int) -> FloatArray:
    """By how much the cuts at each column purify the nodes of the trees that tell the two groups apart.

    The trees are those of scikit-learn's ``ExtraTreesClassifier`` with its own options: every node looks at the root
    of the number of columns, each cut at random, on all rows, down to pure leaves; Gini impurity; single
    precision. They are grown by our own loop: five times as fast, and the browser can take the very same
    steps.

    Parameters
    ----------
    values : (n, d) float64 array
    positive : (n,) bool array
    seed : int

    Returns
    -------
    (d,) float64 array
        Fractions of the whole decrease of impurity; they add up to 1.
    """
    from shapeviz_report.scorers.kernels import extra_trees

    columns = np.ascontiguousarray(values.T, dtype=np.float32)
    return extra_trees.importances(columns, positive.astype(np.int32), COUNT, math.isqrt(len(columns)), seed)


TREES = Scorer(
    name="trees",
    title="Randomised trees",
    explanation="High where decision trees with random thresholds often tell the two groups apart by the bin, alone "
    "or after other bins; bins that say the same share their score.",
    source="Geurts, Ernst and Wehenkel 2006; importances: Breiman et al. 1984",
    range="0 to 1, all bins together 1",
    exact=False,
    measure=measure,
)
