"""Meshes in files of gzip and ZIP."""

from __future__ import annotations

import io
import json
import warnings
import zipfile
from functools import partial
from gzip import compress
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shapeviz_report.building.stages import identify
from shapeviz_report.errors import MeshError
from shapeviz_report.mesh import collect_files, looks, packed, parse_mesh, parse_painted
from shapeviz_report.mesh.read import read_mesh
from shapeviz_report.mesh.readers import limits

BOX = trimesh.creation.box((1, 2, 3))
OBJ = BOX.export(file_type="obj").encode()


# Without the time, which would be in the names of tests: those must be the same in every process.
gzipped = partial(compress, mtime=0)


def zipped(files: dict[str, bytes], compression: int = zipfile.ZIP_DEFLATED) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", compression) as archive, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of two files of one name
        for name, content in files.items():
            archive.writestr(name.removesuffix("\0"), content)
    return file.getvalue()


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.obj.gz", gzipped(OBJ)),
        ("a.OBJ.GZ", gzipped(OBJ[:100]) + gzipped(OBJ[100:])),
        ("a.obj.gz", gzipped(OBJ) + bytes(512)),
        ("a.obj.zip", zipped({"other name.obj": OBJ})),
        ("a.obj.zip", zipped({"a.obj": OBJ}, zipfile.ZIP_STORED)),
        ("a.obj.zip", zipped({"a.obj": OBJ}, zipfile.ZIP_LZMA)),
        ("a.obj.zip", zipped({"__MACOSX/a.obj": b"?", "box/": b"", "box/a.OBJ": OBJ, "a.mtl": b"", "._a.obj": b""})),
        ("a.obj.zip", zipped({"../../etc/a.obj": OBJ})),
        ("a.glb.gz", gzipped(BOX.export(file_type="glb"))),
        ("a.3mf.gz", gzipped(BOX.export(file_type="3mf"))),
        ("a.stl.zip", zipped({"a.stl": BOX.export(file_type="stl")})),
    ],
)  # fmt: skip
def test_the_mesh_in_it_is_read(tmp_path, name, content) -> None:
    (tmp_path / name).write_bytes(content)
    mesh = read_mesh(tmp_path / name)
    assert trimesh.Trimesh(mesh.vertices, mesh.faces).volume == pytest.approx(6)
    assert sorted(path.name for path in tmp_path.rglob("*")) == [name], "nothing is unpacked onto the disk"


def test_a_gltf_and_its_buffers(tmp_path) -> None:
    files = BOX.scene().export(file_type="gltf")
    (gltf,) = [name for name in files if name.endswith(".gltf")]
    inside = {f"box/{name}": content for name, content in files.items()}
    (tmp_path / "a.gltf.zip").write_bytes(zipped({"readme.txt": b"x", **inside}))
    mesh = read_mesh(tmp_path / "a.gltf.zip")
    assert trimesh.Trimesh(mesh.vertices, mesh.faces).volume == pytest.approx(6)
    for name, content, reason in (
        (
            "b.gltf.gz",
            gzipped(files[gltf]),
            r"refers to '.*bin', .* not in it: pack both as \.gltf\.zip",
        ),
        ("b.gltf.zip", zipped({gltf: files[gltf]}), r"refers to '.*bin', which is not in it$"),
    ):
        (tmp_path / name).write_bytes(content)
        with pytest.raises(MeshError, match=reason):
            read_mesh(tmp_path / name)
    outside = json.loads(files[gltf])
    outside["buffers"][0]["uri"] = "../secret.bin"
    (tmp_path / "c.gltf.zip").write_bytes(
        zipped({"x/a.gltf": json.dumps(outside).encode(), "secret.bin": b""})
    )
    with pytest.raises(MeshError, match="is not a file in its own folder"):
        read_mesh(tmp_path / "c.gltf.zip")


def test_colours_in_an_archive_are_found() -> None:
    files = {
        "shape/a.obj": b"mtllib ../looks/A.mtl\nusemtl red\n" + OBJ,
        "looks/a.mtl": b"newmtl red\nKd 1 0 0\nmap_Ka no.png\nnewmtl other\nmap_Kd missing.png\n",
    }
    _, paint = parse_painted({"a.obj.zip": zipped(files)})
    assert paint is not None
    assert (paint().colors == (255, 0, 0)).all()
    assert paint().lost == ()
    by_windows = {name.replace("/", "\\"): content for name, content in files.items()}
    _, paint = parse_painted({"a.obj.zip": zipped(by_windows)})
    assert paint().lost == ()
    _, paint = parse_painted({"a.obj.zip": zipped({"a.obj": files["shape/a.obj"]})})
    assert paint is not None
    assert len(paint().lost) == 1


def test_colours_in_an_archive_are_bounded(monkeypatch) -> None:
    monkeypatch.setattr(looks, "MOST_LOOKS", 10_000)
    material = b"newmtl red\nKd 1 0 0\n" + bytes(20_000)
    _, paint = parse_painted({"a.obj.zip": zipped({"a.obj": b"mtllib a.mtl\n" + OBJ, "a.mtl": material})})
    assert paint is not None
    assert "too large" in paint().lost[0]


POINTER = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 3\n"


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("a.obj.gz", b"", "the file is empty"),
        ("a.obj.gz", gzipped(b""), "the file in it is empty"),
        ("a.obj.gz", OBJ, "not compressed with gzip, but seems to be OBJ"),
        ("a.obj.gz", bytes(100), "not compressed with gzip, or damaged"),
        ("a.obj.gz", gzipped(OBJ)[:-12], "cut off: its compressed content has no end"),
        ("a.obj.gz", gzipped(OBJ)[:40] + b"xxxx" + gzipped(OBJ)[44:], "gzip, or damaged|cut off"),
        ("a.obj.gz", gzipped(gzipped(OBJ)), "not OBJ, but seems to be compressed with gzip; unpack it"),
        ("a.obj.gz", gzipped(BOX.export(file_type="ply")), "it is not OBJ, but seems to be PLY"),
        ("a.obj.zip", POINTER, "no ZIP archive, but seems to be a Git LFS pointer, .*; fetch it"),
        ("a.obj.zip", b"<!DOCTYPE html><title>404", "no ZIP archive, but seems to be a web page"),
        ("a.obj.zip", zipped({"a.obj": OBJ})[:-30], "no ZIP archive, or damaged"),
        ("a.obj.zip", zipped({}), r"it holds no \.obj file$"),
        ("a.obj.zip", zipped({"a.stl": b"", "b.txt": b""}), r"it holds no \.obj file, but a\.stl, b\.txt$"),
        ("a.obj.zip", zipped({"a.obj": OBJ, "b.obj": OBJ}), r"holds 2 meshes \(a\.obj, b\.obj\)"),
        ("a.obj.zip", zipped({"a.obj": OBJ, "a.obj\0": OBJ}), r"holds 2 meshes \(a\.obj, a\.obj\)"),
        ("a.obj.zip", zipped({f"{i}.obj": b"" for i in range(9)}), r"9 meshes \(0.*, 2\.obj, \.\.\.\), and not one"),
        ("a.off.zip", zipped({"a.off": b" "}), "the file in it is empty"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_it_is_said(name, content, reason) -> None:
    with pytest.raises(MeshError, match=reason):
        parse_mesh({name: content})


def test_what_unpacks_to_too_much_is_refused_before_it_has(monkeypatch) -> None:
    monkeypatch.setattr(limits, "MOST_UNPACKED", 10_000_000)
    monkeypatch.setattr(packed, "MOST_UNPACKED", 10_000_000)
    bomb = gzipped(bytes(50_000_000), 1)
    for name, content in (("a.off.gz", bomb), ("a.off.zip", zipped({"a.off": bytes(20_000_000)}))):
        with pytest.raises(MeshError, match="it unpacks to more than 10 MiB"):
            parse_mesh({name: content})
    lying = zipped({"a.off": bytes(20_000_000)}).replace(
        (20_000_000).to_bytes(4, "little"), (100).to_bytes(4, "little")
    )
    with pytest.raises(MeshError, match="it is damaged"):
        parse_mesh({"a.off.zip": lying})


def test_an_encrypted_archive(monkeypatch) -> None:
    content = bytearray(zipped({"a.obj": OBJ}))
    for head, flags in ((b"PK\3\4", 6), (b"PK\1\2", 8)):
        content[content.index(head) + flags] |= 1
    with pytest.raises(MeshError, match="it is encrypted"):
        parse_mesh({"a.obj.zip": bytes(content)})


def test_damaged_archives_end_in_a_sentence() -> None:
    random = np.random.default_rng(0)
    for name, content in (("a.obj.zip", zipped({"a.obj": OBJ})), ("a.obj.gz", gzipped(OBJ))):
        refused = 0
        for _ in range(200):
            damaged = bytearray(content)
            for place in random.integers(0, len(damaged), 2):
                damaged[place] = random.integers(256)
            try:
                parse_mesh({name: bytes(damaged)})
            except MeshError:
                refused += 1
        assert refused > 100


def test_the_format_is_part_of_what_identifies_it(tmp_path: Path) -> None:
    content = gzipped(OBJ)
    for name in ("a.obj.gz", "b.OBJ.gz", "a.off.gz"):
        (tmp_path / name).write_bytes(content)
    one, same, other = (
        identify(collect_files(tmp_path / name)) for name in ("a.obj.gz", "b.OBJ.gz", "a.off.gz")
    )
    assert one == same != other
