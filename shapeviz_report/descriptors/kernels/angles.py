"""Corner angles: angle sums and angle-weighted normals of vertices."""

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray, IntArray


@kernel()
def gather_angles(vertices: FloatArray, faces: IntArray) -> tuple[FloatArray, FloatArray]:
    """Per vertex: the sum of its corner angles (n,), and its unit normal (n, 3).

    The normal is the sum of unit face normals weighted by corner angle (paper, Eq. 3). Where that sum
    vanishes it is the normal of the vertex's largest face, or (0, 0, 1) without any face that has an area.
    """
    count = len(vertices)
    sums, largest = np.empty(count), np.empty(count)
    normals, fallback = np.empty((count, 3)), np.empty((count, 3))
    for v in range(count):
        sums[v] = largest[v] = 0.0
        normals[v, 0] = normals[v, 1] = normals[v, 2] = fallback[v, 0] = fallback[v, 1] = 0.0
        fallback[v, 2] = 1.0
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        nx, ny, nz, _ = _spread(vertices, a, b, c)
        twice_area = np.sqrt(nx * nx + ny * ny + nz * nz)
        if twice_area == 0.0:
            continue
        nx, ny, nz = nx / twice_area, ny / twice_area, nz / twice_area
        for corner in range(3):
            v, left, right = faces[f, corner], faces[f, (corner + 1) % 3], faces[f, (corner + 2) % 3]
            # atan2 of cross and dot is exact for slivers, where arccos loses half its digits.
            angle = np.arctan2(twice_area, _spread(vertices, v, left, right)[3])
            sums[v] += angle
            normals[v, 0] += angle * nx
            normals[v, 1] += angle * ny
            normals[v, 2] += angle * nz
            if twice_area > largest[v]:
                largest[v] = twice_area
                fallback[v, 0], fallback[v, 1], fallback[v, 2] = nx, ny, nz
    for v in range(count):
        length = np.sqrt(normals[v, 0] ** 2 + normals[v, 1] ** 2 + normals[v, 2] ** 2)
        for x in range(3):
            normals[v, x] = normals[v, x] / length if length > 1e-12 else fallback[v, x]
    return sums, normals


@kernel()
def _spread(vertices: FloatArray, origin: int, left: int, right: int) -> tuple[float, float, float, float]:
    """Cross product (three numbers) and dot product of the ways from ``origin`` to two vertices."""
    lx = vertices[left, 0] - vertices[origin, 0]
    ly = vertices[left, 1] - vertices[origin, 1]
    lz = vertices[left, 2] - vertices[origin, 2]
    rx = vertices[right, 0] - vertices[origin, 0]
    ry = vertices[right, 1] - vertices[origin, 1]
    rz = vertices[right, 2] - vertices[origin, 2]
    return ly * rz - lz * ry, lz * rx - lx * rz, lx * ry - ly * rx, lx * rx + ly * ry + lz * rz
