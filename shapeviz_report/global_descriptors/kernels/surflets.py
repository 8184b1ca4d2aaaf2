"""Pairs of oriented points."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray, IntArray


@kernel(error_model="numpy")
def count_pairs(
    points: FloatArray,
    normals: FloatArray,
    shifts: IntArray,
    farthest: float,
    distances: int,
    angles: int,
) -> FloatArray:
    """Count the pairs of each point with those ``shifts`` places on, by how they lie.

    Returns
    -------
    (distances, angles, angles (angles + 1) / 2) float64 array
        By distance up to ``farthest``, by |n1 . n2|, and by the larger and the smaller of |n1 . d| and |n2 . d|, where
        d is the direction between the two. Adds up to 1.
    """
    counts = np.zeros((distances, angles, angles * (angles + 1) // 2))
    for shift in shifts:
        for i in range(len(points)):
            j = (i + shift) % len(points)
            dx, dy, dz = points[j, 0] - points[i, 0], points[j, 1] - points[i, 1], points[j, 2] - points[i, 2]
            distance = np.sqrt(dx * dx + dy * dy + dz * dz)
            scale = 1.0 / distance if distance > 0.0 else 0.0
            m, n = normals[i], normals[j]
            turn = abs(m[0] * n[0] + m[1] * n[1] + m[2] * n[2])
            first = abs(m[0] * dx + m[1] * dy + m[2] * dz) * scale
            second = abs(n[0] * dx + n[1] * dy + n[2] * dz) * scale
            large = min(int(max(first, second) * angles), angles - 1)
            small = min(int(min(first, second) * angles), angles - 1)
            far = min(int(distance / farthest * distances), distances - 1)
            counts[far, min(int(turn * angles), angles - 1), large * (large + 1) // 2 + small] += 1.0
    return counts / (len(points) * len(shifts))
