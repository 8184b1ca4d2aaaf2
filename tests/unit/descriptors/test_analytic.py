"""Descriptors where their value follows from geometry alone, or from a method that shares nothing with theirs."""

from __future__ import annotations

import numpy as np
import pytest
from solids import ball, lump, sheet, torus

from shapeviz_report.descriptors import DESCRIPTORS, Surface
from shapeviz_report.descriptors.shape_context import SEEN, SHELLS
from shapeviz_report.types import Mesh


def compute(name: str, mesh: Mesh) -> np.ndarray:
    return np.asarray(next(d for d in DESCRIPTORS if d.name == name).compute(Surface(mesh)))


def test_the_outer_half_of_a_torus_bends_like_a_ball() -> None:
    mesh = torus()
    radius = np.hypot(*mesh.vertices[:, :2].T)
    # The two rings at its top and bottom belong half to either side.
    outer = np.where(np.isclose(radius, 0.7), 0.5, radius > 0.7)
    values = compute("Gc", mesh)[:, 0]
    # Gauss and Bonnet: K = cos(t) / (r (R + r cos(t))) integrates to 4 pi, and to -4 pi on the inner half.
    assert outer @ values == pytest.approx(4 * np.pi, rel=0.01)
    assert (1 - outer) @ values == pytest.approx(-4 * np.pi, rel=0.01)


def test_a_torus_is_as_thick_as_its_tube() -> None:
    assert compute("Nd", torus()) == pytest.approx(0.6, rel=0.01)


def test_geodesic_distance_on_a_grid() -> None:
    size = 8
    column, row = np.meshgrid(np.arange(size), np.arange(size))
    across = abs(column.ravel()[:, None] - column.ravel())
    along = abs(row.ravel()[:, None] - row.ravel())
    # With lines across one edge and two, whatever way the diagonals go, there are kings' moves; and rising to the
    # right also knights' moves.
    rising = (column.ravel()[:, None] - column.ravel()) * (row.ravel()[:, None] - row.ravel()) > 0
    more, less = np.maximum(across, along), np.minimum(across, along)
    king = more + (np.sqrt(2) - 1) * less
    knight = np.where(
        2 * less <= more,
        more + (np.sqrt(5) - 2) * less,
        (np.sqrt(5) - np.sqrt(2)) * more + (2 * np.sqrt(2) - np.sqrt(5)) * less,
    )
    steps = np.where(rising, knight, king)
    assert compute("Agd", sheet(size))[:, 0] == pytest.approx(steps.mean(axis=1) / (size - 1))


def test_angles_to_the_axis_of_a_singular_value_decomposition() -> None:
    mesh = lump()
    centred = mesh.vertices - mesh.vertices.mean(axis=0)
    axis = np.linalg.svd(centred)[2][0]
    assert compute("Na", mesh)[:, 0] == pytest.approx(abs(Surface(mesh).normals @ axis), abs=1e-9)
    cosine = abs(centred @ axis) / np.linalg.norm(centred, axis=1)
    assert compute("Pa", mesh)[:, 0] == pytest.approx(cosine, abs=1e-9)


def test_context_of_a_large_mesh_is_that_of_all_its_vertices() -> None:
    fine = ball(5)
    mesh = Mesh(fine.vertices * [1, 0.6, 0.3], fine.faces)
    assert len(mesh.vertices) > 2 * SEEN
    shells = compute("Sc", mesh).reshape(-1, 3, 8).sum(axis=2)
    for v in range(0, len(mesh.vertices), 500):
        distance = np.linalg.norm(np.delete(mesh.vertices, v, axis=0) - mesh.vertices[v], axis=1) / 2
        expected = np.bincount(np.searchsorted(SHELLS, distance), minlength=3) / len(distance)
        assert shells[v] == pytest.approx(expected, abs=0.01)


def test_pairs_on_a_ball_are_told_by_their_distance() -> None:
    mesh = ball(2)
    surface = Surface(mesh)
    near = mesh.vertices[surface.neighbours]
    gap = np.arccos(np.clip(near @ near.transpose(0, 2, 1), -1, 1))
    pairs = ~np.eye(near.shape[1], dtype=bool)
    values = compute("PFH", mesh).reshape(-1, 5, 5, 5)
    # No pair twists (alpha = 0); the normals turn by as much as the points lie apart (theta), against a line
    # that dips by half of it (phi).
    assert values[:, 2].sum(axis=(1, 2)) == pytest.approx(1, abs=1e-5)
    dip = np.floor((1 - np.sin(gap / 2)) * 2.5).astype(int)
    expected = np.stack([(dip[:, pairs] == cell).mean(axis=1) for cell in range(5)], axis=1)
    assert np.ptp(expected, axis=1).min() > 0.1
    assert np.abs(values.sum(axis=(1, 3)) - expected).mean() < 0.01
    turn = np.floor((1 + gap / np.pi) * 2.5).astype(int)
    expected = np.stack([(turn[:, pairs] == cell).mean(axis=1) for cell in range(5)], axis=1)
    assert np.abs(values.sum(axis=(1, 2)) - expected).mean() < 0.01
