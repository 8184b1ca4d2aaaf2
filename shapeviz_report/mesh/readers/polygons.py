"""Polygons of any size, and how they become triangles."""

from __future__ import annotations

from dataclasses import dataclass

import manifold3d
import numpy as np
import numpy.typing as npt

from shapeviz_report.errors import MeshError
from shapeviz_report.types import FloatArray

Indices = npt.NDArray[np.int64]

# a corner is reflex only if it turns back by more than this fraction of the polygon's area, not by rounding
_REFLEX_TOLERANCE = 1e-9


@dataclass(frozen=True)
class PolygonMesh:
    """A mesh as a file has it.

    Attributes
    ----------
    vertices : (n, 3) float64 array
    corners : (k,) int64 array
        The vertices of all polygons, one polygon after the other.
    sizes : (m,) int64 array
        Number of corners of each polygon; sums to ``k``.
    """

    vertices: FloatArray
    corners: Indices
    sizes: Indices

    @classmethod
    def of_triangles(cls, vertices: FloatArray, faces: Indices) -> PolygonMesh:
        """A mesh of vertices (n, 3) and triangles (m, 3)."""
        return cls(vertices, faces.ravel(), np.full(len(faces), 3, dtype=np.int64))


def whole_numbers(values: npt.NDArray[np.generic]) -> Indices:
    """Indices that were read as numbers. Raises ``MeshError`` if one is not whole."""
    indices = values.astype(np.int64)
    if (indices != values).any():
        raise MeshError("a face refers to a vertex by a number that is not whole")
    return indices


def check_indices(vertices: FloatArray, indices: Indices) -> None:
    """Refuse indices of vertices that are not there. Raises ``MeshError``."""
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise MeshError("its vertices do not have three coordinates")
    if len(indices) and not (indices.min() >= 0 and indices.max() < len(vertices)):
        worst = indices.max() if indices.min() >= 0 else indices.min()
        raise MeshError(
            f"a face refers to vertex {worst} (counted from 0), but there are {len(vertices)} vertices"
        )


def triangulate(mesh: PolygonMesh) -> Indices:
    """Cut every polygon into triangles, in the order of the polygons.

    Convex polygons become fans. A concave quad is cut at its reflex corner, and a larger concave polygon,
    which a fan would fold over, is triangulated in the plane of its Newell normal. Polygons of fewer than
    three corners vanish.

    Parameters
    ----------
    mesh : PolygonMesh
        Its corners are valid indices of its vertices.

    Returns
    -------
    (t, 3) int64 array
        With the orientation of the polygons.
    """
    starts = np.cumsum(mesh.sizes) - mesh.sizes
    triangles = [np.empty((0, 3), np.int64)]
    owners = [np.empty(0, np.int64)]
    for size in np.unique(mesh.sizes[mesh.sizes >= 3]):
        which = np.flatnonzero(mesh.sizes == size)
        polygons = mesh.corners[starts[which, None] + np.arange(size)]
        triangles.append(_cut(mesh.vertices, polygons).reshape(-1, 3))
        owners.append(np.repeat(which, size - 2))
    order = np.argsort(np.concatenate(owners), kind="stable")
    return np.concatenate(triangles)[order]


def _cut(vertices: FloatArray, polygons: Indices) -> Indices:
    """Triangles (p, s - 2, 3) of p polygons (p, s) of one size."""
    size = polygons.shape[1]
    if size == 3:
        return polygons[:, None, :]
    points = vertices[polygons]
    with np.errstate(
        all="ignore"
    ):  # what is not finite compares false below, and is cut as if it were convex
        points = points - points[:, :1]
        points = points / np.abs(points).max(axis=(1, 2), keepdims=True)
        normals = np.cross(points, np.roll(points, -1, axis=1)).sum(axis=1)
        turns = np.cross(points - np.roll(points, 1, axis=1), np.roll(points, -1, axis=1) - points)
        areas = np.einsum("pi,pi->p", normals, normals)
        reflex = np.einsum("psi,pi->ps", turns, normals) < -_REFLEX_TOLERANCE * areas[:, None]
    if size == 4:
        first = np.argmax(reflex, axis=1)
        polygons = np.take_along_axis(polygons, (first[:, None] + np.arange(4)) % 4, axis=1)
    triangles = _fans(polygons)
    if size > 4:
        for index in np.flatnonzero(reflex.any(axis=1)):
            planar = manifold3d.triangulate([_project(points[index], normals[index])])
            if len(planar) == size - 2:
                triangles[index] = polygons[index][planar]
    return triangles


def _fans(polygons: Indices) -> Indices:
    first = np.broadcast_to(polygons[:, :1], (len(polygons), polygons.shape[1] - 2))
    return np.stack([first, polygons[:, 1:-1], polygons[:, 2:]], axis=2)


def _project(points: FloatArray, normal: FloatArray) -> FloatArray:
    """Coordinates (s, 2) in the plane across a normal, counter-clockwise as seen against it."""
    axis = np.zeros(3)
    axis[np.argmin(np.abs(normal))] = 1
    right = np.cross(axis, normal)
    right /= np.linalg.norm(right)
    up = np.cross(normal, right)
    up /= np.linalg.norm(up)
    return points @ np.column_stack([right, up])
