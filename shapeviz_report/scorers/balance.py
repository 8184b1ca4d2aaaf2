"""Two groups of different sizes on an equal footing, for linear classifiers."""

from __future__ import annotations

import numpy as np

from shapeviz_report.types import BoolArray, FloatArray


def balanced_weights(positive: BoolArray) -> FloatArray:
    """A weight for each row, such that either group has one half and all add up to 1; (n,)."""
    count = positive.sum()
    return np.where(positive, 0.5 / count, 0.5 / (len(positive) - count))


def standardise(values: FloatArray, weights: FloatArray) -> FloatArray:
    """Columns of weighted mean 0 and weighted variance 1, so that their coefficients can be compared.

    Weighted, so that the spread within a small group counts as much as that within a large one (docs/method/scorers.md
    says what else would be lost).

    Parameters
    ----------
    values : (n, d) float64 array
        Every column varies.
    weights : (n,) float64 array
        Positive, adding up to 1.

    Returns
    -------
    (n, d) float64 array
    """
    centred = values - weights @ values
    return centred / np.sqrt(weights @ centred**2)
