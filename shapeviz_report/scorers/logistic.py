"""Randomised logistic regression: which columns are selected again and again (stability selection)."""

from __future__ import annotations

import numpy as np

from shapeviz_report.scorers.balance import balanced_weights, standardise
from shapeviz_report.scorers.base import Scorer
from shapeviz_report.types import BoolArray, FloatArray

PAIRS = 50
"""Random cuts of the rows into two halves: twice as many runs."""

MOST = 200
"""Rows of either group in a run, so that a run costs no more with thousands of shapes than with some hundreds."""

STRENGTHS = 0.64 ** np.arange(1, 7)
"""Of the penalty, as parts of the least that leaves no coefficient; the last one leaves about one in a hundred."""

WEAKEST = 0.5
"""A run makes the penalty of a column up to twice as strong."""

TOLERANCE = 1e-4
"""Of the optimum's conditions, as a part of the largest penalty."""


def measure(values: FloatArray, positive: BoolArray, seed: int) -> FloatArray:
    """In which share of the runs and strengths of the penalty each column has a coefficient.

    A run is a logistic regression with an L1 penalty on standardised columns, on a random half of either group,
    groups of equal weight, with a random penalty for each column (Meinshausen and Bühlmann 2010). The two halves of
    a cut are two runs (Shah and Samworth 2013). The mean over the strengths, the area below the "stability path",
    ranks columns also where the share at one strength is 0 or 1 for many.

    Parameters
    ----------
    values : (n, d) float64 array
    positive : (n,) bool array
    seed : int

    Returns
    -------
    (d,) float64 array
        In [0, 1]; 0 for most columns where there are many.
    """
    from shapeviz_report.scorers.kernels import stability

    scaled = standardise(values, balanced_weights(positive))
    columns = np.ascontiguousarray(np.concatenate([scaled[positive], scaled[~positive]]).T)
    hits = int(positive.sum())
    selected = stability.selections(columns, hits, PAIRS, MOST, STRENGTHS, WEAKEST, TOLERANCE, seed)
    return selected / (2 * PAIRS * len(STRENGTHS))


LOGISTIC = Scorer(
    name="logistic",
    title="Randomised logistic regression",
    explanation="High where a classifier that may use few bins picks this one again and again, whichever half of the "
    "shapes it sees; of bins that say the same, each is picked in some of the runs only.",
    source="Meinshausen and Bühlmann 2010; halves: Shah and Samworth 2013",
    range="0 to 1, the share of the runs that pick the bin",
    exact=False,
    measure=measure,
)
