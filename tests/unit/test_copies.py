"""Copies are found whatever was done to them, and shapes that are only alike are none."""

from __future__ import annotations

import fast_simplification
import numpy as np
import pytest
import trimesh
from scipy.spatial.transform import Rotation

from shapeviz_report import copies, demo
from shapeviz_report.copies import (
    NEARLY_DISTANCE,
    Outline,
    Surface,
    compare,
    join_copies,
    outline,
    pair_outlines,
)
from shapeviz_report.mesh import clean, parse_mesh
from shapeviz_report.mesh.closest import find_closest
from shapeviz_report.search.certainty import deal_folds
from shapeviz_report.types import (
    Copy,
    Match,
    Mesh,
    copies_beside,
    copies_of,
    distinct_rows,
    group_copies,
    list_groups,
    representatives,
)

TURN = Rotation.from_rotvec([0.3, -1.1, 0.7]).as_matrix()


def demo_mesh(name: str, index: int) -> Mesh:
    return parse_mesh({"a.off": demo.encode_shape(name, index, 0)})


def changed(mesh: Mesh, how: str) -> Mesh:
    """The mesh as another file may have it."""
    vertices, faces = mesh.vertices, mesh.faces
    random = np.random.default_rng(1)
    if how == "moved and scaled":
        vertices = 1000 * vertices @ TURN.T + [5, -3000, 20]
    elif how == "mirrored":
        vertices, faces = vertices * [-1, 1, 1] @ TURN.T, faces[:, ::-1]
    elif how == "renumbered":
        order = random.permutation(len(vertices))
        vertices, faces = vertices[order], np.argsort(order)[faces][random.permutation(len(faces))]
    elif how == "noise":
        vertices = vertices + 1e-6 * np.ptp(vertices, axis=0).max() * random.standard_normal(vertices.shape)
    elif how == "decimated":
        vertices, faces = fast_simplification.simplify(vertices, faces.astype(np.int64), 0.5)
        vertices = vertices @ TURN.T
    elif how == "refined":
        vertices, faces = trimesh.remesh.subdivide(vertices, faces)
    return Mesh(np.asarray(vertices, float), np.asarray(faces, np.int32))


def match(first: Mesh, second: Mesh) -> Match | None:
    return compare(*(Surface(clean(mesh)[0]) for mesh in (first, second)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("how", "kind", "mirrored"),
    [
        ("moved and scaled", "identical geometry", False),
        ("mirrored", "identical geometry", True),
        ("renumbered", "identical geometry", False),
        ("noise", "identical geometry", False),
        ("decimated", "same surface", False),
        ("refined", "same surface", False),
    ],
)
def test_a_copy_is_found_with_what_was_done_to_it(how: str, kind: str, mirrored: bool) -> None:
    original = demo_mesh("hand", 2)
    found = match(original, changed(original, how))
    assert found is not None
    assert (found.kind, found.mirrored) == (kind, mirrored)


@pytest.mark.parametrize("how", ["moved and scaled", "mirrored", "refined"])
@pytest.mark.parametrize("solid", ["box", "cube", "ring", "sheet", "faceted ball", "prism", "cone"])
def test_symmetric_and_flat_shapes_are_found_too_and_need_no_mirror(solid: str, how: str) -> None:
    made = {
        "box": trimesh.creation.box((2, 3, 4)),
        "cube": trimesh.creation.box((1, 1, 1)),
        "ring": trimesh.creation.torus(1, 0.3, 24, 12),
        "faceted ball": trimesh.creation.icosphere(1),
        "prism": trimesh.creation.cylinder(0.5, 1.3, sections=5),
        "cone": trimesh.creation.cone(0.5, 1.3, sections=7),
        "sheet": trimesh.Trimesh([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]),
    }[solid]
    original = Mesh(np.array(made.vertices, float), np.array(made.faces, np.int32))
    found = match(original, changed(original, how))
    assert found is not None
    assert not found.mirrored


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ant", "chair", "cup", "human", "table", "teddy"])
def test_few_faces_leave_nearly_the_same_surface(name: str) -> None:
    original = demo_mesh(name, 3)
    vertices, faces = fast_simplification.simplify(original.vertices, original.faces.astype(np.int64), 0.9)
    found = match(original, Mesh(np.asarray(vertices, float) @ TURN.T, np.asarray(faces, np.int32)))
    assert found is not None
    assert found.kind in ("same surface", "nearly the same surface")
    assert found.distance < NEARLY_DISTANCE


def test_parts_that_lie_close_are_measured_exactly() -> None:
    """A soup of long thin blades, as models of bicycles are: the nearest face is not that of the nearest sample."""
    random = np.random.default_rng(3)
    middles, along = random.random((400, 3)), random.standard_normal((400, 3))
    blades = middles[:, None] + np.stack(
        [-along / 4, along / 4, along / 4 + 0.004 * random.random((400, 3))], axis=1
    )
    original = Mesh(blades.reshape(-1, 3), np.arange(1200, dtype=np.int32).reshape(-1, 3))
    found = match(original, changed(original, "moved and scaled"))
    assert found is not None
    assert found.kind == "identical geometry"


def test_boxes_of_other_proportions_are_no_copies() -> None:
    boxes = [trimesh.creation.box(size) for size in ((2, 3, 4), (2, 3, 4.2))]
    meshes = [clean(Mesh(np.array(b.vertices, float), np.array(b.faces, np.int32)))[0] for b in boxes]
    assert compare(*map(Surface, meshes)) is None
    outlines = {str(number): Outline(str(number), outline(mesh)) for number, mesh in enumerate(meshes)}
    assert pair_outlines(outlines) == ([], [])


@pytest.mark.slow
def test_shapes_of_a_class_are_no_copies_of_each_other() -> None:
    names = [(name, index) for name in ("cup", "plier", "glasses") for index in range(6)]
    meshes = {f"{name}/{index}": clean(demo_mesh(name, index))[0] for name, index in names}
    certain, possible = pair_outlines({i: Outline(i, outline(mesh)) for i, mesh in meshes.items()})
    assert certain == []
    assert [pair for pair in possible if compare(*(Surface(meshes[i]) for i in pair)) is not None] == []


@pytest.mark.slow
@pytest.mark.parametrize(("name", "first", "second"), [("cup", 0, 22), ("table", 13, 25)])
def test_look_alikes_that_are_no_copies_are_told_apart_by_few_points(
    monkeypatch, name, first, second
) -> None:
    asked = []

    def find(points, *surface):
        asked.append(len(points))
        return find_closest(points, *surface)

    monkeypatch.setattr(copies, "find_closest", find)
    assert match(demo_mesh(name, first), demo_mesh(name, second)) is None
    # a completed fit takes 18,000, and four were
    assert sum(asked) < 40_000


def test_outlines_propose_copies_and_identical_files_need_no_comparison() -> None:
    original = demo_mesh("bird", 1)
    meshes = {
        how: changed(original, how) for how in ("as it is", "mirrored", "decimated", "moved and scaled")
    }
    outlines = {how: Outline(how, outline(clean(mesh)[0])) for how, mesh in meshes.items()}
    outlines["again"] = outlines["as it is"]
    certain, possible = pair_outlines(outlines)
    assert certain == [("as it is", "again")]
    assert len(possible) == 6


def test_groups_follow_chains_of_copies() -> None:
    ids = ["a", "b", "c", "d", "e"]
    found = join_copies([("b", "e")], {("c", "e"): Match("same surface"), ("a", "d"): None}, ids)
    assert [(copy.first, copy.second) for copy in found] == [("b", "e"), ("c", "e")]
    groups = group_copies(found, ids)
    assert groups.tolist() == [0, 1, 1, 2, 1]
    everyone = np.ones(5, bool)
    assert representatives(groups, everyone).tolist() == [0, 1, 3]
    # One with a label stands for those without.
    assert representatives(groups, np.array([True, False, True, True, True])).tolist() == [0, 2, 3]
    assert distinct_rows(groups, everyone).tolist() == [0, 1, 3]
    assert distinct_rows(np.arange(5), everyone) is None
    assert distinct_rows(np.zeros(5, int), everyone) is None
    assert group_copies([Copy("a", "gone", Match("identical file"))], ids).tolist() == [0, 1, 2, 3, 4]


def test_many_equal_shapes_are_one_group_with_the_best_and_the_worst_evidence() -> None:
    ids = [str(number) for number in range(54)]
    same, near = Match("identical file"), Match("same surface", 0.0005, 0.002, mirrored=True)
    found = [Copy(ids[a], ids[b], same) for a in range(52) for b in range(a + 1, min(a + 9, 52))]
    (group,) = list_groups([*found, Copy("gone", "0", same)], ids)
    assert group.shapes == tuple(ids[:52])
    assert group.words == "identical file"
    (group,) = list_groups([*found, Copy("0", "53", near)], ids)
    assert group.shapes == (*ids[:52], "53")
    assert group.words == (
        "from identical file to same surface, 0.05\u00a0% of its size apart (0.2\u00a0% at most), some mirrored"
    )
    assert [group.words for group in list_groups([Copy("1", "2", near)], ids)] == [near.words]


def test_a_distance_below_what_coordinates_say_is_not_spelled_out() -> None:
    assert Match("same surface", 4.1e-7, 2.1e-6).words == (
        "same surface, <0.001\u00a0% of its size apart (<0.001\u00a0% at most)"
    )


def test_each_of_a_pair_says_what_it_is_of_the_other() -> None:
    found = [Copy("a", "b", Match("identical geometry", scale=4.0, mirrored=True))]
    assert [(other, match.words) for other, match in copies_of(copies_beside(found), "a")] == [
        ("b", "identical geometry, mirrored, scaled by 0.25")
    ]
    assert [(other, match.words) for other, match in copies_of(copies_beside(found), "b")] == [
        ("a", "identical geometry, mirrored, scaled by 4")
    ]
    assert copies_of(copies_beside(found), "c") == []


def test_a_shape_names_its_whole_group_and_through_whom() -> None:
    same = Match("identical file")
    found = [Copy("a", "b", same), Copy("b", "c", same), Copy("c", "d", same), Copy("x", "y", same)]
    assert copies_of(copies_beside(found), "a") == [("b", same), ("c", "b"), ("d", "c")]
    assert copies_of(copies_beside(found), "c") == [("b", same), ("d", same), ("a", "b")]
    assert copies_of(copies_beside(found), "x") == [("y", same)]


def test_more_copies_than_are_looked_for_beside_each_shape_make_one_group() -> None:
    outlines = {}
    for name, size in (("cube", (1, 1, 1)), ("beam", (1, 1, 6))):
        for number in range(30):
            made = trimesh.creation.box(size)
            turn = Rotation.random(random_state=number).as_matrix()
            mesh = clean(Mesh(np.array(made.vertices @ turn.T, float), np.array(made.faces, np.int32)))[0]
            outlines[f"{name} {number}"] = Outline(f"{name} {number}", outline(mesh))
    _, possible = pair_outlines(outlines)
    found = join_copies([], {pair: Match("identical geometry") for pair in possible}, list(outlines))
    assert group_copies(found, list(outlines)).tolist() == [0] * 30 + [1] * 30


def test_no_fold_parts_copies() -> None:
    codes = np.repeat(np.arange(4), 10)
    groups = np.arange(40)
    groups[[3, 25, 39]] = 3
    folds = deal_folds(codes, 0, groups)
    assert sorted(np.concatenate(folds).tolist()) == list(range(40))
    assert sum(bool(np.isin([3, 25, 39], fold).any()) for fold in folds) == 1


def test_folds_without_copies_are_dealt_as_before() -> None:
    codes = np.array([0, 1, -1, 1, 0, 1, 1, 0, 1])
    for plain, grouped in zip(deal_folds(codes, 3), deal_folds(codes, 3, np.arange(9)), strict=True):
        assert plain.tolist() == grouped.tolist()
