"""Preparing: an even, faithful, normalised mesh."""

from __future__ import annotations

import sys

import numpy as np
import pytest
import trimesh
from solids import ball, from_trimesh, rotation, sheet

from shapeviz_report.errors import MeshError
from shapeviz_report.mesh import collect_files, deviation, normalise, prepare, remesh
from shapeviz_report.mesh.remesh import MAX_VERTICES, affordable_edge_length, surface_size
from shapeviz_report.types import Mesh


def edge_lengths(mesh: Mesh) -> np.ndarray:
    pairs = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    return np.linalg.norm(mesh.vertices[pairs[:, 0]] - mesh.vertices[pairs[:, 1]], axis=1)


def diagonal(mesh: Mesh) -> float:
    return float(np.linalg.norm(np.ptp(mesh.vertices, axis=0)))


@pytest.mark.parametrize("subdivisions", [2, 6])
def test_remeshing_gives_even_edges_of_the_wanted_length(subdivisions) -> None:
    coarse = ball(subdivisions)
    result = remesh(coarse, 0.07)
    lengths = edge_lengths(result)
    assert lengths.mean() == pytest.approx(0.07, rel=0.1)
    assert lengths.std() < 0.25 * lengths.mean()
    assert deviation(coarse, result) < 0.01


def test_the_size_of_a_shape() -> None:
    # The surface of a ball of radius 2 lies 2 from its centroid.
    assert surface_size(Mesh(2 * ball(5).vertices, ball(5).faces)) == pytest.approx(8, rel=1e-3)
    # Faces of a cube of side 1: the squared distance from the centre is 1/4 + 2/12 on average.
    cube = from_trimesh(trimesh.creation.box())
    assert surface_size(cube) == pytest.approx(4 * (1 / 4 + 2 / 12) ** 0.5)
    finer = from_trimesh(trimesh.creation.box().subdivide().subdivide())
    moved = Mesh(finer.vertices @ rotation(5).T + 3, finer.faces)
    assert surface_size(moved) == pytest.approx(surface_size(cube))


def test_edges_are_as_long_however_a_shape_is_turned(tmp_path) -> None:
    rod = trimesh.creation.box(extents=(6, 1, 1))
    lengths = []
    for name, turn in (("upright", np.eye(3)), ("turned", rotation(5))):
        trimesh.Trimesh(rod.vertices @ turn.T, rod.faces).export(tmp_path / f"{name}.off")
        lengths.append(edge_lengths(prepare(collect_files(tmp_path / f"{name}.off"), 0.02)[0]).mean())
    assert lengths[1] == pytest.approx(lengths[0], rel=0.01)


def test_prepared_file(tmp_path) -> None:
    box = trimesh.creation.box(extents=(3, 2, 1))
    path = tmp_path / "box.ply"
    box.apply_translation([100, 0, 0]).export(path)
    mesh, facts = prepare(collect_files(path), 0.02)
    assert np.abs(mesh.vertices).max() <= 1
    assert np.linalg.norm(mesh.vertices, axis=1).max() == pytest.approx(1)
    assert mesh.vertices.mean(axis=0) == pytest.approx(0, abs=1e-9)
    assert mesh.faces.dtype == np.int32
    assert (facts.faces_read, facts.watertight, facts.components) == (12, True, 1)
    assert facts.faces == len(mesh.faces)
    assert facts.deviation < 0.01
    assert (facts.area, facts.volume) == (pytest.approx(22), pytest.approx(6))
    assert facts.extents == pytest.approx((3, 2, 1))
    # Its sharp edges survive: the corners of the box are where they were.
    corners = np.array(np.meshgrid([-1.5, 1.5], [-1, 1], [-0.5, 0.5])).reshape(3, -1).T
    scale = np.linalg.norm(corners[0])
    gaps = np.linalg.norm(mesh.vertices[:, None] - corners / scale, axis=2).min(axis=0)
    assert gaps.max() < 0.03


def test_an_open_surface_has_no_volume(tmp_path) -> None:
    path = tmp_path / "lid.off"
    trimesh.Trimesh([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]).export(path)
    _, facts = prepare(collect_files(path), 0.03)
    assert (facts.watertight, facts.volume) == (False, None)
    assert (facts.area, facts.extents) == (pytest.approx(2), pytest.approx((2, 1, 0)))


def test_a_volume_out_of_range_is_unknown(tmp_path) -> None:
    box = trimesh.creation.box(extents=(3, 2, 1))
    lines = [
        *("v {}e120 {}e120 {}e120".format(*v) for v in box.vertices),
        *("f {} {} {}".format(*f) for f in box.faces + 1),
    ]
    path = tmp_path / "huge.obj"
    path.write_text("\n".join(lines))
    _, facts = prepare(collect_files(path), 0.02)
    assert (facts.volume, facts.area) == (None, pytest.approx(22e240))


def test_preparing_is_deterministic(tmp_path) -> None:
    path = tmp_path / "a.off"
    trimesh.creation.torus(0.7, 0.3).export(path)
    (first, _), (second, _) = prepare(collect_files(path), 0.03), prepare(collect_files(path), 0.03)
    assert (first.vertices == second.vertices).all()
    assert (first.faces == second.faces).all()


def test_scale_does_not_depend_on_orientation() -> None:
    mesh = from_trimesh(trimesh.creation.box(extents=(3, 2, 1)).subdivide())
    turned = Mesh(mesh.vertices @ rotation(3).T * 7 + 2, mesh.faces)
    assert normalise(turned).vertices == pytest.approx(normalise(mesh).vertices @ rotation(3).T)


def test_deviation_sees_a_lost_limb() -> None:
    body = ball(3)
    limb = from_trimesh(trimesh.creation.icosphere(2, radius=0.1).apply_translation([2, 0, 0]))
    both = Mesh(
        np.concatenate([body.vertices, limb.vertices]),
        np.concatenate([body.faces, limb.faces + len(body.vertices)]),
    )
    assert deviation(both, body) == pytest.approx(1.1 / diagonal(both), rel=0.02)
    assert deviation(body, both) == pytest.approx(1.1 / diagonal(body), rel=0.02)
    assert deviation(both, both) < 1e-9


@pytest.mark.parametrize("axes", [(0, 1, 2), (2, 0, 1), (1, 2, 0)])
def test_deviation_to_faces_without_area_is_that_to_their_lines_and_points(axes) -> None:
    plain = sheet(5)
    along = np.array([[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [0.25, 0.0, 0.5]])
    count = len(plain.vertices)
    # A line half above the sheet, its corners in every order, and a point at its end.
    lines = np.array([[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [0, 0, 0]], np.int32) + count
    both = Mesh(np.concatenate([plain.vertices, along])[:, axes], np.concatenate([plain.faces, lines]))
    plain = Mesh(plain.vertices[:, axes], plain.faces)
    assert deviation(both, plain) * diagonal(both) == pytest.approx(0.5)
    assert deviation(plain, both) * diagonal(plain) == pytest.approx(0.5)
    line = Mesh(along[:, axes], lines - count)
    assert deviation(line, line) == pytest.approx(0, abs=1e-12)


def test_flat_sheet_is_prepared(tmp_path) -> None:
    path = tmp_path / "sheet.off"
    trimesh.Trimesh(sheet(3).vertices, sheet(3).faces).export(path)
    mesh, facts = prepare(collect_files(path), 0.05)
    assert not facts.watertight
    assert mesh.vertices[:, 2] == pytest.approx(0, abs=1e-9)


def test_a_surface_stacked_many_times_over_gets_longer_edges() -> None:
    assert affordable_edge_length(ball(3), 0.04) == 0.04
    layer = sheet(2)
    book = Mesh(
        np.concatenate([layer.vertices + np.array([0, 0, i * 1e-4]) for i in range(1000)]),
        np.concatenate([layer.faces + 4 * i for i in range(1000)]).astype(np.int32),
    )
    length = affordable_edge_length(book, 0.01)
    # 1000 leaves of area 1 with rims of 4; a vertex has sqrt(3) / 2 squared edges.
    expected = 1.1 * 1000 / (length**2 * 3**0.5 / 2) + 1.4 * 4000 / length
    assert expected == pytest.approx(MAX_VERTICES, rel=1e-6)
    assert affordable_edge_length(book, 0.01, 4 * MAX_VERTICES) < length


def test_ridges_and_rims_take_vertices_too() -> None:
    """About as many as are foretold: of a lattice of sticks, narrower than an edge, nearly all lie on ridges."""
    sticks = [
        trimesh.creation.box(extents=np.roll((3, 0.02, 0.02), axis)).apply_translation(
            np.roll((0, i / 4, j / 4), axis)
        )
        for axis in range(3)
        for i in range(6)
        for j in range(6)
    ]
    mesh = from_trimesh(trimesh.util.concatenate(sticks))
    length = affordable_edge_length(mesh, 0.001)
    assert length > 0.03
    assert MAX_VERTICES / 1.5 < len(remesh(mesh, length).vertices) < 1.5 * MAX_VERTICES


def test_parts_without_number_are_refused(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr(sys.modules["shapeviz_report.mesh.prepare"], "MAX_PARTS", 3)
    path = tmp_path / "parts.stl"
    small = [trimesh.creation.box().apply_translation([3 * i, 0, 0]) for i in range(4)]
    trimesh.util.concatenate(small).export(path)
    with pytest.raises(MeshError, match="4 parts that share no vertices, more than 3; join"):
        prepare(collect_files(path), 0.05)


def test_a_coarse_solid_is_not_rounded_away(tmp_path) -> None:
    """The faces of an icosahedron meet at 42 degrees, less than a ridge: as a round surface it would move by 5.8 %."""
    path = tmp_path / "icosahedron.off"
    trimesh.creation.icosahedron().export(path)
    mesh, facts = prepare(collect_files(path), 0.02)
    assert facts.deviation < 0.001
    assert facts.repairs == {"flat creases kept, for rounding them moved the surface": 1}
    # Its twelve corners are the farthest from its middle, and all of them are there.
    corners = mesh.vertices[np.linalg.norm(mesh.vertices, axis=1) > 0.995]
    assert len(corners) == 12
    sides = np.linalg.norm(corners[:, None] - corners, axis=2)
    assert np.sort(sides, axis=1)[:, 1:6] == pytest.approx(1.05146, abs=5e-3)


def test_parts_thinner_than_edges_get_shorter_edges(tmp_path, monkeypatch) -> None:
    path = tmp_path / "coil.off"
    place = np.linspace(0, 12 * np.pi, 600)
    coil = np.stack([np.cos(place), np.sin(place), place / 100], axis=1)
    corners = np.concatenate([coil, coil + np.array([0, 0, 0.02])])
    number = np.arange(599)
    one, other = (
        np.stack([number, number + 1, number + 600]),
        np.stack([number + 1, number + 601, number + 600]),
    )
    trimesh.Trimesh(corners, np.concatenate([one, other], axis=1).T, process=False).export(path)
    coarse, facts = prepare(collect_files(path), 0.2)
    monkeypatch.setattr(sys.modules["shapeviz_report.mesh.prepare"], "MAX_DEVIATION", facts.deviation / 3)
    finer, fitting = prepare(collect_files(path), 0.2)
    assert fitting.repairs["edges shortened, for parts are thinner"] == 1
    assert fitting.deviation <= facts.deviation / 3
    assert len(finer.vertices) > len(coarse.vertices)
    monkeypatch.setattr(sys.modules["shapeviz_report.mesh.prepare"], "MAX_DEVIATION", 0)
    with pytest.raises(MeshError, match="more than 0%"):
        prepare(collect_files(path), 0.2)


@pytest.mark.parametrize("name", ["wire", "blades", "fence", "crossed sheets", "needle with a ball"])
def test_thin_shapes_stay_where_they_are(name, tmp_path) -> None:
    box = trimesh.creation.box
    blade = np.array([[0, 0, 0], [1, 0, 0.02], [1, 0.01, 0]])
    parts = {
        "wire": [box((1, 1e-5, 1e-5))],
        "blades": [trimesh.Trimesh(blade @ rotation(seed).T, [[0, 1, 2]]) for seed in range(8)],
        "fence": [box((0.002, 0.002, 1)).apply_translation([i / 10, 0, 0]) for i in range(12)],
        "crossed sheets": [box(np.roll((1, 1, 0.001), axis)) for axis in range(3)],
        "needle with a ball": [
            trimesh.creation.icosphere(3, radius=0.2),
            trimesh.creation.cone(0.004, 3, sections=6),
        ],
    }[name]
    path = tmp_path / "thin.stl"
    trimesh.util.concatenate(parts).export(path)
    mesh, facts = prepare(collect_files(path), 0.01)
    assert facts.deviation < 0.002
    assert facts.components == len(parts)
    assert len(mesh.vertices) < 1.5 * MAX_VERTICES


def test_specks_are_refused_with_a_reason() -> None:
    specks = [ball(0).vertices * 1e-5 + place for place in np.eye(3)]
    faces = np.concatenate([ball(0).faces + 12 * i for i in range(3)])
    with pytest.raises(MeshError, match="specks"):
        remesh(Mesh(np.concatenate(specks), faces), 0.02)


def test_needles_that_have_no_area_get_longer_edges() -> None:
    """Each a tenth of the shape long: at the wanted length they would take a million vertices."""
    random = np.random.default_rng(0)
    starts, ways = random.random((50_000, 3)), random.normal(size=(50_000, 3)) / 20
    corners = np.stack([starts, starts + ways, starts + ways + 1e-6], axis=1)
    needles = Mesh(corners.reshape(-1, 3), np.arange(150_000, dtype=np.int32).reshape(-1, 3))
    rim = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).sum()
    length = affordable_edge_length(needles, 0.001)
    assert length == pytest.approx(1.4 * rim / MAX_VERTICES, rel=1e-3)
    assert affordable_edge_length(needles, 2 * length) == 2 * length
