"""The modelling kit: solids have the shape their functions promise, and every surface is a 2-manifold."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from shapeviz_report.demo.solids import (
    GUARD,
    MATRIX,
    Solid,
    attach,
    ball,
    blade,
    blend,
    box,
    carve,
    cone,
    ellipsoid,
    extrude,
    frame,
    loop,
    revolve,
    spline,
    tube,
    turn,
    unite,
)
from shapeviz_report.demo.surface_nets import MOST_FACES, _compose_well, _crossings, _distances, mesh_solid
from shapeviz_report.types import IntArray, Mesh


def volume(mesh: Mesh) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def assert_closed_manifold(faces: IntArray) -> None:
    """Every edge has two faces that run it in opposite directions, and every vertex one fan of faces."""
    starts, ends = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
    runs = set(zip(starts.tolist(), ends.tolist(), strict=True))
    assert len(runs) == faces.size, "an edge runs the same way twice"
    assert runs == {(b, a) for a, b in runs}, "an edge has one face only"
    # Corners of faces that meet at an edge belong to one fan at each of its ends.
    corners = np.arange(faces.size).reshape(faces.shape)
    at = {}
    for face, own in zip(faces.tolist(), corners.tolist(), strict=True):
        for k in range(len(face)):
            after = (k + 1) % len(face)
            at[face[k], face[after]] = own[k], own[after]
    pairs = [(x, y) for (a, b), (u, v) in at.items() for x, y in ((u, at[b, a][1]), (v, at[b, a][0]))]
    rows, columns = np.array(pairs).T
    fans, _ = connected_components(coo_array((np.ones(len(rows)), (rows, columns)), shape=(faces.size,) * 2))
    assert fans == len(np.unique(faces)), "faces meet at a vertex but not along edges"


SQUARE = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * 0.5
STADIUM_AREA, STADIUM_PERIMETER = 2 * 0.8 + np.pi * 0.16, 4 + np.pi * 0.8


@pytest.mark.parametrize(
    ("solid", "expected"),
    [
        pytest.param(ball((1, 2, 3), 1.0), 4 / 3 * np.pi, id="ball"),
        pytest.param(
            ellipsoid((0, 0, 0), (1, 0.6, 0.4), turn((1, 2, 3), 40)), 4 / 3 * np.pi * 0.24, id="ellipsoid"
        ),
        pytest.param(
            cone((0, 0, 0), (2, 0, 0), 0.5, 0.5), np.pi * 0.25 * 2 + 4 / 3 * np.pi * 0.125, id="capsule"
        ),
        pytest.param(
            cone((0, 0, 0), (0, 0, 0.1), 0.5, 0.2),
            4 / 3 * np.pi * 0.125,
            id="cone with one ball in the other",
        ),
        pytest.param(
            cone((0, 0, 0), (2, 0, 0), 0.5, 0.5, 0.4, (0, 1, 0)),
            0.4 * (np.pi * 0.25 * 2 + 4 / 3 * np.pi * 0.125),
            id="squashed capsule",
        ),
        pytest.param(box((0, 1, 0), (0.5, 0.4, 0.3), 0.0, turn((0, 0, 1), 30)), 8 * 0.06, id="box"),
        pytest.param(extrude(SQUARE, 0.25, 0.0, axes=frame((1, 1, 0))), 0.5, id="extrusion"),
        pytest.param(revolve([(0, 0), (0.5, 0), (0.5, 1), (0, 1)]), np.pi / 4, id="revolution"),
        # Steiner's formula for a plane convex set with a ball of radius 0.1 around each point.
        pytest.param(
            blade([(0, 0, 0), (2, 0, 0)], [0.5, 0.5], 0.1, (0, 0, 1)),
            0.2 * STADIUM_AREA + np.pi / 2 * 0.01 * STADIUM_PERIMETER + 4 / 3 * np.pi * 0.001,
            id="blade",
        ),
        pytest.param(
            carve(ball((0, 0, 0), 1.0), box((0, 0, 1), (2, 2, 1), 0.0)), 2 / 3 * np.pi, id="half a ball"
        ),
        # Three balls less the two lenses that they share.
        pytest.param(
            unite(ball((0, 0, 0), 0.5), ball((0.9, 0, 0), 0.5), ball((1.8, 0, 0), 0.5)),
            4 * np.pi * 0.125 - 2 * np.pi * 2.9 * 0.01 / 12,
            id="three balls",
        ),
        # Pappus: the area of the section times the way of its centre.
        pytest.param(
            loop([(np.cos(t), np.sin(t), 0) for t in np.linspace(0, 2 * np.pi, 90)[:-1]], 0.2),
            np.pi * 0.04 * 2 * np.pi,
            id="torus",
        ),
    ],
)
def test_volumes_are_those_of_the_solids(solid: Solid, expected: float) -> None:
    mesh = mesh_solid(solid)
    assert volume(mesh) == pytest.approx(expected, rel=0.01)
    assert_closed_manifold(mesh.faces)
    # The box around the solid, which guards and grids rely on, is neither too small nor a waste.
    slack = 0.02 * np.linalg.norm(solid.high - solid.low)
    assert (mesh.vertices >= solid.low - slack).all()
    assert (mesh.vertices <= solid.high + slack).all()


def test_vertices_lie_on_the_surface() -> None:
    mesh = mesh_solid(ball((1, 2, 3), 1.0))
    np.testing.assert_allclose(np.linalg.norm(mesh.vertices - [1, 2, 3], axis=1), 1.0, atol=1e-4)


def test_edges_are_even() -> None:
    mesh = mesh_solid(blend(ball((0, 0, 0), 1.0), cone((0, 0, 0), (3, 0, 0), 0.5, 0.2), radius=0.5))
    edges = np.linalg.norm(mesh.vertices[mesh.faces] - mesh.vertices[np.roll(mesh.faces, -1, axis=1)], axis=2)
    assert edges.std() < 0.3 * edges.mean()
    assert edges.min() > 0.25 * edges.mean()


def test_bulky_solids_get_wider_triangles_instead_of_more() -> None:
    bulky, thin = mesh_solid(ball((0, 0, 0), 1.0)), mesh_solid(cone((0, 0, 0), (9, 0, 0), 0.3, 0.3))
    assert MOST_FACES * 0.8 < len(bulky.faces) < MOST_FACES * 1.2
    assert len(thin.faces) < MOST_FACES


def test_blend_fills_the_crease_and_nothing_else() -> None:
    first, second = ball((-0.7, 0, 0), 1.0), ball((0.7, 0, 0), 1.0)
    sharp, smooth = mesh_solid(unite(first, second)), mesh_solid(blend(first, second, radius=0.4))
    assert waist(smooth) > waist(sharp) + 0.03
    np.testing.assert_allclose(np.ptp(smooth.vertices[:, 0]), np.ptp(sharp.vertices[:, 0]), atol=1e-3)


def waist(mesh: Mesh) -> float:
    near = np.abs(mesh.vertices[:, 0]) < 0.03
    return float(np.linalg.norm(mesh.vertices[near, 1:], axis=1).mean())


def is_solid(solid: Solid, point: tuple[float, float, float]) -> bool:
    """Winding number of the surface about the point (Van Oosterom and Strackee 1983)."""
    mesh = mesh_solid(solid)
    a, b, c = (mesh.vertices[mesh.faces[:, i]] - point for i in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c))
    ab, bc, ca = (np.einsum("ij,ij->i", x, y) for x, y in ((a, b), (b, c), (c, a)))
    angles = 2 * np.arctan2(volumes, la * lb * lc + ab * lc + bc * la + ca * lb)
    return angles.sum() > 2 * np.pi


def test_attached_limbs_blend_with_the_body_but_not_with_each_other() -> None:
    body = ball((0, 0, 0), 1.0)
    limbs = [cone((0, y, 0), (0, y, 3), 0.2, 0.2) for y in (-0.3, 0.3)]

    between = (0, 0, 2.0)
    assert is_solid(blend(body, *limbs, radius=0.6), between)
    assert not is_solid(attach(body, *limbs, radius=0.6), between)
    crease = (0.0, 0.55, 0.93)
    assert not is_solid(unite(body, *limbs), crease)
    assert is_solid(attach(body, *limbs, radius=0.6), crease)


def test_guards_only_save_time() -> None:
    rng = np.random.default_rng(3)
    limbs = [tube(rng.normal(size=(4, 3)), rng.uniform(0.1, 0.3, 4), 12) for _ in range(4)]
    solid = carve(attach(ball((0, 0, 0), 0.8), *limbs, radius=0.2), ball((0.5, 0, 0), 0.4), radius=0.1)
    unguarded = solid.rows.copy()
    guards = unguarded[:, 0] == GUARD
    assert guards.sum() > 40
    unguarded[guards, MATRIX : MATRIX + 3] = np.inf  # every point is inside every guard
    points = rng.uniform(-2, 2, size=(4000, 3))
    fast = _distances(points, solid.rows, solid.outlines, 0.3)
    slow = _distances(points, unguarded, solid.outlines, 0.3)
    near = np.abs(slow) < 0.05
    assert near.sum() > 100
    np.testing.assert_array_equal(fast[near], slow[near])
    np.testing.assert_array_equal(np.sign(fast), np.sign(slow))


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), share=st.floats(0.05, 0.95))
def test_any_voxels_become_a_manifold(seed: int, share: float) -> None:
    inside = np.zeros((9, 8, 7), dtype=bool)
    inside[2:-2, 2:-2, 2:-2] = np.random.default_rng(seed).random((5, 4, 3)) < share
    inside[4, 4, 3] = True
    wanted = inside.copy()
    _compose_well(inside)
    assert inside[wanted].all()
    _, vertices, quads = _crossings(inside, np.where(inside, -1.0, 1.0))
    assert_closed_manifold(quads)
    assert len(np.unique(quads)) == len(vertices)


def test_well_composed_voxels_stay_as_they_are() -> None:
    inside = np.zeros((12, 12, 12), dtype=bool)
    inside[3:8, 3:9, 4:9] = True
    wanted = inside.copy()
    _compose_well(inside)
    np.testing.assert_array_equal(inside, wanted)


def test_a_gap_too_narrow_for_the_grid_is_closed() -> None:
    plates = unite(box((0, 0, 0.505), (1, 1, 0.5), 0.0), box((0, 0, -0.505), (1, 1, 0.5), 0.0))
    mesh = mesh_solid(plates)
    assert_closed_manifold(mesh.faces)
    assert volume(mesh) == pytest.approx(8.0, rel=0.03)


def test_a_pocket_inside_is_filled() -> None:
    hollow = carve(ball((0, 0, 0), 1.0), ball((0, 0, 0), 0.5))
    assert volume(mesh_solid(hollow)) == pytest.approx(4 / 3 * np.pi, rel=0.01)


def test_splines_pass_their_points_and_tubes_take_their_radii() -> None:
    points = np.array([[0, 0, 0], [1, 0.5, 0], [2, 0, 0.5], [3, 0, 0]], dtype=float)
    curve = spline(points, 601)
    for point in points:
        assert np.linalg.norm(curve - point, axis=1).min() < 5e-3
    mesh = mesh_solid(tube([(0, 0, 0), (4, 0, 0), (8, 0, 0)], [0.3, 0.8, 0.3], 24))
    around = np.linalg.norm(mesh.vertices[:, 1:], axis=1)
    for x, radius in ((0.0, 0.3), (4.0, 0.8), (8.0, 0.3)):
        assert around[np.abs(mesh.vertices[:, 0] - x) < 0.1].mean() == pytest.approx(radius, rel=0.08)


def test_frames_are_rotations() -> None:
    for axes in (frame((1, 2, 3)), frame((1, 0, 0)), frame((0, 0, -2), (0, 0, 1)), turn((3, 1, 2), 77)):
        np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(axes) == pytest.approx(1.0)
    np.testing.assert_allclose(turn((0, 0, 1), 90) @ [1, 0, 0], [0, 1, 0], atol=1e-12)
