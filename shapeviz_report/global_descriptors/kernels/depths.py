"""Orthographic depth images."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray, IntArray


@kernel(error_model="numpy")
def _mark(front: FloatArray, behind: FloatArray, row: int, column: int, height: float) -> None:
    """Let a point be seen from both sides, where no nearer one hides it."""
    height = min(max(height, 0.0), 1.0)
    front[row, column] = max(front[row, column], height)
    behind[row, column] = max(behind[row, column], 1.0 - height)


@kernel(error_model="numpy")
def draw_depths(
    vertices: FloatArray, faces: IntArray, axis: int, size: int, reach: float
) -> tuple[FloatArray, FloatArray]:
    """How near the surface is to a viewer on an axis, from its positive end and from its negative one.

    A face is drawn where it covers the centre of a pixel; vertices are drawn as points too, so that parts thinner than
    a pixel leave a mark.

    Parameters
    ----------
    vertices : (n, 3) float64 array
    faces : (m, 3) int32 array
    axis : int
    size : int
        Pixels of a side, which show [-reach, reach].
    reach : float

    Returns
    -------
    front, behind : (size, size) float64 arrays
        (z + reach) / (2 reach) and (reach - z) / (2 reach) of the nearest point, in [0, 1]; 0 where nothing is.
    """
    front, behind = np.zeros((size, size)), np.zeros((size, size))
    across, up, scale = (axis + 1) % 3, (axis + 2) % 3, size / (2 * reach)
    for i in range(len(vertices)):
        column = int(np.floor((vertices[i, across] + reach) * scale))
        row = int(np.floor((vertices[i, up] + reach) * scale))
        if 0 <= column < size and 0 <= row < size:
            _mark(front, behind, row, column, (vertices[i, axis] + reach) / (2 * reach))
    for f in range(len(faces)):
        a, b, c = vertices[faces[f, 0]], vertices[faces[f, 1]], vertices[faces[f, 2]]
        # In pixels whose centres are whole numbers.
        ax, ay = (a[across] + reach) * scale - 0.5, (a[up] + reach) * scale - 0.5
        bx, by = (b[across] + reach) * scale - 0.5 - ax, (b[up] + reach) * scale - 0.5 - ay
        cx, cy = (c[across] + reach) * scale - 0.5 - ax, (c[up] + reach) * scale - 0.5 - ay
        area = bx * cy - cx * by
        if area == 0.0:
            continue
        left = max(int(np.ceil(ax + min(0.0, min(bx, cx)))), 0)
        right = min(int(np.floor(ax + max(0.0, max(bx, cx)))), size - 1)
        low = max(int(np.ceil(ay + min(0.0, min(by, cy)))), 0)
        high = min(int(np.floor(ay + max(0.0, max(by, cy)))), size - 1)
        for row in range(low, high + 1):
            for column in range(left, right + 1):
                x, y = column - ax, row - ay
                u, v = (x * cy - cx * y) / area, (bx * y - x * by) / area
                if u >= 0.0 and v >= 0.0 and u + v <= 1.0:
                    z = a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis])
                    _mark(front, behind, row, column, (z + reach) / (2 * reach))
    return front, behind
