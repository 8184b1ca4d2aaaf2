"""Turned edges: better faces on the same surface."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from solids import ball, from_trimesh

from shapeviz_report.mesh import deviation
from shapeviz_report.mesh.flips import find_twins, flip_edges
from shapeviz_report.types import Mesh


def least_angles(mesh: Mesh) -> np.ndarray:
    corners = mesh.vertices[mesh.faces]
    sides = np.roll(corners, -1, axis=1) - corners
    sides /= np.linalg.norm(sides, axis=2, keepdims=True)
    cosines = -np.einsum("fcx,fcx->fc", sides, np.roll(sides, 1, axis=1))
    return np.degrees(np.arccos(cosines.clip(-1, 1))).min(axis=1)


def area(mesh: Mesh) -> float:
    return float(trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).area)


def scattered(seed: int) -> Mesh:
    """A square of random points in slivers: each point is joined to what lay around it, a corner of a face at first."""
    random = np.random.default_rng(seed)
    vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
    faces = [(0, 1, 2), (0, 2, 3)]
    for _ in range(300):
        a, b, c = faces.pop(random.integers(len(faces)))
        weights = random.dirichlet((1, 1, 1))
        vertices.append(list(weights @ np.array([vertices[a], vertices[b], vertices[c]])))
        new = len(vertices) - 1
        faces += [(a, b, new), (b, c, new), (c, a, new)]
    return Mesh(np.array(vertices), np.array(faces, np.int32))


@pytest.mark.parametrize("seed", range(5))
def test_slivers_become_good_faces(seed) -> None:
    before = scattered(seed)
    after = flip_edges(before)
    assert (after.vertices == before.vertices).all()
    assert area(after) == pytest.approx(area(before))
    assert np.median(least_angles(after)) > 2 * np.median(least_angles(before))
    # Still a sheet: faces agree on the winding, and the rim is the four sides.
    assert (find_twins(after.faces, len(after.vertices)) < 0).sum() == 4
    assert len(np.unique(np.sort(after.faces, axis=1), axis=0)) == len(before.faces)
    assert (flip_edges(after).faces == after.faces).all()


def test_ridges_stay() -> None:
    box = from_trimesh(trimesh.creation.box((1, 1, 0.01)))
    after = flip_edges(box)
    assert deviation(box, after) < 1e-12
    assert area(after) == pytest.approx(2.04)


def test_a_tetrahedron_has_no_edge_to_turn() -> None:
    """Each edge that could take the place of another is there already."""
    flat = Mesh(
        np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 0.1, 0], [0.5, -0.1, 0.001]]),
        np.array([[0, 1, 2], [1, 0, 3], [0, 2, 3], [2, 1, 3]], np.int32),
    )
    assert (np.sort(flip_edges(flat).faces) == np.sort(flat.faces)).all()


def test_a_round_surface_keeps_its_faces() -> None:
    even = ball(4)
    assert (flip_edges(even).faces == even.faces).all()
