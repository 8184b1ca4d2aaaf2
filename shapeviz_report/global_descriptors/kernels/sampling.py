"""Points spread evenly over a surface."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray, IntArray

STEP_U = 0.7548776662466927
"""Step of the sequence R2 (Roberts 2018): 1 / g of the real root g of g^3 = g + 1."""

STEP_V = STEP_U**2
"""The other one."""


@kernel(error_model="numpy")
def spread_points(vertices: FloatArray, faces: IntArray, count: int) -> tuple[FloatArray, FloatArray]:
    """Place ``count`` points at equal steps of area along the faces, and by R2 inside a face.

    Returns
    -------
    points : (count, 3) float64 array
    normals : (count, 3) float64 array
        Unit normals of their faces.
    """
    crossed = np.empty((len(faces), 3))
    ends = np.empty(len(faces))
    total = 0.0
    for f in range(len(faces)):
        a, b, c = vertices[faces[f, 0]], vertices[faces[f, 1]], vertices[faces[f, 2]]
        ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
        vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
        x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
        size = np.sqrt(x * x + y * y + z * z)
        scale = 1 / size if size > 0.0 else 0.0
        crossed[f, 0], crossed[f, 1], crossed[f, 2] = x * scale, y * scale, z * scale
        total += size
        ends[f] = total
    points, normals = np.empty((count, 3)), np.empty((count, 3))
    face = 0
    for i in range(count):
        place = (i + 0.5) / count * total
        while face < len(faces) - 1 and ends[face] <= place:
            face += 1
        u, v = (0.5 + i * STEP_U) % 1.0, (0.5 + i * STEP_V) % 1.0
        if u + v > 1.0:
            u, v = 1.0 - u, 1.0 - v
        a, b, c = vertices[faces[face, 0]], vertices[faces[face, 1]], vertices[faces[face, 2]]
        for axis in range(3):
            points[i, axis] = a[axis] + u * (b[axis] - a[axis]) + v * (c[axis] - a[axis])
            normals[i, axis] = crossed[face, axis]
    return points, normals
