"""Every ray of the normal diameter against all faces, on open, flat and axis-aligned surfaces in every orientation."""

from __future__ import annotations

from itertools import permutations, product

import numpy as np
import pytest
from solids import rotation, sheet

from shapeviz_report.descriptors.kernels.rays import cast_inward
from shapeviz_report.descriptors.normal_diameter import SAME_PLACE, compute
from shapeviz_report.descriptors.surface import Surface
from shapeviz_report.mesh.boxes import LEAF, along_curve, box_faces
from shapeviz_report.types import Mesh

ORIENTATIONS = [
    np.eye(3)[list(axes)] * np.array(signs)
    for axes, signs in product(permutations(range(3)), product((1.0, -1.0), repeat=3))
]
"""The 24 turns of a cube and their 24 mirror images."""


def joined(*parts: tuple[np.ndarray, np.ndarray]) -> Mesh:
    offsets = np.cumsum([0, *(len(vertices) for vertices, _ in parts)])
    vertices = np.concatenate([vertices for vertices, _ in parts])
    return Mesh(vertices, np.concatenate([faces + offset for (_, faces), offset in zip(parts, offsets)]))


def flat(size: int, height: float, *, turned: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """An open square in the plane z = height, of ``size`` x ``size`` vertices."""
    mesh = sheet(size)
    vertices = np.column_stack([mesh.vertices[:, :2], np.full(size * size, height)])
    return vertices, mesh.faces[:, ::-1] if turned else mesh.faces


def two_sheets(size: int = 9) -> Mesh:
    """Two parallel sheets 0.2 apart that face away from each other."""
    return joined(flat(size, 0.1), flat(size, -0.1, turned=True))


def crossing() -> Mesh:
    """Sheets that stand on each other: rays run in the planes of faces, and begin on them."""
    upright = flat(5, 0.0)[0][:, [0, 2, 1]], flat(5, 0.0)[1]
    return joined(flat(5, -0.3, turned=True), upright, flat(5, 0.3))


def open_box() -> Mesh:
    """Five sides of a box: every side lies in those of the boxes of the tree."""
    vertices, faces = flat(4, 0.0)
    low, size = vertices.min(axis=0), np.ptp(vertices, axis=0).max()
    base = (vertices - low) / size
    sides = [(base, faces[:, ::-1])]
    for axes in ([0, 2, 1], [2, 0, 1]):
        for place in (0.0, 1.0):
            side = base[:, axes].copy()
            side[:, axes.index(2)] = place
            sides.append((side, faces))
    return joined(*sides)


def all_faces(mesh: Mesh, normals: np.ndarray, rays: np.ndarray) -> np.ndarray:
    """The way of some rays by solving, for each face, three equations."""
    corners = mesh.vertices[mesh.faces]
    way = np.full(len(rays), np.nan)
    for place, v in enumerate(rays):
        sides = corners[:, 1:] - corners[:, :1]
        matrix = np.stack([sides[:, 0], sides[:, 1], np.tile(normals[v], (len(corners), 1))], axis=2)
        open_ = abs(np.linalg.det(matrix)) > 1e-12
        known = np.linalg.solve(matrix[open_], (mesh.vertices[v] - corners[open_, 0])[..., None])[..., 0]
        a, b, t = known.T
        inside = (a > -1e-9) & (b > -1e-9) & (a + b < 1 + 1e-9) & (t > SAME_PLACE)
        inside &= ~(mesh.faces[open_] == v).any(axis=1)
        if inside.any():
            way[place] = t[inside].min()
    return way


def cast(mesh: Mesh, normals: np.ndarray) -> np.ndarray:
    corners = mesh.vertices[mesh.faces]
    order = along_curve(corners.sum(axis=1))
    rays = np.arange(len(mesh.vertices), dtype=np.int32)
    faces, corners = mesh.faces[order].astype(np.int32), corners[order]
    return cast_inward(mesh.vertices, normals, rays, faces, corners, box_faces(corners), LEAF, SAME_PLACE)


SURFACES = {"two sheets": two_sheets, "crossing": crossing, "open box": open_box}


def test_both_sides_of_two_parallel_sheets_are_as_thick() -> None:
    for orientation in ORIENTATIONS:
        mesh = two_sheets()
        faces = mesh.faces if np.linalg.det(orientation) > 0 else mesh.faces[:, ::-1]
        values = compute(Surface(Mesh(mesh.vertices @ orientation.T, faces)))
        assert values == pytest.approx(0.2, abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", SURFACES)
def test_thickness_does_not_depend_on_orientation(name: str) -> None:
    mesh = SURFACES[name]()
    normals = Surface(mesh).normals
    expected = all_faces(mesh, normals, np.arange(len(mesh.vertices)))
    assert np.isfinite(expected).any()
    for turn in [*ORIENTATIONS, *(rotation(seed) for seed in range(5))]:
        turned = Mesh(np.ascontiguousarray(mesh.vertices @ turn.T), mesh.faces)
        assert cast(turned, normals @ turn.T) == pytest.approx(expected, abs=1e-9, nan_ok=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", SURFACES)
def test_rays_along_every_axis_and_diagonal(name: str) -> None:
    """Directions with one, two or no zero among their components, from every vertex: all begin on sides of boxes."""
    mesh = SURFACES[name]()
    directions = np.array([way for way in product((-1.0, -0.0, 0.0, 1.0), repeat=3) if any(way)])
    for direction in directions / np.linalg.norm(directions, axis=1, keepdims=True):
        normals = np.tile(direction, (len(mesh.vertices), 1))
        expected = all_faces(mesh, normals, np.arange(len(mesh.vertices)))
        assert cast(mesh, normals) == pytest.approx(expected, abs=1e-9, nan_ok=True)
