"""The view: upright, three-quarter, and from where there is most to see."""

from __future__ import annotations

import conformance.collada
import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from shapeviz_report.building.stages import prepare_shape, read_array, view_shape
from shapeviz_report.render.viewpoint import choose_view
from shapeviz_report.types import Mesh

Y_UP = np.eye(3)
Z_UP = Rotation.from_euler("x", 90, degrees=True).as_matrix()  # turns y to z


def box(extents: tuple[float, float, float], centre: tuple[float, float, float]) -> trimesh.Trimesh:
    shape = trimesh.creation.box(extents=extents)
    shape.apply_translation(centre)
    return shape


def legs(height: float) -> list[trimesh.Trimesh]:
    return [box((0.12, height, 0.12), (x, height / 2, z)) for x in (-0.45, 0.45) for z in (-0.45, 0.45)]


def table() -> list[trimesh.Trimesh]:
    return [box((1.6, 0.08, 1.0), (0, 0.9, 0)), *legs(0.86)]


def chair() -> list[trimesh.Trimesh]:
    """Its back is at -z: it faces +z."""
    return [box((1.0, 0.08, 1.0), (0, 0.9, 0)), *legs(0.86), box((1.0, 1.0, 0.08), (0, 1.4, -0.46))]


def person() -> list[trimesh.Trimesh]:
    return [
        trimesh.creation.icosphere(radius=0.13).apply_translation((0, 1.65, 0)),
        box((0.4, 0.65, 0.2), (0, 1.2, 0)),
        box((1.6, 0.1, 0.1), (0, 1.45, 0)),
        *(box((0.15, 0.9, 0.15), (x, 0.45, 0)) for x in (-0.12, 0.12)),
        *(box((0.13, 0.06, 0.3), (x, 0.03, 0.06)) for x in (-0.12, 0.12)),
    ]


def assemble(parts: list[trimesh.Trimesh], rotation: np.ndarray) -> Mesh:
    whole = trimesh.util.concatenate(parts)
    vertices = np.asarray(whole.vertices) - whole.bounds.mean(axis=0)
    return Mesh(vertices @ rotation.T, np.asarray(whole.faces, np.int32))


def angle_between(first: np.ndarray, second: np.ndarray) -> float:
    return float(np.degrees(np.arccos(np.clip(first @ second, -1.0, 1.0))))


@pytest.mark.parametrize("make", [table, chair, person])
@pytest.mark.parametrize("rotation", [Y_UP, Z_UP], ids=["y up", "z up"])
def test_the_file_is_believed_where_the_shape_stands(make, rotation: np.ndarray):
    view = choose_view(assemble(make(), rotation))
    assert angle_between(view[1], rotation @ [0, 1, 0]) < 50
    assert view[2] @ rotation @ [0, 1, 0] > 0, "seen from above"
    assert abs(view[0] @ rotation @ [0, 1, 0]) < 1e-9, "does not lean to a side"


@pytest.mark.parametrize(("up", "axis"), [("y", 1), ("z", 2)])
def test_an_axis_that_is_known_to_point_up_is_not_doubted(up: str, axis: int):
    lying = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    view = choose_view(assemble(table(), lying), up)
    assert view[0, axis] == pytest.approx(0.0, abs=1e-9)
    assert view[1, axis] > 0.5


@pytest.mark.parametrize("seed", range(4))
def test_a_table_in_any_pose_is_put_on_its_legs(seed: int):
    rotation = Rotation.random(random_state=seed).as_matrix()
    view = choose_view(assemble(table(), rotation))
    assert angle_between(view[1], rotation @ [0, 1, 0]) < 50


def test_a_chair_is_seen_from_the_front_at_three_quarters():
    view = choose_view(assemble(chair(), Y_UP))
    level = view[2] * [1, 0, 1]
    assert view[2, 2] > 0
    assert 30 < angle_between(level / np.linalg.norm(level), np.array([0, 0, 1])) < 60


def test_a_flat_shape_is_seen_from_higher_than_a_tall_one():
    slab = choose_view(assemble([box((2, 0.1, 1), (0, 0, 0)), box((0.2, 0.1, 0.2), (0.5, 0.1, 0.2))], Y_UP))
    tower = choose_view(assemble([box((0.6, 2, 0.5), (0, 0, 0)), box((0.2, 0.4, 0.2), (0, 1.1, 0.1))], Y_UP))
    assert slab[2, 1] > tower[2, 1] + 0.3


@pytest.mark.parametrize(
    "mesh",
    [
        Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float64), np.array([[0, 1, 2]], np.int32)),
        assemble([trimesh.creation.icosphere(subdivisions=2)], Y_UP),
        assemble([trimesh.creation.box()], Y_UP),
    ],
    ids=["one triangle", "sphere", "cube"],
)
def test_any_shape_has_a_view(mesh: Mesh):
    view = choose_view(mesh)
    np.testing.assert_allclose(view @ view.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(view) == pytest.approx(1.0)


def test_a_flat_sheet_is_not_seen_on_edge():
    for normal in range(3):
        extents = [2.0, 1.4, 1.0]
        extents[normal] = 0.0
        corners = (
            np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * np.array(extents) / 2
        )
        corners = np.unique(corners, axis=0)
        view = choose_view(Mesh(corners, np.array([[0, 1, 2], [1, 3, 2]], np.int32)))
        assert abs(view[2, normal]) > 0.5


def test_neither_tessellation_nor_order_of_faces_turns_the_shape():
    mesh = assemble(chair(), Y_UP)
    finer = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False).subdivide().subdivide()
    shuffled = np.random.default_rng(0).permutation(finer.faces)
    view = choose_view(Mesh(np.asarray(finer.vertices), shuffled.astype(np.int32)))
    np.testing.assert_allclose(view, choose_view(mesh), atol=1e-6)


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_file_says_what_is_up_unless_the_builder_does(axis):
    box = conformance.collada.document(asset=f"<up_axis>{axis.upper()}_UP</up_axis>")
    prepared = prepare_shape({"box.dae": box}, 0.1)
    for wanted, given in ((axis, None), ("z", "z")):
        view = read_array(view_shape(prepared, given))
        upward = view[:, "xyz".index(wanted)]
        assert upward[0] == pytest.approx(0, abs=1e-9)
        assert upward[1] > 0.5
