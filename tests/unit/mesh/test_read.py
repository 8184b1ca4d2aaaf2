"""Real files of every format, whole and broken."""

from __future__ import annotations

import base64
import contextlib
import hashlib
import json
import shutil
import struct
from io import BytesIO
from itertools import product
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
import trimesh
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from shapeviz_report.database.formats import MESH_FORMATS
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh.read import collect_files, content_hash, parse_mesh, read_mesh
from shapeviz_report.mesh.readers.polygons import PolygonMesh, triangulate
from shapeviz_report.types import Mesh

SUFFIXES = tuple(MESH_FORMATS)
CUBE = trimesh.creation.box(extents=(1, 2, 3))


def write(
    folder: Path, suffix: str, scene: trimesh.Trimesh | trimesh.Scene = CUBE, stem: str = "mesh"
) -> Path:
    """A file as trimesh's exporter writes it; glTF with its buffer beside it."""
    path = folder / f"{stem}{suffix}"
    if suffix == ".gltf":
        if isinstance(scene, trimesh.Trimesh):
            scene = scene.scene()
        for name, data in scene.export(file_type="gltf").items():
            (path if name == "model.gltf" else folder / name).write_bytes(data)
    else:
        scene.export(path)
    return path


def write_text(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text)
    return path


def triangles(mesh: Mesh) -> np.ndarray:
    return mesh.vertices[mesh.faces]


def volume(mesh: Mesh) -> float:
    a, b, c = triangles(mesh).transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def area(mesh: Mesh) -> float:
    a, b, c = triangles(mesh).transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def read_text(folder: Path, name: str, text: str) -> Mesh:
    return read_mesh(write_text(folder, name, text))


# every format


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_reads_what_the_exporter_wrote(tmp_path, suffix):
    mesh = read_mesh(write(tmp_path, suffix))
    assert mesh.vertices.dtype == np.float64
    assert mesh.faces.dtype == np.int32
    assert mesh.faces.shape == (12, 3)
    assert volume(mesh) == pytest.approx(6)  # signed: the orientation is kept as well
    assert np.allclose(np.ptp(mesh.vertices, axis=0), (1, 2, 3))


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_suffix_may_be_in_upper_case(tmp_path, suffix):
    path = write(tmp_path, suffix)
    upper = path.rename(tmp_path / f"MESH{suffix.upper()}")
    assert volume(read_mesh(upper)) == pytest.approx(6)


@pytest.mark.parametrize("suffix", [".glb", ".gltf", ".3mf"])
def test_scene_is_put_together_with_its_transformations(tmp_path, suffix):
    scene = trimesh.Scene()
    for shift in (0, 10):
        scene.add_geometry(
            CUBE, geom_name="cube", transform=trimesh.transformations.translation_matrix((shift, 0, 0))
        )
    mesh = read_mesh(write(tmp_path, suffix, scene))
    assert len(mesh.faces) == 24
    assert volume(mesh) == pytest.approx(12)
    assert np.ptp(mesh.vertices[:, 0]) == pytest.approx(11)


def test_collada_nodes_are_placed_by_their_matrices(tmp_path):
    path = write(tmp_path, ".dae")
    text = path.read_text()
    assert "<instance_geometry" in text
    path.write_text(text.replace("<instance_geometry", "<scale>2 2 2</scale><instance_geometry", 1))
    assert volume(read_mesh(path)) == pytest.approx(48)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_empty_file(tmp_path, suffix):
    for content in (b"", b" \n\n"):
        path = tmp_path / f"empty{suffix}"
        path.write_bytes(content)
        with pytest.raises(MeshError, match="empty"):
            read_mesh(path)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(
    "content", [b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", b"<html>404 not found</html>", b"hello, world"]
)
def test_wrong_content_for_the_suffix(tmp_path, suffix, content):
    path = tmp_path / f"wrong{suffix}"
    path.write_bytes(content)
    with pytest.raises(MeshError):
        read_mesh(path)


@pytest.mark.parametrize(
    ("suffix", "other"),
    [(one, other) for one, other in product(SUFFIXES, SUFFIXES) if MESH_FORMATS[one] != MESH_FORMATS[other]],
)
def test_one_format_under_the_suffix_of_another(tmp_path, suffix, other):
    path = write(tmp_path, other).rename(tmp_path / f"disguised{suffix}")
    with pytest.raises(MeshError):
        read_mesh(path)


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize(
    ("content", "seems"),
    [
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n", "Git LFS pointer"),
        (b"\x1f\x8b\x08\0\0\0\0\0", "gzip"),
        (b"<!DOCTYPE html>\n<html><body>404</body></html>", "web page"),
        (b"solid a\nfacet normal 0 0 1\nouter loop\n", "STL"),
        (b"ISO-10303-21;\nHEADER;", "STEP"),
        (b"# by hand\nv 0 0 0\n", "OBJ"),
        (b"OFF\n1 0 0\n", "OFF"),
        (b"Kaydara FBX Binary  \0", "FBX"),
    ],
)
def test_reason_names_what_a_file_seems_to_be(suffix, content, seems):
    if seems == MESH_FORMATS[suffix]:
        return
    with pytest.raises(MeshError, match=rf"it is not {MESH_FORMATS[suffix]}, but seems to be .*{seems}"):
        parse_mesh({f"mesh{suffix}": content})


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("fraction", [0.02, 0.3, 0.6, 0.9])
def test_truncated_file(tmp_path, suffix, fraction):
    path = write(tmp_path, suffix, trimesh.creation.icosphere(subdivisions=2))
    data = path.read_bytes()
    path.write_bytes(data[: int(fraction * len(data))])
    if suffix == ".obj":  # OBJ announces nothing: what is there is all that can be known to be missing
        with contextlib.suppress(MeshError):
            assert len(read_mesh(path).faces) < 320
    else:
        with pytest.raises(MeshError):
            read_mesh(path)


@pytest.mark.parametrize("suffix", [".glb", ".gltf", ".ply", ".obj", ".off"])
def test_point_cloud_has_no_faces(tmp_path, suffix):
    if suffix == ".off":
        path = write_text(tmp_path, "cloud.off", "OFF\n2 0 0\n0 0 0\n1 1 1\n")
    elif suffix == ".ply":
        path = write_text(
            tmp_path,
            "cloud.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
            "end_header\n1 2 3\n",
        )
    elif suffix == ".obj":
        path = write_text(tmp_path, "cloud.obj", "v 0 0 0\nv 1 1 1\n")
    else:
        path = write(tmp_path, suffix, trimesh.Scene(trimesh.PointCloud([[0, 0, 0], [1, 1, 1.0]])))
    with pytest.raises(MeshError, match="no faces"):
        read_mesh(path)


def test_unsupported_suffix_says_what_is_read(tmp_path):
    with pytest.raises(MeshError, match=r"\.fbx are not read.*\.off"):
        read_mesh(tmp_path / "mesh.fbx")


def test_file_that_cannot_be_opened(tmp_path):
    (tmp_path / "folder.off").mkdir()
    with pytest.raises(MeshError, match="cannot be opened"):
        read_mesh(tmp_path / "folder.off")
    with pytest.raises(MeshError, match="cannot be opened"):
        read_mesh(tmp_path / "missing.off")


@pytest.fixture(scope="module")
def whole_files(tmp_path_factory) -> dict[str, bytes]:
    folder = tmp_path_factory.mktemp("whole")
    return {suffix: write(folder, suffix).read_bytes() for suffix in SUFFIXES}


@st.composite
def mutations(draw) -> list[tuple[float, int, bytes]]:
    """Where (as a fraction of the file), how many bytes go, and which come in their place."""
    place = st.floats(0, 1, exclude_max=True)
    content = st.binary(max_size=8) | st.sampled_from(
        [b"-1", b"999999999", b"nan", b"1e999", b"\xff" * 4, b"\0"]
    )
    return draw(st.lists(st.tuples(place, st.integers(0, 8), content), min_size=1, max_size=4))


def mutate(data: bytes, changes: list[tuple[float, int, bytes]]) -> bytes:
    for place, length, content in changes:
        start = int(place * len(data))
        data = data[:start] + content + data[start + length :]
    return data


def mutate_model(data: bytes, changes: list[tuple[float, int, bytes]]) -> bytes:
    """Mutate the XML inside a 3MF: the check sums of the archive would catch anything else."""
    mutated = BytesIO()
    with ZipFile(BytesIO(data)) as whole, ZipFile(mutated, "w") as broken:
        for name in whole.namelist():
            content = whole.read(name)
            broken.writestr(name, mutate(content, changes) if name.endswith(".model") else content)
    return mutated.getvalue()


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@pytest.mark.parametrize("suffix", SUFFIXES)
@given(changes=mutations())
def test_broken_bytes_end_in_a_mesh_or_a_mesh_error(tmp_path, whole_files, suffix, changes):
    path = tmp_path / f"broken{suffix}"
    path.write_bytes((mutate_model if suffix == ".3mf" else mutate)(whole_files[suffix], changes))
    try:
        mesh = read_mesh(path)
    except MeshError:
        return
    assert len(mesh.faces)
    assert mesh.faces.min() >= 0
    assert mesh.faces.max() < len(mesh.vertices)


# OFF

TETRAHEDRON = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
TETRAHEDRON_FACES = ["3 0 2 1", "3 0 1 3", "3 0 3 2", "3 1 2 3"]


def off(header: str, vertices: list[str], faces: list[str]) -> str:
    return "\n".join([header, *vertices, *faces, ""])


@pytest.mark.parametrize(
    "text",
    [
        off("OFF\n4 4 6", TETRAHEDRON, TETRAHEDRON_FACES),
        off("OFF4 4 0", TETRAHEDRON, TETRAHEDRON_FACES),  # as ModelNet has it
        off("OFF 4 4 0", TETRAHEDRON, TETRAHEDRON_FACES),
        off("OFF\n4 4", TETRAHEDRON, TETRAHEDRON_FACES),
        off("OFF\n4\n4\n6", TETRAHEDRON, TETRAHEDRON_FACES),
        off("4 4 6", TETRAHEDRON, TETRAHEDRON_FACES),
        off("# made by hand\nOFF # really\n4 4 6", TETRAHEDRON, TETRAHEDRON_FACES),
        off("OFF\n\n4 4 6\n", [*TETRAHEDRON, "", "# faces"], TETRAHEDRON_FACES),
        off("OFF\n4 4 6", TETRAHEDRON, [f"{face} 255 0 0" for face in TETRAHEDRON_FACES]),
        off("OFF\n4 4 6", TETRAHEDRON, ["3 0 2 1 0.5 0.5 0.5 1", *TETRAHEDRON_FACES[1:]]),
        off("COFF\n4 4 6", [f"{vertex} 255 0 0 255" for vertex in TETRAHEDRON], TETRAHEDRON_FACES),
        off("NOFF\n4 4 6", [f"{vertex} 0 0 1" for vertex in TETRAHEDRON], TETRAHEDRON_FACES),
        off("STCNOFF\n4 4 6", [f"{vertex} 0 0 1 9 9 9 9 0 1" for vertex in TETRAHEDRON], TETRAHEDRON_FACES),
        off("OFF\n4 4 6", [" ".join(TETRAHEDRON)], [" ".join(TETRAHEDRON_FACES)]),
        off("OFF\n4 4 6", TETRAHEDRON, TETRAHEDRON_FACES).replace("\n", "\r\n"),
        off("OFF\n4 4 6", TETRAHEDRON, TETRAHEDRON_FACES).replace("\n", "\r"),
        off("OFF\n4 4 6", TETRAHEDRON, TETRAHEDRON_FACES).replace(" ", "\t"),
        off("OFF\n4 4 6", TETRAHEDRON, TETRAHEDRON_FACES).rstrip(),
    ],
)
def test_off_as_found_in_the_wild(tmp_path, text):
    path = tmp_path / "mesh.off"
    path.write_bytes(text.encode())
    mesh = read_mesh(path)
    assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    assert mesh.faces.tolist() == [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


def test_off_polygons(tmp_path):
    hexagon = [f"{np.cos(angle)} {np.sin(angle)} 0" for angle in np.arange(6) * np.pi / 3]
    mesh = read_text(
        tmp_path, "mesh.off", off("OFF\n6 3 0", hexagon, ["4 0 1 2 3", "6 0 1 2 3 4 5", "2 0 1"])
    )
    assert len(mesh.faces) == 2 + 4
    assert area(mesh) == pytest.approx(1.5 * 3**0.5 + 0.75 * 3**0.5)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (
            off("OFF\n4 4 6", TETRAHEDRON, ["3 0 1 4", *TETRAHEDRON_FACES[1:]]),
            "vertex 4 .* there are 4 vertices",
        ),
        (off("OFF\n4 4 6", TETRAHEDRON, ["3 0 1 -1", *TETRAHEDRON_FACES[1:]]), "vertex -1 "),
        (off("OFF\n4 4 6", TETRAHEDRON, [f"3 0 1 1{22 * '0'}", *TETRAHEDRON_FACES[1:]]), "can reach: 1e.22"),
        (off("OFF\n4 4 6", TETRAHEDRON, ["3 0 1 1.5", *TETRAHEDRON_FACES[1:]]), "not whole"),
        (
            off("OFF\n4 4 6", TETRAHEDRON, ["9 0 1 2", *TETRAHEDRON_FACES[1:]]),
            "9 corners, but its line has 3",
        ),
        (off("OFF\n4 4 6", TETRAHEDRON, TETRAHEDRON_FACES[:2]), "4 faces, and has only 6 lines"),
        (off("OFF\n999999999999 4 6", TETRAHEDRON, TETRAHEDRON_FACES), "only 8 lines"),
        (off("OFF\n4 4 6", ["0 0 zero", *TETRAHEDRON[1:]], TETRAHEDRON_FACES), "a number belongs"),
        (
            off("4OFF\n4 4 6", [f"{vertex} 1" for vertex in TETRAHEDRON], TETRAHEDRON_FACES),
            "three dimensions",
        ),
        ("OFF BINARY\n\0\0\0\4", "binary OFF"),
        ("OFF\n", "does not begin with OFF and the numbers"),
        ("OFF\n0 0 0\n", "no faces"),
    ],
)
def test_off_that_is_wrong(tmp_path, text, reason):
    with pytest.raises(MeshError, match=reason):
        read_text(tmp_path, "mesh.off", text)


def test_reasons_are_for_the_owner_of_a_file(tmp_path):
    # The parser's own words would be: invalid literal for int() with base 10: '3.5'
    with pytest.raises(MeshError, match=r"^a face announces 3\.5 corners, but its line has 3$"):
        read_text(tmp_path, "mesh.off", off("OFF\n4 1 6", TETRAHEDRON, ["3.5 0 2 1"]))
    with pytest.raises(MeshError, match="something else stands where a number belongs"):
        read_text(tmp_path, "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n")


def test_extreme_coordinates_are_kept(tmp_path):
    vertices = ["1e300 -1e300 5e-324", "nan 0 0", "inf -inf 0", "0 0 1"]
    mesh = read_text(tmp_path, "mesh.off", off("OFF\n4 2 0", vertices, ["3 0 1 2", "4 0 1 2 3"]))
    assert mesh.vertices[0].tolist() == [1e300, -1e300, 5e-324]
    assert np.isnan(mesh.vertices[1, 0])
    assert np.isinf(mesh.vertices[2, :2]).all()
    assert len(mesh.faces) == 3


# polygons


@pytest.mark.parametrize("turn", range(4))
def test_concave_quad_is_cut_at_its_reflex_corner(tmp_path, turn):
    corners = np.roll([[0, 0, 0], [2, 0, 0], [0.5, 0.5, 0], [0, 2, 0]], turn, axis=0)
    rows = [" ".join(map(str, corner)) for corner in corners]
    mesh = read_text(tmp_path, "mesh.off", off("OFF\n4 1 0", rows, ["4 0 1 2 3"]))
    assert area(mesh) == pytest.approx(1)  # the other diagonal gives 2 x 1.5 with a fold


@pytest.mark.parametrize("turn", range(8))
def test_concave_polygon_does_not_fold(tmp_path, turn):
    outline = np.array(
        [[0, 0, 0], [3, 0, 0], [3, 3, 0], [2, 3, 0], [2, 1, 0], [1, 1, 0], [1, 3, 0], [0, 3, 0.0]]
    )
    tilt = trimesh.transformations.rotation_matrix(1.1, (1, 2, 3))[:3, :3]
    corners = np.roll(outline, turn, axis=0) @ tilt.T
    rows = [" ".join(map(str, corner)) for corner in corners]
    mesh = read_text(tmp_path, "mesh.off", off("OFF\n8 1 0", rows, ["8 0 1 2 3 4 5 6 7"]))
    assert len(mesh.faces) == 6
    assert area(mesh) == pytest.approx(7)
    a, b, c = triangles(mesh).transpose(1, 0, 2)
    assert (np.cross(b - a, c - a) @ tilt[:, 2] >= -1e-12).all()  # all face the polygon's own way


@settings(max_examples=50, deadline=None)
@given(
    radii=st.lists(st.floats(0.2, 1), min_size=5, max_size=20),
    seed=st.integers(0, 1000),
)
def test_star_shaped_polygons_keep_their_area(tmp_path_factory, radii, seed):
    angles = np.arange(len(radii)) * 2 * np.pi / len(radii)
    outline = np.column_stack([np.cos(angles) * radii, np.sin(angles) * radii, np.zeros(len(radii))])
    following = np.roll(outline, -1, axis=0)
    expected = np.cross(outline, following)[:, 2].sum() / 2
    corners = (
        outline
        @ trimesh.transformations.random_rotation_matrix(np.random.default_rng(seed).random(3))[:3, :3].T
    )
    rows = [" ".join(map(repr, corner.tolist())) for corner in corners]
    face = f"{len(radii)} " + " ".join(map(str, range(len(radii))))
    mesh = read_text(tmp_path_factory.mktemp("star"), "mesh.off", off(f"OFF\n{len(radii)} 1 0", rows, [face]))
    assert area(mesh) == pytest.approx(expected)


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(
    radii=st.lists(st.floats(0.3, 1), min_size=4, max_size=9),
    convex=st.booleans(),
    cuts=st.lists(st.integers(0, 4), min_size=9, max_size=9),
    turn=st.integers(0, 50),
    seed=st.integers(0, 1000),
)
def test_prisms_over_polygons_with_straight_corners_are_closed(radii, convex, cuts, turn, seed):
    """Sides of any polygon, cut at further points, begin at any corner: no triangle is flat, none folds over."""
    angles = np.arange(len(radii)) * 2 * np.pi / len(radii)
    corners = np.column_stack([np.cos(angles), np.sin(angles)]) * (1 if convex else np.array(radii)[:, None])
    outline = np.concatenate(
        [
            corners[i]
            + (corners[(i + 1) % len(radii)] - corners[i]) * np.arange(cut + 1)[:, None] / (cut + 1)
            for i, cut in enumerate(cuts[: len(radii)])
        ]
    )
    size = len(outline)
    flat = np.column_stack([outline, np.zeros(size)])
    turned = trimesh.transformations.random_rotation_matrix(np.random.default_rng(seed).random(3))[:3, :3]
    vertices = np.concatenate([flat, flat + np.array([0, 0, 2])]) @ turned.T
    ring, following = np.arange(size), (np.arange(size) + 1) % size
    polygons = [np.roll(ring[::-1], turn), np.roll(ring + size, turn)]
    polygons += list(np.stack([ring, following, following + size, ring + size], axis=1))
    mesh = PolygonMesh(vertices, np.concatenate(polygons), np.array([len(polygon) for polygon in polygons]))
    faces = triangulate(mesh)
    a, b, c = vertices[faces].transpose(1, 0, 2)
    longest = np.max([np.linalg.norm(side, axis=1) for side in (b - a, c - b, a - c)], axis=0)
    assert (np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1e-6 * longest**2).all()
    area_of_outline = np.cross(flat, flat[following])[:, 2].sum() / 2
    lid = faces[(faces >= size).all(axis=1)]
    a, b, c = vertices[lid].transpose(1, 0, 2)
    areas = np.cross(b - a, c - a) @ turned[:, 2] / 2
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(area_of_outline)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    pairs = {tuple(edge) for edge in edges.tolist()}
    assert len(pairs) == len(edges)
    assert all((end, begin) in pairs for begin, end in pairs)


def test_triangles_come_in_the_order_of_the_polygons(tmp_path):
    rows = ["0 0 0", "1 0 0", "1 1 0", "0 1 0"]
    mesh = read_text(tmp_path, "mesh.off", off("OFF\n4 3 0", rows, ["4 0 1 2 3", "3 0 1 2", "4 1 2 3 0"]))
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3], [0, 1, 2], [1, 2, 3], [1, 3, 0]]


# OBJ


def test_obj_as_found_in_the_wild(tmp_path):
    mesh = read_text(
        tmp_path,
        "mesh.obj",
        "# a comment\nmtllib ../../no/such.mtl\no first\n"
        "v 0 0 0 0.5 0.5 0.5\nv\t1  0 0\r\nv 1 1 0 1.0\nvt 0 0\nvn 0 0 1\n"
        "usemtl red\nf 1/1/1 2/1/1 3/1/1\nf 1//1 2//1 3//1 # again\nf 1/1 2/1 3/1\n"
        "o second\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\ns off\nf -4 -3 \\\n -2 -1\nf 4 5 6\n"
        "v 9 9 9\n",
    )
    assert mesh.vertices.shape == (8, 3)  # not split where the texture or the material changes
    # a relative index counts back from its own line, not from the end of the file
    assert mesh.faces.tolist() == [[0, 1, 2]] * 3 + [[3, 4, 5], [3, 5, 6]] + [[3, 4, 5]]


@pytest.mark.parametrize(
    ("face", "reason"),
    [
        ("f 0 1 2", "counts from 1"),
        ("f 1 2 4", "vertex 3 "),
        ("f -4 1 2", "vertex -1 "),
        ("f 1 2 x", "a number belongs"),
    ],
)
def test_obj_that_is_wrong(tmp_path, face, reason):
    with pytest.raises(MeshError, match=reason):
        read_text(tmp_path, "mesh.obj", f"v 0 0 0\nv 1 0 0\nv 0 1 0\n{face}\n")


# PLY


def ply(encoding: str, faces: list[list[int]], count_type: str = "uchar") -> bytes:
    """The unit square's corners with some faces, colours on both, and an element of its own in between."""
    vertices = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    header = (
        f"ply\nformat {encoding} 1.0\ncomment a test\nelement vertex {len(vertices)}\n"
        "property float x\nproperty double y\nproperty float z\nproperty uchar red\n"
        f"element note 2\nproperty list uchar short values\nelement face {len(faces)}\n"
        f"property uchar flags\nproperty list {count_type} int vertex_indices\nproperty float quality\n"
        "end_header\n"
    ).encode()
    if encoding == "ascii":
        rows = [f"{x} {y} {z} 255" for x, y, z in vertices] + ["1 7", "3 7 8 9"]
        rows += [f"1 {len(face)} {' '.join(map(str, face))} 0.5" for face in faces]
        return header + "\n".join(rows).encode()
    order = "<" if "little" in encoding else ">"
    body = b"".join(struct.pack(order + "fdfB", *vertex, 255) for vertex in vertices)
    body += struct.pack(order + "Bh", 1, 7) + struct.pack(order + "Bhhh", 3, 7, 8, 9)
    for face in faces:
        count = {"uchar": "B", "int": "i"}[count_type]
        body += struct.pack(f"{order}B{count}{len(face)}if", 1, len(face), *face, 0.5)
    return header + body


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("count_type", ["uchar", "int"])
@pytest.mark.parametrize(
    "faces", [[[0, 1, 2], [0, 2, 3]], [[0, 1, 2, 3]], [[0, 1, 2], [0, 1, 2, 3]], [[0, 1, 2, 3], [1, 2, 3]]]
)
def test_ply_with_polygons(tmp_path, encoding, count_type, faces):
    path = tmp_path / "mesh.ply"
    path.write_bytes(ply(encoding, faces, count_type))
    mesh = read_mesh(path)
    assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert area(mesh) == pytest.approx(sum((len(face) - 2) / 2 for face in faces))


@pytest.mark.parametrize("encoding", ["ascii", "binary_little_endian"])
def test_ply_that_is_wrong(tmp_path, encoding):
    whole = ply(encoding, [[0, 1, 2], [0, 1, 2, 3]])
    for broken, reason in [
        (whole[:-9], "cut off"),
        (whole.replace(b"face 2", b"face 999999999"), "cut off"),
        (whole.replace(b"face 2", b"face -2"), "fewer than zero"),
        (whole.replace(b"end_header", b"end"), "no PLY header"),
        (whole.replace(encoding.encode(), b"morse"), "morse"),
        (whole.replace(b"comment a test", b"what is this"), "what is this"),
        (whole.replace(b"double y", b"double w"), "x, y and z"),
        (ply(encoding, [[0, 1, 4]]), "vertex 4 "),
    ]:
        path = tmp_path / "mesh.ply"
        path.write_bytes(broken)
        with pytest.raises(MeshError, match=reason):
            read_mesh(path)


# STL


def test_stl_text(tmp_path):
    path = tmp_path / "mesh.stl"
    path.write_text(trimesh.exchange.stl.export_stl_ascii(CUBE))
    assert volume(read_mesh(path)) == pytest.approx(6)
    path.write_bytes(path.read_bytes().replace(b"solid ", "solid Flügel".encode("latin-1"), 1))
    assert volume(read_mesh(path)) == pytest.approx(6)
    path.write_bytes(path.read_bytes().replace(b"vertex 0.5", b"vertex O.5", 1))
    with pytest.raises(MeshError):
        read_mesh(path)


# glTF


def test_gltf_with_embedded_buffer(tmp_path):
    path = write(tmp_path, ".gltf")
    header = json.loads(path.read_text())
    for buffer in header["buffers"]:
        data = (tmp_path / buffer["uri"]).read_bytes()
        (tmp_path / buffer["uri"]).unlink()
        buffer["uri"] = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    path.write_text(json.dumps(header))
    assert volume(read_mesh(path)) == pytest.approx(6)


def move_buffer(path: Path, uri: str, destination: Path | None = None) -> None:
    """Let a glTF refer to its first buffer by another URI, and move that file there."""
    header = json.loads(path.read_text())
    if destination:
        destination.parent.mkdir(exist_ok=True)
        shutil.move(path.parent / header["buffers"][0]["uri"], destination)
    header["buffers"][0]["uri"] = uri
    path.write_text(json.dumps(header))


def test_gltf_buffer_in_a_folder_below_with_an_escaped_name(tmp_path):
    path = write(tmp_path, ".gltf")
    move_buffer(path, "parts/my%20buffer%231.bin", tmp_path / "parts" / "my buffer#1.bin")
    assert volume(read_mesh(path)) == pytest.approx(6)


@pytest.mark.parametrize(
    "uri", ["../outside.bin", "%2e%2e/outside.bin", "{absolute}", "file://{absolute}", "link.bin"]
)
def test_gltf_never_opens_files_outside_its_folder(tmp_path, uri):
    folder = tmp_path / "folder"
    folder.mkdir()
    outside = tmp_path / "outside.bin"
    path = write(folder, ".gltf")
    (folder / "link.bin").symlink_to(outside)
    move_buffer(path, uri.format(absolute=outside), outside)  # the right bytes: only the rule keeps them out
    with pytest.raises(MeshError, match="not a file in its own folder"):
        read_mesh(path)


@pytest.mark.parametrize(
    "uri", ["http://127.0.0.1:9/a.bin", "https://example.org/a.bin", "//example.org/a.bin", "ftp://x/a"]
)
@pytest.mark.parametrize("suffix", [".gltf", ".glb"])
def test_gltf_never_fetches(tmp_path, uri, suffix, monkeypatch):
    def refuse(*arguments, **options):
        raise AssertionError("a socket was opened")

    monkeypatch.setattr("socket.socket.connect", refuse)
    path = write(tmp_path, ".gltf")
    move_buffer(path, uri)
    if suffix == ".glb":
        text = path.read_bytes() + b" " * (-path.stat().st_size % 4)
        path = tmp_path / "mesh.glb"
        path.write_bytes(
            b"glTF" + struct.pack("<II", 2, 20 + len(text)) + struct.pack("<I", len(text)) + b"JSON" + text
        )
    with pytest.raises(MeshError, match="not a file in its own folder"):
        read_mesh(path)


def test_gltf_with_a_missing_buffer(tmp_path):
    path = write(tmp_path, ".gltf")
    move_buffer(path, "missing.bin")
    with pytest.raises(MeshError, match=r"missing\.bin cannot be opened"):
        read_mesh(path)


def test_gltf_that_trimesh_would_fill_with_zeros(tmp_path):
    path = write(tmp_path, ".gltf")
    header = json.loads(path.read_text())
    for accessor in header["accessors"]:
        del accessor["bufferView"]
    path.write_text(json.dumps(header))
    with pytest.raises(MeshError, match="has no content"):
        read_mesh(path)


def test_gltf_whose_nodes_form_a_circle(tmp_path):
    path = write(tmp_path, ".gltf")
    header = json.loads(path.read_text())
    for node in header["nodes"]:
        node["children"] = list(range(len(header["nodes"])))
    path.write_text(json.dumps(header))
    with contextlib.suppress(MeshError):  # it ends, one way or the other
        assert len(read_mesh(path).faces)


# COLLADA


def test_collada_never_opens_what_it_refers_to(tmp_path):
    secret = write_text(tmp_path, "secret.txt", "3 0 0")
    path = write(tmp_path, ".dae")
    text = path.read_text()
    start = text.index("<COLLADA")
    for declaration in (
        f'<!DOCTYPE x [<!ENTITY secret SYSTEM "file://{secret}">]>',
        '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>',
    ):
        for encoding in ("utf-8", "utf-16"):
            head = f'<?xml version="1.0" encoding="{encoding}"?>'
            path.write_bytes((head + declaration + text[start:]).encode(encoding))
            with pytest.raises(MeshError, match="document type"):
                read_mesh(path)


def test_collada_with_geometry_elsewhere(tmp_path):
    path = write(tmp_path, ".dae")
    text = path.read_text()
    path.write_text(
        text.replace('<instance_geometry url="#', '<instance_geometry url="http://example.org/a.dae#', 1)
    )
    with pytest.raises(MeshError, match="geometry in another file"):
        read_mesh(path)


# the files and their hash


@pytest.mark.parametrize("suffix", [suffix for suffix in SUFFIXES if suffix != ".gltf"])
def test_hash_is_that_of_the_file(tmp_path, suffix):
    path = write(tmp_path, suffix)
    assert content_hash(collect_files(path)) == hashlib.sha256(path.read_bytes()).hexdigest()


def test_collected_files_are_the_same_mesh_elsewhere(tmp_path):
    path = write(tmp_path, ".gltf")
    files = collect_files(path)
    assert set(files) == {file.name for file in tmp_path.iterdir()}
    assert len(files) > 1
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    for name, content in files.items():
        (elsewhere / name).write_bytes(content)
    mesh, copy = read_mesh(path), read_mesh(elsewhere / path.name)
    np.testing.assert_array_equal(mesh.vertices, copy.vertices)
    np.testing.assert_array_equal(mesh.faces, copy.faces)


def test_hash_of_gltf_covers_its_buffers(tmp_path):
    path = write(tmp_path, ".gltf")
    before = content_hash(collect_files(path))
    assert content_hash(collect_files(path)) == before
    buffer = tmp_path / json.loads(path.read_text())["buffers"][0]["uri"]
    changed = bytearray(buffer.read_bytes())
    changed[0] ^= 1
    buffer.write_bytes(changed)
    assert content_hash(collect_files(path)) != before


def test_files_of_a_broken_or_missing_mesh(tmp_path):
    for broken in ("{", '{"buffers": [1]}', '{"buffers": 1}'):
        with pytest.raises(MeshError, match="it is not glTF"):
            collect_files(write_text(tmp_path, "broken.gltf", broken))
    with pytest.raises(MeshError, match="cannot be opened"):
        collect_files(tmp_path / "missing.off")


COLLADA = """<COLLADA><library_geometries><geometry id="g"><mesh><source id="s"><float_array id="a" count="9">0 0 0 1 0
0 0 1 0</float_array><technique_common><accessor source="#a" count="3" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>{primitive}</mesh></geometry></library_geometries>
{rest}</COLLADA>"""


@pytest.mark.parametrize(
    ("primitive", "reason"),
    [
        (
            '<triangles count="2000000000">{}0 1 2</p></triangles>',
            "announces 2,000,000,000 elements, and has 1$",
        ),
        (
            '<polylist count="1">{}0 1 2</p><vcount>2000000000</vcount></polylist>',
            "2,000,000,000 corners, and has 3$",
        ),
        ('<polylist count="3">{}0 1 2</p><vcount>3 -3 3</vcount></polylist>', "a polygon of -3 corners"),
        (
            f'<polylist count="4">{{}}0 1 2</p><vcount>{2**62} {2**62} {2**62} {2**62 + 3}</vcount></polylist>',
            "corners, and has 3$",
        ),
        (f'<triangles count="1">{{}}0 1 1{"0" * 30}</p></triangles>', "can reach: 1e.30"),
    ],
)
def test_collada_that_announces_more_than_it_has_is_told_both_figures(tmp_path, primitive, reason):
    primitive = primitive.format('<input semantic="VERTEX" source="#v" offset="0"/><p>')
    with pytest.raises(MeshError, match=reason):
        read_text(tmp_path, "mesh.dae", COLLADA.format(primitive=primitive, rest=""))


def test_collada_that_is_nested_too_deeply_is_not_called_broken(tmp_path):
    nested = COLLADA.format(primitive="", rest="<extra>" * 5000 + "</extra>" * 5000)
    with pytest.raises(MeshError, match=r"goes beyond what is read: Excessive depth in document: \d+$"):
        read_text(tmp_path, "mesh.dae", nested)


@pytest.mark.parametrize("index", ["9" * 30, "-" + "9" * 30])
def test_obj_index_beyond_all_counting(tmp_path, index):
    with pytest.raises(MeshError, match=r"can reach: -?1e.30"):
        read_text(tmp_path, "mesh.obj", f"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 {index}\n")


def test_ply_header_without_an_end_in_sight(tmp_path):
    with pytest.raises(MeshError, match="header does not end within 1,048,576 bytes"):
        read_text(tmp_path, "mesh.ply", "ply\nformat ascii 1.0\n" + "comment x\n" * 200_000 + "end_header\n")
