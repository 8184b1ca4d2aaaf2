"""The 3D model of a shape that a page shows: few faces, and for every vertex its bin in each descriptor dimension."""

from __future__ import annotations

from dataclasses import dataclass

import fast_simplification
import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from shapeviz_report.types import FloatArray, IntArray, Mesh

FACES = 4000
"""Faces of a model: a size at which a limb is still round, and 60 kB."""

MANY, FACES_OF_MANY = 1000, 1100
"""A database of more shapes has models of so many faces: a third of the bytes, and corners show on a large screen."""

AGGRESSIVENESS = 5.0
"""How readily edges collapse: below the library's usual 7, which is quicker and leaves slivers."""

ROUGHNESS = 0.1
"""Noise on the vertices before edges collapse, in edge lengths."""

POSITION_STEPS = 8191
"""Steps of a coordinate from 0 to 1: a fiftieth of an edge, so that shading shows none of them."""


@dataclass(frozen=True)
class Model:
    """A simplified surface, and which vertices of the prepared mesh stand behind its own.

    Attributes
    ----------
    vertices : (v, 3) float64 array
        In the unit ball, on a grid of ``POSITION_STEPS``; neighbours in space lie near each other in the order.
    faces : (f, 3) int32 array
        Wound as in the mesh; sorted.
    source : (v,) int64 array
        The nearest vertex of the prepared mesh: values at a vertex of the model are those of its source.
    """

    vertices: FloatArray
    faces: IntArray
    source: npt.NDArray[np.int64]


def faces_of_model(shapes: int) -> int:
    """Faces of each model in a database of so many shapes."""
    return FACES if shapes <= MANY else FACES_OF_MANY


def simplify(mesh: Mesh, faces: int = FACES) -> Model:
    """Collapse edges until a mesh has ``faces`` faces (quadric error metrics, Garland and Heckbert 1997).

    Parameters
    ----------
    mesh : Mesh
        Prepared.
    faces : int
        To keep at most, at least 4; a mesh of many parts may keep more, for the last faces of a part do not collapse.

    Returns
    -------
    Model
    """
    tree = cKDTree(mesh.vertices, balanced_tree=False, compact_nodes=False)
    vertices, triangles = mesh.vertices, mesh.faces
    if len(triangles) > faces:
        # Edges collapse first where the surface is flat, and leave slivers there along which colours smear. On a rough
        # surface they collapse evenly.
        length = np.linalg.norm(vertices[triangles[:, 0]] - vertices[triangles[:, 1]], axis=1).mean()
        rough = vertices + np.random.default_rng(0).normal(0, ROUGHNESS * length, vertices.shape)
        simpler, kept = fast_simplification.simplify(
            rough.astype(np.float32), triangles, target_count=faces, agg=AGGRESSIVENESS
        )
        # What collapses altogether is better shown in full.
        if len(kept) > 0:
            vertices, triangles = _smoothed(simpler.astype(np.float64), mesh, tree), kept
    positions = np.round(vertices * POSITION_STEPS) / POSITION_STEPS
    order = np.argsort(_along_curve(positions), kind="stable")
    place = np.empty(len(order), np.int32)
    place[order] = np.arange(len(order), dtype=np.int32)
    positions = positions[order]
    return Model(positions, _sorted_faces(place[triangles]), np.asarray(tree.query(positions)[1]))


def pack_model(
    model: Model, bins: npt.NDArray[np.uint8], view: FloatArray, colors: npt.NDArray[np.uint8] | None = None
) -> bytes:
    """A model for the page, to be read by ``site/scripts/viewer/model.js``. Little-endian, one part after the other:

    - uint32: v, f, d, the number of vertices, faces and dimensions
    - float32 (3, 3): the directions that point right, up and to the viewer in the picture of the shape
    - int16 (3, v): coordinates in steps of 1 / ``POSITION_STEPS``
    - int32 (f,): first vertex of each face, as the difference to the face before
    - int32 (2, f): second and third vertex, as the difference to the first
    - uint8 (d, ceil(v / 2)): the bins from 0 in four bits each, the lower four for the earlier vertex
    - uint8 (3, v): the colours, if there are some

    The parts are cut, and the differences taken, for what gzip then makes of them: a third of the bytes.

    Parameters
    ----------
    model : Model
    bins : (d, v) uint8 array
        From 0 to 15.
    view : (3, 3) float array
        As :func:`shapeviz_report.render.choose_view` gives it.
    colors : (v, 3) uint8 array, optional
        sRGB.
    """
    count = len(model.vertices)
    padded = np.pad(bins, ((0, 0), (0, count % 2)))
    first = model.faces[:, 0]
    parts = (
        np.array([count, len(model.faces), len(bins)], "<u4"),
        np.asarray(view, "<f4"),
        np.round(model.vertices.T * POSITION_STEPS).astype("<i2"),
        np.diff(first, prepend=0).astype("<i4"),
        (model.faces[:, 1:] - first[:, None]).T.astype("<i4"),
        padded[:, 0::2] | padded[:, 1::2] << 4,
        np.empty(0, np.uint8) if colors is None else colors.T,
    )
    return b"".join(np.ascontiguousarray(part).tobytes() for part in parts)


def _smoothed(points: FloatArray, mesh: Mesh, tree: cKDTree) -> FloatArray:
    """Points moved onto the plane that touches the mesh at its vertex nearest to each."""
    corners = mesh.vertices[mesh.faces]
    crosses = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.stack(
        [np.bincount(mesh.faces.ravel(), np.repeat(c, 3), len(mesh.vertices)) for c in crosses.T], axis=1
    )
    nearest = tree.query(points)[1]
    normals = normals[nearest]
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    offsets = np.einsum("pa,pa->p", points - mesh.vertices[nearest], normals)
    return points - offsets[:, None] * normals


def _along_curve(positions: FloatArray) -> npt.NDArray[np.uint64]:
    """Places of points in [-1, 1] along a Morton curve of 1024 cells an axis."""
    cells = ((positions + 1) / 2 * 1023).clip(0, 1023).astype(np.uint64)
    place = np.zeros(len(positions), np.uint64)
    for bit in range(10):
        for axis in range(3):
            place |= (cells[:, axis] >> np.uint64(bit) & np.uint64(1)) << np.uint64(3 * bit + axis)
    return place


def _sorted_faces(faces: IntArray) -> IntArray:
    """The same faces, each from its lowest vertex on, in rising order."""
    turned = (faces.argmin(axis=1)[:, None] + np.arange(3)) % 3
    faces = np.take_along_axis(faces, turned, axis=1)
    return np.ascontiguousarray(faces[np.lexsort(faces.T[::-1])], dtype=np.int32)
