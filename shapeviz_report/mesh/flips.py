"""Better triangles over the same vertices, by turning the edges between two of them."""

from __future__ import annotations

import numpy as np

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray, IntArray, Mesh

FLAT = float(np.cos(np.radians(20)))
"""Cosine of the largest angle between two faces that may be turned: a ridge stays."""

NEGLIGIBLE = 0.05
"""How far a turned edge may lie from the old one, in its lengths: the surface moves by less than half of it."""

GAIN = 1.02
"""How much better the worse of two faces has to become: so that turning ends."""


def flip_edges(mesh: Mesh) -> Mesh:
    """Turn edges until none makes the worse of its two faces better, where the surface is nearly flat.

    Parameters
    ----------
    mesh : Mesh
        With a common winding.

    Returns
    -------
    Mesh
        The same vertices and as many faces; which edges have how many faces has not changed but for the turned ones.
    """
    faces = np.ascontiguousarray(mesh.faces, dtype=np.int32).copy()
    _flip(np.ascontiguousarray(mesh.vertices, dtype=np.float64), faces, find_twins(faces, len(mesh.vertices)))
    return Mesh(mesh.vertices, faces)


def find_twins(faces: IntArray, count: int) -> IntArray:
    """Of each half-edge ``3 * face + corner``, the other one of its edge, or -1: (3 m,) int32.

    Only of edges with two faces that run along them in opposite directions.
    """
    starts, ends = faces.ravel().astype(np.int64), np.roll(faces, -1, axis=1).ravel()
    keys = np.minimum(starts, ends) * count + np.maximum(starts, ends)
    order = np.argsort(keys, kind="stable").astype(np.int32)
    first = np.flatnonzero(np.diff(keys[order], prepend=-1))
    twos = first[np.diff(np.append(first, len(keys))) == 2]
    one, other = order[twos], order[twos + 1]
    opposite = starts[one] != starts[other]
    twins = np.full(len(keys), -1, np.int32)
    twins[one[opposite]], twins[other[opposite]] = other[opposite], one[opposite]
    return twins


@kernel(error_model="numpy")
def _judge(vertices: FloatArray, a: int, b: int, c: int) -> tuple[float, float, float, float]:
    """The unit normal of a face, and its area over the sum of its squared sides; zeros without an area."""
    ux, uy, uz = (
        vertices[b, 0] - vertices[a, 0],
        vertices[b, 1] - vertices[a, 1],
        vertices[b, 2] - vertices[a, 2],
    )
    vx, vy, vz = (
        vertices[c, 0] - vertices[a, 0],
        vertices[c, 1] - vertices[a, 1],
        vertices[c, 2] - vertices[a, 2],
    )
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    size = np.sqrt(x * x + y * y + z * z)
    if size == 0.0:
        return 0.0, 0.0, 0.0, 0.0
    wx, wy, wz = vx - ux, vy - uy, vz - uz
    squares = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz + wx * wx + wy * wy + wz * wz
    return x / size, y / size, z / size, size / squares


@kernel(error_model="numpy")
def _joined(faces: IntArray, twins: IntArray, half: int, other: int) -> bool:
    """Whether the vertex at which a half-edge starts has an edge to another, seen around it both ways."""
    start = half
    while True:
        face, corner = half // 3, half % 3
        if faces[face, (corner + 1) % 3] == other or faces[face, (corner + 2) % 3] == other:
            return True
        half = twins[3 * face + (corner + 2) % 3]
        if half == start:
            return False
        if half < 0:
            break
    half = twins[start]
    while half >= 0:
        face, corner = half // 3, (half + 1) % 3
        if faces[face, (corner + 1) % 3] == other or faces[face, (corner + 2) % 3] == other:
            return True
        half = twins[3 * face + corner]
    return False


@kernel(error_model="numpy")
def _flip(vertices: FloatArray, faces: IntArray, twins: IntArray) -> None:
    """Turn edges; changes ``faces`` and ``twins`` in place."""
    total = 3 * len(faces)
    # First in, first out, each half-edge at most once in the queue.
    queue, waiting = np.empty(total, np.int32), np.zeros(total, np.bool_)
    head, size = 0, 0
    for half in range(total):
        if twins[half] > half:
            queue[size] = half
            waiting[half] = True
            size += 1
    while size > 0:
        half = queue[head]
        head = head + 1 if head + 1 < total else 0
        size -= 1
        waiting[half] = False
        twin = twins[half]
        if twin < 0:
            continue
        f, i, g, j = half // 3, half % 3, twin // 3, twin % 3
        a, b = faces[f, i], faces[f, (i + 1) % 3]
        c, d = faces[f, (i + 2) % 3], faces[g, (j + 2) % 3]
        if c == d:
            continue
        fx, fy, fz, quality_f = _judge(vertices, a, b, c)
        gx, gy, gz, quality_g = _judge(vertices, b, a, d)
        hx, hy, hz, quality_h = _judge(vertices, c, a, d)
        kx, ky, kz, quality_k = _judge(vertices, d, b, c)
        if min(quality_h, quality_k) <= GAIN * min(quality_f, quality_g):
            continue
        # A face without an area has no side.
        bent = quality_f > 0.0 and quality_g > 0.0 and fx * gx + fy * gy + fz * gz < FLAT
        nx, ny, nz = fx + gx, fy + gy, fz + gz
        length = np.sqrt(nx * nx + ny * ny + nz * nz)
        if bent or length == 0.0:
            continue
        if min(hx * nx + hy * ny + hz * nz, kx * nx + ky * ny + kz * nz) < FLAT * length:
            continue
        # The two edges cross, one above the other.
        gap = abs(
            (vertices[c, 0] - vertices[a, 0]) * nx
            + (vertices[c, 1] - vertices[a, 1]) * ny
            + (vertices[c, 2] - vertices[a, 2]) * nz
        )
        gap = max(
            gap,
            abs(
                (vertices[d, 0] - vertices[a, 0]) * nx
                + (vertices[d, 1] - vertices[a, 1]) * ny
                + (vertices[d, 2] - vertices[a, 2]) * nz
            ),
        )
        square = 0.0
        for axis in range(3):
            square += (vertices[d, axis] - vertices[c, axis]) ** 2
        if gap > NEGLIGIBLE * np.sqrt(square) * length:
            continue
        if _joined(faces, twins, 3 * f + (i + 2) % 3, d):
            continue
        # The face (a, b, c) becomes (c, a, d), and (b, a, d) becomes (d, b, c).
        of_bc, of_ca = twins[3 * f + (i + 1) % 3], twins[3 * f + (i + 2) % 3]
        of_ad, of_db = twins[3 * g + (j + 1) % 3], twins[3 * g + (j + 2) % 3]
        faces[f, 0], faces[f, 1], faces[f, 2] = c, a, d
        faces[g, 0], faces[g, 1], faces[g, 2] = d, b, c
        twins[3 * f], twins[3 * f + 1], twins[3 * f + 2] = of_ca, of_ad, 3 * g + 2
        twins[3 * g], twins[3 * g + 1], twins[3 * g + 2] = of_db, of_bc, 3 * f + 2
        for side in (3 * f, 3 * f + 1, 3 * g, 3 * g + 1):
            across = twins[side]
            if across < 0:
                continue
            twins[across] = side
            if not (waiting[side] or waiting[across]):
                tail = head + size
                queue[tail if tail < total else tail - total] = side
                waiting[side] = True
                size += 1
