"""The demo database: sound meshes, the same everywhere, varied inside a class, and read back as classes."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from functools import cache
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

from shapeviz_report.database import read_database
from shapeviz_report.demo import CLASSES, PER_CLASS, make_shape, shape_path, write_shape
from shapeviz_report.mesh import clean, read_mesh
from shapeviz_report.mesh.clean import count_components, is_watertight
from shapeviz_report.types import FloatArray, Mesh

NAMES = [demo_class.name for demo_class in CLASSES]
SOME = (0, 4)

made = cache(make_shape)


def diagonal(mesh: Mesh) -> float:
    return float(np.linalg.norm(np.ptp(mesh.vertices, axis=0)))


def corners(mesh: Mesh) -> tuple[FloatArray, FloatArray, FloatArray]:
    return tuple(mesh.vertices[mesh.faces[:, i]] for i in range(3))


def volume(mesh: Mesh) -> float:
    a, b, c = corners(mesh)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def count_piercing_edges(mesh: Mesh) -> int:
    """Pairs of a face and an edge through its inside, among faces that share no vertex (Möller-Trumbore)."""
    points = np.stack(corners(mesh), axis=1)
    centres = points.mean(axis=1)
    radius = np.linalg.norm(points - centres[:, None], axis=2).max()
    pairs = cKDTree(centres).query_pairs(2 * radius, output_type="ndarray")
    pairs = np.concatenate([pairs, pairs[:, ::-1]])
    faces = mesh.faces[pairs]
    pairs = pairs[~(faces[:, 0, :, None] == faces[:, 1, None, :]).any(axis=(1, 2))]
    face = points[pairs[:, 1]]
    first, second = face[:, 1] - face[:, 0], face[:, 2] - face[:, 0]
    tiny, count = 1e-3, 0
    for k in range(3):
        start = points[pairs[:, 0], k]
        way = points[pairs[:, 0], (k + 1) % 3] - start
        across = np.cross(way, second)
        scale = np.linalg.norm(first, axis=1) * np.linalg.norm(second, axis=1) * np.linalg.norm(way, axis=1)
        determinant = np.einsum("ij,ij->i", first, across)
        steep = np.abs(determinant) > tiny * scale  # edges in the plane of the face do not pierce it
        apart = (start - face[:, 0])[steep]
        turned = np.cross(apart, first[steep])
        u = np.einsum("ij,ij->i", apart, across[steep]) / determinant[steep]
        w = np.einsum("ij,ij->i", way[steep], turned) / determinant[steep]
        t = np.einsum("ij,ij->i", second[steep], turned) / determinant[steep]
        count += np.count_nonzero(
            (np.minimum(u, w) > tiny) & (u + w < 1 - tiny) & (t > tiny) & (t < 1 - tiny)
        )
    return count


def test_the_classes_are_those_of_the_paper() -> None:
    first = ["airplane", "ant", "bird", "chair", "cup", "fish", "fourleg"]
    assert [*first, "glasses", "hand", "human", "octopus", "plier", "table", "teddy"] == NAMES


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("index", SOME)
def test_every_shape_is_one_closed_surface(name: str, index: int) -> None:
    mesh = made(name, index)
    assert np.isfinite(mesh.vertices).all()
    assert mesh.faces.dtype == np.int32
    assert is_watertight(mesh.faces)
    assert count_components(len(mesh.vertices), mesh.faces) == 1
    assert volume(mesh) > 0
    cleaned, repairs = clean(mesh)
    assert not repairs, "the package finds nothing to mend in it"
    assert len(cleaned.faces) == len(mesh.faces)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("index", SOME)
def test_triangles_are_small_and_even(name: str, index: int) -> None:
    mesh = made(name, index)
    a, b, c = corners(mesh)
    edges = np.concatenate([np.linalg.norm(x - y, axis=1) for x, y in ((a, b), (b, c), (c, a))])
    assert 4_000 < len(mesh.faces) < 16_000
    assert 0.007 < np.median(edges) / diagonal(mesh) < 0.022
    assert np.percentile(edges, 99) < 2 * np.median(edges)
    assert np.percentile(edges, 1) > 0.3 * np.median(edges)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_no_shape_cuts_itself(name: str) -> None:
    assert count_piercing_edges(made(name, 1)) == 0


def test_the_check_for_cuts_finds_one() -> None:
    mesh = made("plier", 0)
    moved = mesh.vertices + 0.05 * diagonal(mesh)
    both = Mesh(np.concatenate([mesh.vertices, moved]), np.concatenate([mesh.faces, mesh.faces + len(moved)]))
    assert count_piercing_edges(both) > 10


@pytest.mark.parametrize("name", NAMES)
def test_shapes_of_a_class_differ_in_proportion_or_pose(name: str) -> None:
    def describe(mesh: Mesh) -> FloatArray:
        distance = np.linalg.norm(mesh.vertices - mesh.vertices.mean(axis=0), axis=1) / diagonal(mesh)
        ratios = np.ptp(mesh.vertices, axis=0) / diagonal(mesh)
        return np.array(
            [*ratios, volume(mesh) ** (1 / 3) / diagonal(mesh), *np.quantile(distance, (0.2, 0.8))]
        )

    kinds = next(c.kinds for c in CLASSES if c.name == name)
    same_kind = (0, len(kinds)) if len(kinds) < PER_CLASS else ()
    some = {index: describe(made(name, index)) for index in {*SOME, *same_kind}}
    for i, j in combinations(some, 2):
        assert np.abs(some[i] - some[j]).max() > 0.01, f"{i} and {j} are alike"


def fingerprint(mesh: Mesh) -> str:
    return hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes()).hexdigest()


@pytest.mark.slow
def test_a_shape_depends_on_class_index_and_seed_alone() -> None:
    here = fingerprint(make_shape("octopus", 5, seed=7))
    make_shape("hand", 0)
    assert fingerprint(make_shape("octopus", 5, seed=7)) == here
    assert fingerprint(make_shape("octopus", 5, seed=8)) != here
    script = (
        "import hashlib; from shapeviz_report.demo import make_shape; m = make_shape('octopus', 5, seed=7);"
        "print(hashlib.sha256(m.vertices.tobytes() + m.faces.tobytes()).hexdigest())"
    )
    elsewhere = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert elsewhere.stdout.strip() == here


def test_shapes_stand_upright_and_look_towards_negative_y() -> None:
    table = made("table", 0)
    a, b, c = corners(table)
    areas = np.cross(b - a, c - a) / 2
    upper = (a[:, 2] + b[:, 2] + c[:, 2]) / 3 > 0.97 * table.vertices[:, 2].max()
    assert areas[upper, 2].sum() > 0.9 * np.linalg.norm(areas[upper], axis=1).sum()
    horse, plane = made("fourleg", 0), made("airplane", 0)
    head = horse.vertices[horse.vertices[:, 2] > np.quantile(horse.vertices[:, 2], 0.97)]
    assert head[:, 1].mean() < horse.vertices[:, 1].mean() - 0.2 * np.ptp(horse.vertices[:, 1])
    fin = plane.vertices[plane.vertices[:, 2] > np.quantile(plane.vertices[:, 2], 0.97)]
    assert fin[:, 1].mean() > plane.vertices[:, 1].mean() + 0.2 * np.ptp(plane.vertices[:, 1])


def test_an_unknown_class_is_a_key_error() -> None:
    with pytest.raises(KeyError, match="unicorn"):
        make_shape("unicorn", 0)


def test_written_shapes_read_back_as_a_database(tmp_path: Path) -> None:
    for name in ("cup", "plier"):
        for index in (0, 1):
            path = write_shape(tmp_path, name, index, 0)
            assert path == shape_path(tmp_path, name, index)
    write_shape(tmp_path, "cup", 0, 0)  # once more over the file that is there
    database = read_database(tmp_path)
    assert [shape.id for shape in database.shapes] == ["cup/00", "cup/01", "plier/00", "plier/01"]
    assert not database.failures
    assert (
        sorted(path.name for path in tmp_path.rglob("*") if path.is_file()) == ["00.off"] * 2 + ["01.off"] * 2
    )
    mesh, expected = read_mesh(tmp_path / "cup" / "01.off"), made("cup", 1)
    np.testing.assert_allclose(mesh.vertices, expected.vertices, atol=1e-6)
    np.testing.assert_array_equal(mesh.faces, expected.faces)
