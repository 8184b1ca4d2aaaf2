"""Points on a surface."""

from __future__ import annotations

import numpy as np

from shapeviz_report.types import FloatArray, IntArray, Mesh


def sample_surface(mesh: Mesh, count: int) -> tuple[FloatArray, IntArray]:
    """Points (count, 3) spread evenly over a surface and their faces (count,); the same ones every time."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    random = np.random.default_rng(0)
    position = (np.arange(count) + random.random(count)) / count * area.sum()
    face = np.minimum(np.searchsorted(np.cumsum(area), position), len(area) - 1)
    u, v = random.random((2, count, 1))
    root = np.sqrt(u)
    return (1 - root) * a[face] + root * (1 - v) * b[face] + root * v * c[face], face
