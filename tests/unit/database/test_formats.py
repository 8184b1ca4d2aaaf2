import pytest

from shapeviz_report.database.formats import is_read, is_unread_mesh, split_name, why_not_read


@pytest.mark.parametrize(
    "name",
    [
        "a.off",
        "A.OBJ",
        "b.Ply",
        "c.stl",
        "d.glb",
        "e.gltf",
        "f.3mf",
        "g.dae",
        "h.i.off",
        "a.stl.gz",
        "A.b.OBJ.Zip",
    ],
)
def test_read(name):
    assert is_read(name)
    assert not is_unread_mesh(name)


@pytest.mark.parametrize(
    "name",
    ["a.max", "a.3ds", "a.BLEND", "a.fbx", "a.step", "a.stl.bz2", "a.fbx.zip", "a.wrl", "a.obj.gz.zip"],
)
def test_mesh_of_a_format_that_is_not_read(name):
    assert not is_read(name)
    assert is_unread_mesh(name)


@pytest.mark.parametrize(
    "name",
    [
        "README",
        "a.txt",
        "a.jpg",
        "a.mtl",
        "a.bin",
        "a.off.md5",
        "notes.gz",
        "pictures.zip",
        "off",
        ".off",
        "a.",
    ],
)
def test_no_mesh_at_all(name):
    assert not is_read(name)
    assert not is_unread_mesh(name)


def test_the_reason_says_what_to_do():
    assert why_not_read("a.stl.xz") == (
        "compressed files (.xz) are not read; unpack it first, or pack it as .stl.gz"
    )
    assert "packed twice" in why_not_read("a.stl.gz.gz")
    assert why_not_read("a.zip").endswith("call it NAME.obj.zip, for instance")
    assert why_not_read("a.fbx.zip").startswith("files of format .fbx are not read; convert it")
    assert ".max" in why_not_read("a.MAX")
    assert ".gltf" in why_not_read("a.MAX")
    assert "no suffix" in why_not_read("m123")


@pytest.mark.parametrize(
    ("name", "parts"),
    [
        ("chair.obj", ("chair", ".obj")),
        ("chair.v2.OBJ.GZ", ("chair.v2", ".obj.gz")),
        ("a/b.c/chair.ply.zip", ("a/b.c/chair", ".ply.zip")),
        ("chair.zip", ("chair", ".zip")),
        ("chair.txt.gz", ("chair.txt", ".gz")),
        (".obj.gz", (".obj", ".gz")),
        ("chair", ("chair", "")),
    ],
)
def test_names_in_two(name, parts):
    assert split_name(name) == parts
