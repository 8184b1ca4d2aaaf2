"""The surface seen from an axis, all around."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray


@kernel(error_model="numpy")
def _cell(
    points: FloatArray, i: int, axis: int, rows: int, columns: int, reach: float
) -> tuple[int, int, float]:
    """Row by height and column by azimuth of a point, and its distance from the axis."""
    x, y = points[i, (axis + 1) % 3], points[i, (axis + 2) % 3]
    row = int((points[i, axis] + reach) / (2 * reach) * rows)
    column = int((np.arctan2(y, x) + np.pi) / (2 * np.pi) * columns)
    return min(max(row, 0), rows - 1), min(max(column, 0), columns - 1), np.sqrt(x * x + y * y)


@kernel(error_model="numpy")
def unroll(
    points: FloatArray, normals: FloatArray, axis: int, rows: int, columns: int, reach: float, skin: float
) -> tuple[FloatArray, FloatArray]:
    """How far the surface reaches from an axis, and how it slants there.

    Parameters
    ----------
    points, normals : (n, 3) float64 arrays
    axis : int
        Which coordinate runs along the axis.
    rows, columns : int
        Cells of height in [-reach, reach], the outer ones taking what lies beyond, and of azimuth.
    reach : float
    skin : float
        Points count for the slant up to this far below the farthest one of their cell, less and less.

    Returns
    -------
    farthest : (rows, columns) float64 array
        Largest distance from the axis over ``reach``; 0 where nothing is.
    slant : (rows, columns) float64 array
        Mean of the magnitude of the cosine between normal and direction from the axis.
    """
    farthest, slant = np.zeros((rows, columns)), np.zeros((rows, columns))
    weights = np.zeros((rows, columns))
    for i in range(len(points)):
        row, column, distance = _cell(points, i, axis, rows, columns, reach)
        farthest[row, column] = max(farthest[row, column], distance)
    for i in range(len(points)):
        row, column, distance = _cell(points, i, axis, rows, columns, reach)
        weight = 1.0 - (farthest[row, column] - distance) / skin
        if weight > 0.0 and distance > 0.0:
            x, y = points[i, (axis + 1) % 3], points[i, (axis + 2) % 3]
            cosine = abs(normals[i, (axis + 1) % 3] * x + normals[i, (axis + 2) % 3] * y) / distance
            slant[row, column] += weight * cosine
            weights[row, column] += weight
    for row in range(rows):
        for column in range(columns):
            farthest[row, column] /= reach
            if weights[row, column] > 0.0:
                slant[row, column] /= weights[row, column]
    return farthest, slant
