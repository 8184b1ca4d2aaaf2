"""Extremely randomised trees (Geurts, Ernst and Wehenkel 2006) for two classes: importances only.

Growing a tree takes a fraction of a millisecond here, so that enough trees for steady scores can be grown.
``site/scripts/engine/score-trees.js`` takes the same steps with the same random numbers.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.scorers.kernels import random
from shapeviz_report.types import Float32Array

_NO_NAN = {"nnan", "nsz"}
"""What the compiler may assume so that extremes become vector instructions; no sum is reordered."""


@kernel(error_model="numpy", fastmath=_NO_NAN)
def importances(
    columns: Float32Array, positive: npt.NDArray[np.int32], trees: int, candidates: int, seed: int
) -> npt.NDArray[np.float64]:
    """Mean decrease of the Gini impurity by each column, as in Breiman et al. 1984.

    A node draws columns until ``candidates`` of them vary within it, cuts each at a threshold drawn evenly between its
    least and greatest value there, and keeps the cut that lowers the impurity most. Nodes are cut until they
    hold rows of one class or equal rows.

    Parameters
    ----------
    columns : (d, n) float32 array
        The table, one row a column.
    positive : (n,) int32 array
        1 or 0: the class of each of the n rows of the table.
    trees, candidates : int
        At least 1.
    seed : int

    Returns
    -------
    (d,) float64 array
        At least 0; adds up to 1 if any tree has a cut.
    """
    width, count = columns.shape
    state = random.start(seed)
    total = np.zeros(width)
    gains = np.empty(width)
    order = np.arange(width)
    rows = np.arange(count)
    # The classes and the values of one column of the rows of the node that is cut.
    is_hit, inside = np.empty(count, np.int32), np.empty(count, np.float32)
    # Nodes to be cut: the first and last place in `rows` of each. Depth first, so never more than there are rows.
    begins, ends = np.empty(count + 1, np.int64), np.empty(count + 1, np.int64)
    for _ in range(trees):
        gains[:] = 0.0
        begins[0], ends[0], waiting = 0, count, 1
        while waiting > 0:
            waiting -= 1
            begin, end = begins[waiting], ends[waiting]
            size, hits = end - begin, 0
            for place in range(size):
                is_hit[place] = positive[rows[begin + place]]
                hits += is_hit[place]
            if hits == 0 or hits == size:
                continue
            # n times the impurity of a node of n rows, p of them positive, is 2 p (n - p) / n.
            impurity = 2.0 * hits * (size - hits) / size
            best_gain, best_column, best_threshold = -1.0, -1, np.float32(0.0)
            drawn, varying = 0, 0
            while varying < candidates and drawn < width:
                pick = drawn + int(random.uniform(state) * (width - drawn))
                column = order[pick]
                order[pick], order[drawn] = order[drawn], column
                drawn += 1
                values = columns[column]
                for place in range(size):
                    inside[place] = values[rows[begin + place]]
                low = high = inside[0]
                for place in range(1, size):
                    low, high = min(low, inside[place]), max(high, inside[place])
                if low == high:
                    continue
                varying += 1
                threshold = np.float32(float(low) + random.uniform(state) * (float(high) - float(low)))
                if threshold >= high:  # by rounding
                    threshold = low
                below, below_hits = np.int32(0), np.int32(0)
                for place in range(size):
                    is_below = np.int32(inside[place] <= threshold)
                    below += is_below
                    below_hits += is_below & is_hit[place]
                above, above_hits = size - below, hits - below_hits
                rest = 2.0 * below_hits * (below - below_hits) / below
                rest += 2.0 * above_hits * (above - above_hits) / above
                if impurity - rest > best_gain:
                    best_gain, best_column, best_threshold = impurity - rest, column, threshold
            if best_column < 0:
                continue
            gains[best_column] += best_gain
            values = columns[best_column]
            middle = begin
            for place in range(begin, end):
                row = rows[place]
                if values[row] <= best_threshold:
                    rows[place], rows[middle] = rows[middle], row
                    middle += 1
            begins[waiting], ends[waiting] = begin, middle
            begins[waiting + 1], ends[waiting + 1] = middle, end
            waiting += 2
        whole = gains.sum()
        if whole > 0:
            total += gains / whole / trees
    return total
