"""The two sums over all pairs of rows that iterative Relief spends its time on.

Vector instructions of single precision take 280 rows of all columns in a few hundredths of a second.
"""

from __future__ import annotations

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import Float32Array

_REORDERED = {"nnan", "nsz", "reassoc", "contract"}
"""What the compiler may assume so that sums become vector instructions; the last digits follow from it."""


@kernel(error_model="numpy", fastmath=_REORDERED)
def distances(weighted: Float32Array) -> Float32Array:
    """Sums over the columns of absolute differences between all rows of ``weighted`` (n, d); (n, n), symmetric."""
    count, width = weighted.shape
    found = np.zeros((count, count), np.float32)
    for i in range(count):
        for j in range(i):
            total = np.float32(0)
            for k in range(width):
                total += abs(weighted[i, k] - weighted[j, k])
            found[i, j] = found[j, i] = total
    return found


@kernel(error_model="numpy", fastmath=_REORDERED)
def differences(values: Float32Array, shares: Float32Array) -> Float32Array:
    """Sums over all pairs of rows of their absolute differences in each column, each pair with its share.

    Parameters
    ----------
    values : (n, d) float32 array
    shares : (n, n) float32 array
        Of a pair (i, j) counts what stands at [i, j], with j < i.

    Returns
    -------
    (d,) float32 array
    """
    count, width = values.shape
    total = np.zeros(width, np.float32)
    for i in range(count):
        for j in range(i):
            share = shares[i, j]
            for k in range(width):
                total[k] += share * abs(values[i, k] - values[j, k])
    return total
