"""Meshes in memory go the way of files, and lose nothing on it."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from solids import lump

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh import parse_mesh
from shapeviz_report.mesh.memory import encode_mesh


def test_every_digit_is_kept() -> None:
    mesh = lump()
    lists = [mesh.vertices.tolist(), mesh.faces.tolist()]
    for given in (mesh, (mesh.vertices, mesh.faces), (np.ma.array(mesh.vertices), mesh.faces), lists):
        read = parse_mesh(encode_mesh(given))
        np.testing.assert_array_equal(read.vertices, mesh.vertices)
        np.testing.assert_array_equal(read.faces, mesh.faces)


def test_what_trimesh_has() -> None:
    ring = trimesh.creation.torus(1, 0.25)
    read = parse_mesh(encode_mesh(ring))
    np.testing.assert_array_equal(read.vertices, ring.vertices)
    scene = trimesh.Scene([ring])
    scene.add_geometry(ring, transform=trimesh.transformations.translation_matrix([3, 0, 0]))
    assert len(parse_mesh(encode_mesh(scene)).faces) == 2 * len(ring.faces)


def test_polygons_are_triangulated() -> None:
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), [[0, 1, 2, 3]]
    assert len(parse_mesh(encode_mesh(square)).faces) == 2


@pytest.mark.parametrize(
    ("mesh", "said"),
    [
        (3, "of type int"),
        (trimesh.PointCloud([[0, 0, 0]]), "of type PointCloud"),
        (np.zeros((4, 3)), "of type ndarray"),
        (([[0, 0]], [[0, 1, 2]]), r"vertices must be an array \(n, 3\), and not \(1, 2\)"),
        (([[0, 0, 0]], [[0.5, 1, 2]]), "faces must be an array"),
        (([[0, 0, 0]], [0, 1, 2]), "faces must be an array"),
        ((np.ma.masked_less(np.eye(3), 1), [[0, 1, 2]]), "masked in part"),
        ((np.eye(3), np.ma.masked_equal([[0, 1, 2], [0, 0, 0]], 0)), "masked in part"),
        (([[0, 0, 1j]], [[0, 1, 2]]), "vertices are complex numbers"),
        ((["a", "b"], [[0, 1, 2]]), "no arrays of numbers"),
    ],
)
def test_what_is_no_mesh(mesh, said) -> None:
    with pytest.raises(MeshError, match=said):
        encode_mesh(mesh)


@pytest.mark.parametrize("faces", [[[0, 1, 3]], [[0, 1, -1]], [[0, 1, 2**40]]])
def test_faces_without_vertices(faces) -> None:
    with pytest.raises(MeshError):
        parse_mesh(encode_mesh(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], faces)))
