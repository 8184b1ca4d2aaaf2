"""Small files that ask for much: each is answered at once, with its reason, and takes little memory.

Reading by hand what follows takes minutes or gigabytes, so a test that hangs has failed.
"""

from __future__ import annotations

import json
import struct
import time
from contextlib import suppress
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile

import numpy as np
import pytest

from shapeviz_report.bins import read_bins
from shapeviz_report.cells import write_cell
from shapeviz_report.config import Config, load_config
from shapeviz_report.database import read_database
from shapeviz_report.database.folder import MOST_WAYS
from shapeviz_report.errors import ConfigError, DatabaseError, MeshError
from shapeviz_report.external import MOST_EXTERNAL_COLUMNS, load_external
from shapeviz_report.features import BLOCKS
from shapeviz_report.mesh.read import collect_files, parse_mesh
from shapeviz_report.mesh.readers.limits import MOST_CORNERS, MOST_JSON_BYTES
from shapeviz_report.mesh.readers.polygons import PolygonMesh, triangulate
from shapeviz_report.publication import read_publication
from shapeviz_report.publication.logo import read_logo

CUBE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.fixture(autouse=True)
def _at_once():
    """Each file here took a minute or more before it was bounded."""
    begin = time.process_time()
    yield
    assert time.process_time() - begin < 10


def gltf(folder: Path, **more: object) -> Path:
    path = folder / "mesh.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, **more}))
    return path


def refused(read, *arguments) -> str:
    with pytest.raises((ConfigError, DatabaseError, MeshError)) as caught:
        read(*arguments)
    return str(caught.value)


# what the main process reads of a mesh, before any worker


@pytest.mark.parametrize("value", ["[]", "{}", "[[]]", '{"":0}'])
def test_a_json_of_millions_of_values(tmp_path, value) -> None:
    path = tmp_path / "mesh.gltf"
    path.write_text('{"asset": {"version": "2.0"}, "extras": [' + f"{value}," * 5_000_000 + "0]}")
    assert "values, more than" in refused(collect_files, path)


@pytest.mark.slow
def test_a_json_of_one_long_text(tmp_path) -> None:
    path = tmp_path / "mesh.gltf"
    with path.open("wb") as file:
        file.write(b'{"asset": "')
        file.truncate(MOST_JSON_BYTES + 1)
    assert "its JSON has 256 MiB" in refused(collect_files, path)


def test_buffers_are_bounded_together(tmp_path, monkeypatch) -> None:
    """One file under many spellings counts once."""
    monkeypatch.setattr("shapeviz_report.mesh.read.MOST_BYTES", 2**20)
    for name in ("0.bin", "1.bin", "2.bin"):
        (tmp_path / name).write_bytes(bytes(2**19))
    path = gltf(tmp_path, buffers=[{"uri": f"{n}.bin", "byteLength": 1} for n in range(3)])
    assert "larger than 1 MiB, all its files together" in refused(collect_files, path)
    same = gltf(
        tmp_path, buffers=[{"uri": "mesh.gltf"}] * 40 + [{"uri": "./mesh.gltf"}, {"uri": "%6desh.gltf"}]
    )
    assert list(collect_files(same)) == ["mesh.gltf"]


@pytest.mark.parametrize("uri", ["a\0.bin", "loop/a.bin", "\ud800", "n" * 300, "loop", "n/" * 3000])
def test_a_buffer_of_a_name_that_no_file_has(tmp_path, uri) -> None:
    (tmp_path / "loop").symlink_to("loop")
    path = gltf(tmp_path, buffers=[{"uri": uri, "byteLength": 1}])
    said = refused(collect_files, path)
    assert "not a file in its own folder" in said or "cannot be opened" in said


# readers


def test_a_3mf_of_many_objects(tmp_path) -> None:
    path = tmp_path / "mesh.3mf"
    types = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    vertices = '<vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>'
    mesh = (
        f'<mesh><vertices>{vertices}</vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh>'
    )
    with ZipFile(path, "w", ZIP_DEFLATED) as archive:
        archive.writestr(
            "_rels/.rels",
            '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
            f'<Relationship Target="/m" Type="{types}"/></Relationships>',
        )
        archive.writestr(
            "m",
            '<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>'
            + f'<object id="1">{mesh}</object>'
            + "".join(f'<object id="{n}"/>' for n in range(2, 50_000))
            + '</resources><build><item objectid="1"/></build></model>',
        )
    assert len(parse_mesh(collect_files(path)).faces) == 1


def test_a_ply_of_many_elements() -> None:
    header = "ply\nformat ascii 1.0\n" + "".join(f"element e{n} 0\n" for n in range(12_000)) + "end_header\n"
    assert "no vertices" in refused(parse_mesh, {"mesh.ply": header.encode()})


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("mesh.off", b"OFF\n8 12 0\n%b"),
        ("mesh.obj", b"v %b 0 0\n" + CUBE),
        ("mesh.stl", b"solid\nfacet normal %b"),
    ],
)
def test_a_long_word_that_is_no_number(name, data) -> None:
    parts = {name: data.replace(b"%b", b"1" * 1_000_000 + b"x")}
    assert len(refused(parse_mesh, parts)) < 300


def test_a_polygon_with_straight_sides_of_many_corners() -> None:
    """Every triangle of a fan from a corner on a side is flat; they are made good one by one."""
    side, rest = np.linspace(0, 1, 500, endpoint=False), np.zeros(500)
    square = [np.c_[side, rest], np.c_[rest + 1, side], np.c_[1 - side, rest + 1], np.c_[rest, 1 - side]]
    points = np.c_[np.concatenate(square), np.zeros(2000)]
    faces = triangulate(PolygonMesh(points, np.arange(2000), np.array([2000])))
    a, b, c = points[faces].transpose(1, 0, 2)
    areas = np.cross(b - a, c - a)[:, 2] / 2
    assert len(faces) == 1998
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(1)


def test_a_polygon_of_too_many_corners() -> None:
    corners = b" ".join(b"%d" % n for n in range(1, MOST_CORNERS + 2))
    points = b"".join(b"v %d %d 0\n" % (n % 199, n) for n in range(MOST_CORNERS + 1))
    said = refused(parse_mesh, {"mesh.obj": points + b"f " + corners + b"\n"})
    assert f"a polygon of {MOST_CORNERS + 1:,} corners" in said


# folders and links


def test_folders_that_link_to_one_another(tmp_path) -> None:
    """There are millions of ways through ten such folders."""
    names = [f"f{n}" for n in range(10)]
    for name in names:
        (tmp_path / name).mkdir()
        (tmp_path / name / "a.off").write_text("OFF")
        for other in names:
            (tmp_path / name / f"to-{other}").symlink_to(tmp_path / other)
    database = read_database(tmp_path)
    found = {shape.id for shape in database.shapes}
    assert {f"{name}/a" for name in names} <= found
    assert len(found) <= 10 * MOST_WAYS
    assert any("10 links lead to this folder already" in failure.reason for failure in database.failures)


@pytest.mark.parametrize("name", ["shapes.csv", "all.cla", "inside"])
def test_links_that_lead_outside_are_followed_only_when_asked(tmp_path, name) -> None:
    secret, root = tmp_path / "secret", tmp_path / "database"
    (secret / "inside").mkdir(parents=True)
    root.mkdir()
    for folder in (root, secret / "inside"):
        (folder / "m1.off").write_text("OFF")
    (secret / "shapes.csv").write_text("file,label\nm1.off,secret\n")
    (secret / "all.cla").write_text("PSB 1\n1 1\nsecret 0 1\n1\n")
    (root / name).symlink_to(secret / name)

    def told(outside: bool) -> str:
        try:
            return repr(read_database(root, outside=outside))
        except DatabaseError as error:
            return str(error)

    assert "--outside" in told(False)
    hidden = "inside/m1" if name == "inside" else "'secret'"
    assert hidden not in told(False)
    assert hidden in told(True)
    assert "--outside" not in told(True)
    # within the database links are followed
    (root / name).unlink()
    (root / ".kept").mkdir()
    (secret / name).rename(root / ".kept" / name)
    (root / name).symlink_to(root / ".kept" / name)
    assert "--outside" not in told(False)


# tables, lists of bins, features


def test_a_table_of_more_columns_than_cells(tmp_path, monkeypatch) -> None:
    """Rows of one cell under a header of thousands: each has all of its columns, empty."""
    monkeypatch.setattr("shapeviz_report.database.rows.MOST_CELLS", 50_000)
    path = tmp_path / "shapes.csv"
    path.write_text("file," + ",".join(f"c{n}" for n in range(1000)) + "\n" + "a.off\n" * 1000)
    assert "more than 50,000 cells" in refused(read_database, path)


def test_a_table_of_files_that_are_not_there(tmp_path) -> None:
    """Each is looked for among all files of the folder, in other spellings too."""
    for n in range(1000):
        (tmp_path / f"{n}.off").touch()
    (tmp_path / "shapes.csv").write_text("file\n" + "".join(f"{n}.OFF\nno-{n}\n" for n in range(1000)))
    database = read_database(tmp_path)
    assert (len(database.shapes), len(database.failures)) == (1000, 1000)


def test_a_cell_of_zeros(tmp_path) -> None:
    (tmp_path / "a.off").touch()
    (tmp_path / "shapes.csv").write_text("file\na.off\n" + "0" * 60_000 + "x\n")
    assert [shape.id for shape in read_database(tmp_path).shapes] == ["a"]


def test_a_count_of_thousands_of_digits(tmp_path) -> None:
    (tmp_path / "all.cla").write_text(f"PSB 1\n1 1\nc 0 {'9' * 5000}\n1\n")
    assert "stands where the number of models" in refused(read_database, tmp_path)


def test_a_table_of_millions_of_values(tmp_path) -> None:
    path = tmp_path / "shapes.json"
    path.write_text('[{"file": [' + "[]," * 5_000_000 + "0]}]")
    assert "more than 5,000,000 cells" in refused(read_database, path)


def test_a_cell_of_any_length(tmp_path) -> None:
    path = tmp_path / "shapes.json"
    path.write_text(json.dumps([{"file": "a.off", "note": "n" * 200_000}]))
    assert "longer than 131,072 letters" in refused(read_database, path)
    path = tmp_path / "shapes.csv"
    path.write_text(f"file,note\na.off,{'n' * 200_000}\n")
    assert "not CSV" in refused(read_database, path)


@pytest.mark.parametrize("name", ["shapes.csv", "shapes.json", "all.cla"])
def test_a_large_table(tmp_path, name) -> None:
    with (tmp_path / name).open("wb") as file:
        file.truncate(2**31)
    assert "larger than" in refused(read_database, tmp_path / name)


def test_a_cell_that_is_nearly_a_number() -> None:
    text = "+" + "1" * 300_000 + "x"
    assert write_cell(text) == f"'{text}"
    assert write_cell(text[:-1]) == text[:-1]


def test_a_hierarchy_of_thousands_of_levels(tmp_path) -> None:
    """Each would be a labeling."""
    (tmp_path / "m1.off").write_text("OFF")
    classes = "".join(f"c{n} {f'c{n - 1}' if n else 0} 0\n" for n in range(20_000))
    (tmp_path / "all.cla").write_text(f"PSB 1\n20001 1\n{classes}last c19999 1\n1\n")
    assert "more than 20 levels deep" in refused(read_database, tmp_path)


def npy(shape: str, kind: str = "'<f8'", data: bytes = bytes(24)) -> bytes:
    header = f"{{'descr': {kind}, 'fortran_order': False, 'shape': {shape}}}\n".encode()
    return b"\x93NUMPY\x01\0" + struct.pack("<H", len(header)) + header + data


@pytest.mark.parametrize(
    "content",
    [
        npy("(3, 99999999999)"),
        npy("(1000000000000000000000,)"),
        npy("(True,)"),
        npy("('a',)"),
        npy("(3,)", "'|O'"),
        npy("(3,)", "'|V8'"),
        npy("(3, 0)"),
        npy("()"),
        npy("(" * 900 + ")" * 900),
        npy("(3, 2001)", data=bytes(8 * 3 * (MOST_EXTERNAL_COLUMNS + 1))),
        b"",
        b"PK\x03\x04",
        b"\x80\x04.",
        b"\x93NUMPY\x03\0\xff\xff\xff\xff{",
    ],
)
def test_a_feature_file_that_is_none(tmp_path, content) -> None:
    (tmp_path / "own.npy").write_bytes(content)
    assert "own.npy" in refused(load_external, tmp_path / "own.npy", ["a", "b", "c"])


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("bins.json", "[" * 100_000 + "]" * 100_000),
        ("bins.txt", "n" * 1_000_000),
        ("bins.txt", "n" * 2_000_000),
    ],
)
def test_a_file_of_bins_that_is_none(tmp_path, name, content) -> None:
    (tmp_path / name).write_text(content)
    assert len(refused(read_bins, tmp_path / name, BLOCKS)) < 1000


# what the owner says


@pytest.mark.parametrize(
    "content",
    [
        "seed = " + "9" * 12_000,
        "title = " + "[" * 7_000 + "]" * 7_000,
        'title = "' + "a" * 12_000 + '"',
        f"title = [{'1,' * 7_000}]",
        f"{'a' * 12_000} = 1",
        ".".join("a" * 3_000) + " = 1",
        "a" * 2_000_000,
    ],
)
def test_options_of_any_length(tmp_path, content) -> None:
    (tmp_path / "shapeviz.toml").write_text(content)
    assert len(refused(load_config, tmp_path, {})) < 1000


@pytest.mark.parametrize("option", ["introduction", "logo"])
def test_a_large_file_of_the_owner(tmp_path, option) -> None:
    path = tmp_path / "file.svg"
    with path.open("wb") as file:
        file.truncate(2**31)
    assert "too large" in refused(read_publication, Config(**{option: path}))


@pytest.mark.parametrize(
    "drawing",
    [
        '<path d="{}"/>'.format("1" * 400_000),
        '<path d="{}"/>'.format("a " * 200_000),
        '<path d="{}"/>'.format(" " * 400_000),
        '<path style="fill:{}"/>'.format("url(" * 100_000),
        "<style>{}</style>".format("a" * 400_000),
        "<style>{}</style>".format("/*" * 200_000),
        "<style>{}</style>".format("a{" * 200_000),
        "<style>{}</style>".format("a," * 200_000),
    ],
)
def test_a_drawing_of_one_long_text(tmp_path, drawing) -> None:
    path = tmp_path / "logo.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{drawing}</svg>')
    with suppress(ConfigError):
        read_logo(path)


@pytest.mark.parametrize(
    "sheet", ["/**/* { filter: url(x) }", "/*/ a */ * { filter: url(x) } /*", "/* */ */ a {}"]
)
def test_what_is_behind_a_comment_is_read(tmp_path, sheet) -> None:
    path = tmp_path / "logo.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><style>{sheet}</style></svg>')
    refused(read_logo, path)
