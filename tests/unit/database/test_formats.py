import pytest

from shapeviz_report.database.formats import is_read, is_unread_mesh, why_not_read


@pytest.mark.parametrize(
    "name", ["a.off", "A.OBJ", "b.Ply", "c.stl", "d.glb", "e.gltf", "f.3mf", "g.dae", "h.i.off"]
)
def test_read(name):
    assert is_read(name)
    assert not is_unread_mesh(name)


@pytest.mark.parametrize(
    "name", ["a.max", "a.3ds", "a.BLEND", "a.fbx", "a.step", "a.stl.gz", "a.fbx.zip", "a.wrl"]
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
    assert "unpack" in why_not_read("a.stl.gz")
    assert ".max" in why_not_read("a.MAX")
    assert ".gltf" in why_not_read("a.MAX")
    assert "no suffix" in why_not_read("m123")
