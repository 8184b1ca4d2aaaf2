"""Analytic solids, evenly triangulated, and slow references in plain numpy."""

from __future__ import annotations

import numpy as np
import trimesh

from shapeviz_report.types import FloatArray, Mesh


def ball(subdivisions: int = 4) -> Mesh:
    """Unit sphere, 2562 vertices at 4 subdivisions."""
    return from_trimesh(trimesh.creation.icosphere(subdivisions=subdivisions))


def tube(radius: float = 0.2, half_length: float = 1.0, around: int = 48, along: int = 80) -> Mesh:
    """Open cylinder around the z axis: no caps, so that its analytic values hold everywhere."""
    angle = np.arange(around) * 2 * np.pi / around
    height = np.linspace(-half_length, half_length, along)
    ring = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    vertices = np.concatenate([np.column_stack([ring, np.full(around, z)]) for z in height])
    faces = []
    for row in range(along - 1):
        for column in range(around):
            a, b = row * around + column, row * around + (column + 1) % around
            faces += [(a, b, b + around), (a, b + around, a + around)]
    return Mesh(vertices, np.array(faces, dtype=np.int32))


def sheet(size: int = 20) -> Mesh:
    """Flat square [0, 1]^2 at z = 0, facing up."""
    x, y = np.meshgrid(np.linspace(0, 1, size), np.linspace(0, 1, size))
    vertices = np.column_stack([x.ravel(), y.ravel(), np.zeros(size * size)])
    faces = []
    for row in range(size - 1):
        for column in range(size - 1):
            a = row * size + column
            faces += [(a, a + 1, a + size + 1), (a, a + size + 1, a + size)]
    return Mesh(vertices, np.array(faces, dtype=np.int32))


def torus() -> Mesh:
    """Genus 1, radii 0.7 and 0.3."""
    return from_trimesh(trimesh.creation.torus(0.7, 0.3, major_sections=60, minor_sections=30))


def lump(seed: int = 0) -> Mesh:
    """A smooth blob without symmetry: a sphere pushed in and out, 642 vertices."""
    mesh = ball(3)
    random = np.random.default_rng(seed)
    directions = random.normal(size=(6, 3))
    push = 1 + 0.25 * np.sin(mesh.vertices @ directions.T + random.random(6)).sum(axis=1) / 2
    stretched = mesh.vertices * push[:, None] * [1.0, 0.7, 0.5]
    centred = stretched - stretched.mean(axis=0)
    return Mesh(centred / np.linalg.norm(centred, axis=1).max(), mesh.faces)


def from_trimesh(mesh: trimesh.Trimesh) -> Mesh:
    return Mesh(np.array(mesh.vertices, dtype=np.float64), np.array(mesh.faces, dtype=np.int32))


def rotation(seed: int) -> FloatArray:
    """A random rotation matrix."""
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q
