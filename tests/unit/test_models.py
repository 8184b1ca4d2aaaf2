"""3D models: simpler, in the same place, and read back from their bytes."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from packed_models import unpack
from solids import ball, lump, sheet, tube

from shapeviz_report.models import POSITION_STEPS, faces_of_model, pack_model, simplify
from shapeviz_report.types import Mesh


@pytest.mark.parametrize("mesh", [ball(5), tube(), lump()], ids=["ball", "tube", "lump"])
def test_a_model_has_few_faces_and_the_same_surface(mesh: Mesh):
    model = simplify(mesh, 800)
    assert 700 <= len(model.faces) <= 800
    before, after = (trimesh.Trimesh(m.vertices, m.faces, process=False) for m in (mesh, model))
    assert after.area == pytest.approx(before.area, rel=0.02)
    # Wound alike: the signed volume of a closed surface keeps its sign.
    if before.is_watertight:
        assert after.volume == pytest.approx(before.volume, rel=0.03)
    gaps = np.linalg.norm(model.vertices - mesh.vertices[model.source], axis=1)
    assert gaps.max() < 2 * before.edges_unique_length.max()


def test_a_small_mesh_keeps_all_its_faces():
    mesh = sheet(8)
    model = simplify(mesh)
    corners = {tuple(sorted(map(tuple, face))) for face in mesh.vertices[mesh.faces].round(3)}
    assert {tuple(sorted(map(tuple, face))) for face in model.vertices[model.faces].round(3)} == corners
    assert np.abs(model.vertices - mesh.vertices[model.source]).max() <= 0.5 / POSITION_STEPS + 1e-12


def test_what_is_packed_is_read_back():
    model = simplify(lump(), 501)
    bins = np.random.default_rng(0).integers(0, 10, (7, len(model.vertices))).astype(np.uint8)
    view, vertices, faces, read = unpack(pack_model(model, bins, np.eye(3)))
    assert np.array_equal(view, np.eye(3))
    assert np.allclose(vertices, model.vertices, atol=1e-12)
    assert np.array_equal(faces, model.faces)
    assert np.array_equal(read, bins)


def test_colours_come_last_and_only_where_there_are_some():
    model = simplify(ball(4), 200)
    bins = np.zeros((3, len(model.vertices)), np.uint8)
    colors = np.arange(3 * len(model.vertices), dtype=np.uint8).reshape(-1, 3)
    plain = pack_model(model, bins, np.eye(3))
    assert pack_model(model, bins, np.eye(3), colors) == plain + colors.T.tobytes()


def test_separate_triangles_are_not_lost():
    corners = np.random.default_rng(1).normal(size=(300, 3, 3)) * 0.01
    corners += np.random.default_rng(2).uniform(-0.9, 0.9, (300, 1, 3))
    mesh = Mesh(corners.reshape(-1, 3), np.arange(900, dtype=np.int32).reshape(-1, 3))
    model = simplify(mesh, 50)
    assert len(model.faces) > 0
    assert np.isfinite(model.vertices).all()
    assert model.faces.max() < len(model.vertices)


def test_the_same_mesh_gives_the_same_bytes():
    first, second = (simplify(ball(5), 900) for _ in range(2))
    none = np.zeros((0, len(first.vertices)), np.uint8)
    assert pack_model(first, none, np.eye(3)) == pack_model(second, none, np.eye(3))


def test_models_of_many_shapes_weigh_a_third():
    mesh = ball(5)
    one, several = (simplify(mesh, faces_of_model(shapes)) for shapes in (1000, 1001))
    assert len(several.faces) < len(one.faces) / 3
