"""The neighbourhood hit that many candidate columns would give, each added to the same distances.

Squared distances of columns add up, and an added column can only part shapes. So with the others in the order of
their present distance, a row is done as soon as the next of them is farther than the k-th nearest found: with twenty
columns chosen, a tenth of the rows are looked at. Arrays in, arrays out; inputs are trusted.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray


@kernel(error_model="numpy")
def hits_with_each(
    squared: FloatArray,
    others: npt.NDArray[np.int32],
    rows: npt.NDArray[np.int64],
    columns: FloatArray,
    codes: npt.NDArray[np.int64],
    places: npt.NDArray[np.int64],
) -> FloatArray:
    """NH of some shapes (paper, Eq. 7) if a column joined those that made the distances; for every column.

    Neighbours that tie for the last places share them equally, as in :mod:`shapeviz_report.quality`. Distances tie if
    they are equal to the bit: columns lie on a grid on which sums are exact
    (:class:`shapeviz_report.search.bins.bin_space.BinSpace`).

    Parameters
    ----------
    squared : (r, n - 1) float64 array
        Squared distances of each such shape to all others, rising.
    others : (r, n - 1) int32 array
        Which shapes these are.
    rows : (r,) int64 array
        The shapes that are scored.
    columns : (c, n) float64 array
        The candidates.
    codes : (n,) int64 array
        The class of each shape, -1 without a label; those of ``rows`` have one.
    places : (r,) int64 array
        How many neighbours of each such shape count, k; from 1 to n - 1.

    Returns
    -------
    (c, r) float64 array
    """
    count = others.shape[1]
    hits = np.empty((len(columns), len(rows)))
    nearest = np.empty(places.max())
    for c in range(len(columns)):
        column = columns[c]
        for r in range(len(rows)):
            own, code, k = column[rows[r]], codes[rows[r]], places[r]
            found, last = 0, np.inf
            for p in range(count):
                if squared[r, p] > last:
                    break
                step = column[others[r, p]] - own
                distance = squared[r, p] + step * step
                if distance < last:
                    place = min(found, k - 1)
                    while place > 0 and nearest[place - 1] > distance:
                        nearest[place] = nearest[place - 1]
                        place -= 1
                    nearest[place] = distance
                    found = min(found + 1, k)
                    if found == k:
                        last = nearest[k - 1]
            nearer, own_nearer, tied, own_tied = 0, 0, 0, 0
            for p in range(count):
                if squared[r, p] > last:
                    break
                other = others[r, p]
                step = column[other] - own
                distance = squared[r, p] + step * step
                if distance < last:
                    nearer += 1
                    own_nearer += codes[other] == code
                elif distance == last:
                    tied += 1
                    own_tied += codes[other] == code
            hits[c, r] = (own_nearer + (k - nearer) * own_tied / tied) / k
    return hits
