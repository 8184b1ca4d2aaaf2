"""Cleaning: what comes out is an oriented 2-manifold, whatever goes in."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from solids import ball, sheet

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.clean import clean, count_components, is_watertight
from shapeviz_report.types import Mesh


def volume(mesh: Mesh) -> float:
    """In units of the cubed diagonal."""
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    diagonal = np.linalg.norm(np.ptp(mesh.vertices, axis=0))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 / diagonal**3)


def assert_manifold(mesh: Mesh) -> None:
    """Every edge has one or two faces, which agree on the winding, and every vertex one fan of faces."""
    starts, ends = mesh.faces.ravel(), np.roll(mesh.faces, -1, axis=1).ravel()
    _, counts = np.unique(np.stack([starts, ends], axis=1), axis=0, return_counts=True)
    assert (counts == 1).all(), "an edge runs the same way in two faces"
    for vertex in range(len(mesh.vertices)):
        fan = mesh.faces[(mesh.faces == vertex).any(axis=1)]
        rim = [tuple(np.roll(face, -int(np.argmax(face == vertex)))[1:]) for face in fan]
        # The faces around a vertex form one chain: their rim edges are connected.
        reached, frontier = {0}, [0]
        while frontier:
            here = frontier.pop()
            for other in range(len(rim)):
                if other not in reached and set(rim[here]) & set(rim[other]):
                    reached.add(other)
                    frontier.append(other)
        assert len(reached) == len(rim)
    assert np.unique(mesh.faces).tolist() == list(range(len(mesh.vertices)))


def soup(mesh: Mesh) -> Mesh:
    """The same triangles, each with vertices of its own."""
    return Mesh(
        mesh.vertices[mesh.faces].reshape(-1, 3),
        np.arange(3 * len(mesh.faces), dtype=np.int32).reshape(-1, 3),
    )


def test_a_clean_mesh_stays_as_it_is() -> None:
    mesh, repairs = clean(ball(2))
    assert repairs == {}
    assert is_watertight(mesh.faces)
    assert volume(mesh) == pytest.approx(volume(ball(2)))
    assert len(mesh.vertices) == len(ball(2).vertices)


def test_a_soup_is_welded() -> None:
    mesh, repairs = clean(soup(ball(2)))
    assert is_watertight(mesh.faces)
    assert len(mesh.vertices) == len(ball(2).vertices)
    assert repairs == {"vertices welded": 3 * len(ball(2).faces) - len(ball(2).vertices)}


def test_mixed_winding_is_made_outward() -> None:
    mesh = ball(2)
    turned = mesh.faces.copy()
    flipped = np.random.default_rng(0).random(len(turned)) < 0.6
    turned[flipped] = turned[flipped][:, ::-1]
    mended, repairs = clean(Mesh(mesh.vertices, turned))
    assert volume(mended) == pytest.approx(volume(mesh))
    assert repairs == {"faces turned round": int(flipped.sum())}


def test_an_inside_out_ball_is_turned() -> None:
    mended, _ = clean(Mesh(ball(2).vertices, ball(2).faces[:, ::-1].copy()))
    assert volume(mended) > 0


def test_an_open_sheet_keeps_the_side_it_faces() -> None:
    up, _ = clean(sheet(4))
    down, _ = clean(Mesh(sheet(4).vertices, sheet(4).faces[:, ::-1].copy()))
    for mesh, side in ((up, 1), (down, -1)):
        a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
        assert (np.sign(np.cross(b - a, c - a)[:, 2]) == side).all()


def test_empty_duplicate_and_broken_faces_are_dropped() -> None:
    mesh = ball(1)
    vertices = np.concatenate([mesh.vertices, [[np.nan, 0, 0], [np.inf, 1, 1]]])
    count = len(mesh.vertices)
    faces = np.concatenate(
        [mesh.faces, mesh.faces[:3, [1, 2, 0]], [[0, 0, 1], [0, 1, count], [2, 3, count + 1]]]
    )
    mended, repairs = clean(Mesh(vertices, faces.astype(np.int32)))
    assert repairs == {
        "faces with non-finite coordinates dropped": 2,
        "empty faces dropped": 1,
        "duplicate faces dropped": 3,
    }
    assert len(mended.faces) == len(mesh.faces)


def test_three_walls_on_one_edge_are_cut_apart() -> None:
    vertices = np.array([[0.0, 0, 0], [0, 0, 1], [1, 0, 0], [-1, 1, 0], [-1, -1, 0]])
    faces = np.array([[0, 1, 2], [0, 1, 3], [0, 1, 4]], np.int32)
    mended, repairs = clean(Mesh(vertices, faces))
    assert repairs["edges of more than two faces cut"] == 1
    assert count_components(len(mended.vertices), mended.faces) == 3
    assert_manifold(mended)


def test_balls_that_touch_in_a_point_are_parted() -> None:
    one = ball(1)
    top = int(one.vertices[:, 2].argmax())
    moved = one.vertices * [1, 1, -1] + [0, 0, 2 * one.vertices[top, 2]]
    mended, repairs = clean(
        Mesh(
            np.concatenate([one.vertices, moved]), np.concatenate([one.faces, one.faces + len(one.vertices)])
        )
    )
    assert repairs["touching vertices parted"] == 1
    assert_manifold(mended)


def test_a_moebius_band_is_cut_into_a_two_sided_strip() -> None:
    count = 40
    angle = np.arange(count) * 2 * np.pi / count
    width = 0.3 * np.array([-1, 1])
    radius = 1 + width[None] * np.cos(angle / 2)[:, None]
    vertices = np.stack(
        [
            radius * np.cos(angle)[:, None],
            radius * np.sin(angle)[:, None],
            width[None] * np.sin(angle / 2)[:, None],
        ],
        axis=2,
    ).reshape(-1, 3)
    faces = []
    for i in range(count):
        a, b, c, d = 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3
        if i == count - 1:
            c, d = 1, 0
        faces += [(a, c, b), (b, c, d)]
    mended, repairs = clean(Mesh(vertices, np.array(faces, np.int32)))
    assert repairs["edges of one-sided surfaces cut"] >= 1
    assert_manifold(mended)


@pytest.mark.parametrize(
    ("vertices", "reason"),
    [
        ([[0, 0, 0], [0, 0, 0], [0, 0, 0]], "one point"),
        ([[0, 0, 0], [1, 0, 0], [2, 0, 0]], "area"),
        ([[0, 0, 0], [np.nan, 0, 0], [2, 1, 0]], "finite"),
        ([[1e308, 0, 0], [-1e308, 1e308, 0], [0, -1e308, 1e308]], "exceed"),
        ([[1e15, 0, 0], [1e15, 1, 0], [1e15, 0, 1]], "move it to the origin"),
    ],
)
def test_nothing_left_is_an_error(vertices, reason) -> None:
    with pytest.raises(MeshError, match=reason):
        clean(Mesh(np.array(vertices, float), np.array([[0, 1, 2]], np.int32)))


@pytest.mark.parametrize("size", [1e-310, 1e-200, 1e-18, 1e18, 1e150, 1e307])
def test_size_and_place_do_not_matter(size) -> None:
    # Squares of these sizes are out of range; a denormal has few digits left.
    mended, repairs = clean(Mesh((ball(2).vertices + np.array([5, 0, 0])) * size, ball(2).faces))
    assert repairs == {}
    assert np.linalg.norm(np.ptp(mended.vertices, axis=0)) == pytest.approx(1)
    assert volume(mended) == pytest.approx(volume(ball(2)))


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10**9), st.integers(3, 12), st.integers(1, 40))
def test_random_soups_become_manifold(seed, vertex_count, face_count) -> None:
    random = np.random.default_rng(seed)
    # A coarse grid makes coincident vertices, empty faces and crowded edges likely.
    mesh = Mesh(
        random.integers(0, 4, (vertex_count, 3)).astype(float),
        random.integers(0, vertex_count, (face_count, 3)).astype(np.int32),
    )
    try:
        mended, _ = clean(mesh)
    except MeshError:
        return
    assert_manifold(mended)
