"""Nearest neighbours by a grid of cells."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray, Int64Array, IntArray


@kernel(error_model="numpy")
def find_nearest(
    points: FloatArray, cells: IntArray, starts: Int64Array, width: float, order: IntArray, wanted: int
) -> tuple[FloatArray, IntArray]:
    """The ``wanted`` points nearest to each, itself excluded.

    Parameters
    ----------
    points : (3, n) float64 array
        Sorted by cell, and the cells by row, column and place.
    cells : (n, 3) int32 array
        The cell of each point: it is ``width`` wide, and the point within it.
    starts : (a, b, c + 1) int64 array
        Where the points of each cell begin, and those of the last in a row end.
    order : (n,) int32 array
        The names of the points.
    wanted : int
        At most n - 1.

    Returns
    -------
    squared : (n, wanted) float64 array
        Squared distances, in no order.
    nearest : (n, wanted) int32 array
        Names; both have a row for each name.
    """
    count = points.shape[1]
    distances, nearest = np.empty((count, wanted)), np.empty((count, wanted), np.int32)
    squared, place = np.empty(count), np.empty(count, np.int32)
    rows, columns, places = starts.shape[0], starts.shape[1], starts.shape[2] - 1
    for p in range(count):
        x, y, z = points[0, p], points[1, p], points[2, p]
        reach = 1
        while True:
            size = 0
            low, high = max(0, cells[p, 2] - reach), min(places, cells[p, 2] + reach + 1)
            for i in range(max(0, cells[p, 0] - reach), min(rows, cells[p, 0] + reach + 1)):
                for j in range(max(0, cells[p, 1] - reach), min(columns, cells[p, 1] + reach + 1)):
                    start = starts[i, j, low]
                    for q in range(starts[i, j, high] - start):
                        dx, dy, dz = (
                            points[0, start + q] - x,
                            points[1, start + q] - y,
                            points[2, start + q] - z,
                        )
                        squared[size + q] = dx * dx + dy * dy + dz * dz
                        place[size + q] = start + q
                    size += starts[i, j, high] - start
            # All points within the reach have been seen, itself among them.
            beyond = (reach * width) ** 2
            within = 0
            for q in range(size):
                within += int(squared[q] <= beyond)
            if within > wanted:
                break
            if size == count:
                beyond = 0.0
                for q in range(size):
                    beyond = max(beyond, squared[q])
                break
            reach *= 2
        # Halve the range of the radius until it takes in as many as wanted, or only equals are left in it.
        inside = -1.0
        while True:
            middle = 0.5 * (inside + beyond)
            if middle <= inside or middle >= beyond:
                break
            within = 0
            for q in range(size):
                within += int(squared[q] <= middle)
            if within > wanted:
                beyond = middle
                if within == wanted + 1:
                    break
            else:
                inside = middle
        if within == wanted + 1:
            inside = beyond
        name, found = order[p], 0
        for q in range(size):
            if squared[q] <= inside and place[q] != p:
                distances[name, found], nearest[name, found] = squared[q], order[place[q]]
                found += 1
        for q in range(size):
            if found == wanted:
                break
            if inside < squared[q] <= beyond and place[q] != p:
                distances[name, found], nearest[name, found] = squared[q], order[place[q]]
                found += 1
    return distances, nearest
