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
    faces, face_normals, angles = _measure_corners(mesh.vertices, mesh.faces)
    by_vertex, starts = _corners_by_vertex(faces, len(mesh.vertices))
    source, normals, shaded_faces = _shade_corners(
        faces, face_normals, angles, by_vertex, starts, np.cos(crease_angle)
    )
    return ShadedSurface(source, mesh.vertices[source], normals, shaded_faces)


@kernel(error_model="numpy")
def _measure_corners(vertices: FloatArray, faces: IntArray) -> tuple[IntArray, FloatArray, FloatArray]:
    """The faces with an area, their unit normals, and the angle at each of their corners."""
    kept = np.empty_like(faces)
    normals, angles = np.empty((len(faces), 3)), np.empty((len(faces), 3))
    edges, lengths = np.empty((3, 3)), np.empty(3)
    count = 0
    for face in faces:
        for corner in range(3):
            here, there = vertices[face[corner]], vertices[face[(corner + 1) % 3]]
            for axis in range(3):
                edges[corner, axis] = there[axis] - here[axis]
            lengths[corner] = np.sqrt(edges[corner, 0] ** 2 + edges[corner, 1] ** 2 + edges[corner, 2] ** 2)
        x = edges[0, 1] * edges[1, 2] - edges[0, 2] * edges[1, 1]
        y = edges[0, 2] * edges[1, 0] - edges[0, 0] * edges[1, 2]
        z = edges[0, 0] * edges[1, 1] - edges[0, 1] * edges[1, 0]
        area = np.sqrt(x * x + y * y + z * z)
        if not area > 0.0:
            continue
        kept[count] = face
        normals[count, 0], normals[count, 1], normals[count, 2] = x / area, y / area, z / area
        for corner in range(3):
            before = (corner + 2) % 3
            cosine = -(
                edges[corner, 0] * edges[before, 0]
                + edges[corner, 1] * edges[before, 1]
                + edges[corner, 2] * edges[before, 2]
            ) / (lengths[corner] * lengths[before])
            angles[count, corner] = np.arccos(min(1.0, max(-1.0, cosine)))
        count += 1
    return kept[:count].copy(), normals[:count].copy(), angles[:count].copy()


@kernel()
def _corners_by_vertex(faces: IntArray, vertices: int) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Every corner, by its vertex and then by its number; and where those of each vertex begin."""
    starts = np.zeros(vertices + 1, np.int64)
    corners = faces.ravel()
    for vertex in corners:
        starts[vertex + 1] += 1
    starts = np.cumsum(starts)
    place = starts.copy()
    found = np.empty(len(corners), np.int64)
    for corner in range(len(corners)):
        found[place[corners[corner]]] = corner
        place[corners[corner]] += 1
    return found, starts


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
