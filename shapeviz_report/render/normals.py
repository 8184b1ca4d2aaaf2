"""Shading normals that are smooth over curved surfaces and split at creases."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from shapeviz_report.compilation import kernel
from shapeviz_report.types import FloatArray, IntArray, Mesh

CREASE_ANGLE = np.radians(40.0)
SAME_NORMAL = 0.9999  # cosine above which two corners of a vertex share one shaded vertex


@dataclass(frozen=True)
class ShadedSurface:
    """A mesh whose vertices are split wherever its shading normal is not continuous.

    Attributes
    ----------
    source : (s,) int32 array
        The vertex of the mesh that each shaded vertex lies on; a value per mesh vertex (a colour, say)
        becomes one per shaded vertex by ``value[source]``.
    positions : (s, 3) float64 array
    normals : (s, 3) float64 array
        Unit length, on the side given by the winding of the faces.
    faces : (f, 3) int32 array
        Indices of shaded vertices. Faces without area are left out.
    """

    source: IntArray
    positions: FloatArray
    normals: FloatArray
    faces: IntArray


def split_at_creases(mesh: Mesh, crease_angle: float = CREASE_ANGLE) -> ShadedSurface:
    """Give every corner of every face the normal it should be shaded with.

    The normal of a corner is the mean of the unit normals of the faces around its vertex, weighted by their
    angles there (Thuermer and Wuethrich 1998), over those faces only that meet the corner's own face at less
    than ``crease_angle``. Faces are compared as planes, without their side: an inconsistently wound face is
    smoothed with its neighbours all the same, on its own side.

    Parameters
    ----------
    mesh : Mesh
    crease_angle : float
        Radians, in (0, pi/2).

    Returns
    -------
    ShadedSurface
        Corners of one vertex whose normals agree are one shaded vertex.
    """
    corners = mesh.vertices[mesh.faces]
    edges = np.roll(corners, -1, axis=1) - corners
    face_normals = np.cross(edges[:, 0], edges[:, 1])
    lengths = np.linalg.norm(face_normals, axis=1)
    has_area = lengths > 0.0
    faces = np.ascontiguousarray(mesh.faces[has_area])
    face_normals = face_normals[has_area] / lengths[has_area, None]

    edges = edges[has_area]
    edges /= np.linalg.norm(edges, axis=2, keepdims=True)
    cosines = -np.einsum("fcx,fcx->fc", edges, np.roll(edges, 1, axis=1))
    angles = np.arccos(np.clip(cosines, -1.0, 1.0))

    by_vertex = np.argsort(faces.ravel(), kind="stable")
    starts = np.searchsorted(faces.ravel()[by_vertex], np.arange(len(mesh.vertices) + 1))
    source, normals, shaded_faces = _shade_corners(
        faces, face_normals, angles, by_vertex, starts, np.cos(crease_angle)
    )
    return ShadedSurface(source, mesh.vertices[source], normals, shaded_faces)


@kernel()
def _shade_corners(
    faces: IntArray,
    face_normals: FloatArray,
    angles: FloatArray,
    by_vertex: npt.NDArray[np.int64],
    starts: npt.NDArray[np.int64],
    crease_cosine: float,
) -> tuple[IntArray, FloatArray, IntArray]:
    """Average normals around each vertex; ``by_vertex[starts[v]:starts[v + 1]]`` are the corners of ``v``."""
    corner_count = faces.size
    source = np.empty(corner_count, np.int32)
    normals = np.empty((corner_count, 3))
    shaded_faces = np.empty_like(faces)
    count = 0
    for vertex in range(len(starts) - 1):
        first_of_vertex = count
        for own in by_vertex[starts[vertex] : starts[vertex + 1]]:
            own_face = own // 3
            x, y, z = 0.0, 0.0, 0.0
            for other in by_vertex[starts[vertex] : starts[vertex + 1]]:
                face = other // 3
                cosine = (
                    face_normals[own_face, 0] * face_normals[face, 0]
                    + face_normals[own_face, 1] * face_normals[face, 1]
                    + face_normals[own_face, 2] * face_normals[face, 2]
                )
                if abs(cosine) > crease_cosine:
                    weight = np.copysign(angles[face, other % 3], cosine)
                    x += weight * face_normals[face, 0]
                    y += weight * face_normals[face, 1]
                    z += weight * face_normals[face, 2]
            length = np.sqrt(x * x + y * y + z * z)
            if length > 0.0:
                x, y, z = x / length, y / length, z / length
            else:
                x, y, z = face_normals[own_face, 0], face_normals[own_face, 1], face_normals[own_face, 2]
            shaded = first_of_vertex
            while shaded < count:
                cosine = normals[shaded, 0] * x + normals[shaded, 1] * y + normals[shaded, 2] * z
                if cosine > SAME_NORMAL:
                    break
                shaded += 1
            if shaded == count:
                source[count] = vertex
                normals[count, 0], normals[count, 1], normals[count, 2] = x, y, z
                count += 1
            shaded_faces[own_face, own % 3] = shaded
    return source[:count].copy(), normals[:count].copy(), shaded_faces
