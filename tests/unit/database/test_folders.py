"""The layouts that are folders and nothing else: class folders, ModelNet, flat."""

from __future__ import annotations

import os
import random
import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapeviz_report.database import read_database
from shapeviz_report.database.base import display_names, shape_names
from shapeviz_report.errors import DatabaseError
from shapeviz_report.order import natural
from shapeviz_report.types import Database
from shapeviz_report.writing.record import record_text


def make(root: Path, *files: str | bytes) -> Path:
    """Create empty files: a database is read without looking into its meshes."""
    for file in files:
        path = root / os.fsdecode(file)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    return root


def labels(database: Database, labeling: str) -> dict[str, str | None]:
    return {shape.id: shape.labels.get(labeling) for shape in database.shapes}


def failures(database: Database) -> dict[str, str]:
    assert all(failure.stage == "read" for failure in database.failures)
    return {failure.path: failure.reason for failure in database.failures}


def test_class_folders(tmp_path):
    database = read_database(make(tmp_path / "zoo", "cup/2.off", "cup/1.obj", "ant/1.OFF"))
    assert (database.layout, database.name, database.root) == ("class-folders", "zoo", tmp_path / "zoo")
    assert database.labelings == ("class",)
    assert labels(database, "class") == {"ant/1": "ant", "cup/1": "cup", "cup/2": "cup"}
    assert [shape.id for shape in database.shapes] == ["ant/1", "cup/1", "cup/2"]
    assert [shape.name for shape in database.shapes] == ["ant 1", "cup 1", "cup 2"]
    assert database.shapes[0].path == tmp_path / "zoo" / "ant" / "1.OFF"
    assert not database.failures
    assert not database.parents


def test_deeper_folders_are_a_hierarchy(tmp_path):
    make(tmp_path, "animal/dog/1.off", "animal/dog/2.off", "animal/ant/red/1.off", "animal/ant/red/2.off")
    make(tmp_path, "tool/1.off", "tool/2.off", "stray.off")
    database = read_database(tmp_path)
    assert database.labelings == ("class", "folder")
    assert labels(database, "class")["animal/ant/red/1"] == "animal"
    assert labels(database, "folder") == {
        "animal/ant/red/1": "animal/ant/red",
        "animal/ant/red/2": "animal/ant/red",
        "animal/dog/1": "animal/dog",
        "animal/dog/2": "animal/dog",
        "stray": None,
        "tool/1": "tool",
        "tool/2": "tool",
    }
    assert database.parents == {
        "folder": {"animal/ant": "animal", "animal/ant/red": "animal/ant", "animal/dog": "animal"}
    }


def test_a_folder_for_each_shape_is_no_class(tmp_path):
    make(tmp_path, "cup/001/model.obj", "cup/002/model.obj", "ant/003/model.obj")
    database = read_database(tmp_path)
    assert database.labelings == ("class",)
    assert labels(database, "class") == {
        "ant/003/model": "ant",
        "cup/001/model": "cup",
        "cup/002/model": "cup",
    }


def test_modelnet(tmp_path):
    make(tmp_path, "desk/train/desk_1.off", "desk/test/desk_2.off", "night_stand/Train/night_stand_1.off")
    database = read_database(tmp_path)
    assert database.layout == "modelnet"
    assert database.labelings == ("class",)
    assert [(shape.id, shape.labels["class"], shape.metadata["split"]) for shape in database.shapes] == [
        ("desk/test/desk_2", "desk", "test"),
        ("desk/train/desk_1", "desk", "train"),
        ("night_stand/Train/night_stand_1", "night_stand", "train"),
    ]


def test_modelnet_by_name_wants_the_splits(tmp_path):
    with pytest.raises(DatabaseError, match="CLASS/train or CLASS/test"):
        read_database(make(tmp_path, "desk/desk_1.off"), layout="modelnet")


def test_flat(tmp_path):
    database = read_database(make(tmp_path, "b.off", "a.off"))
    assert database.layout == "flat"
    assert database.labelings == ()
    assert [(shape.id, dict(shape.labels)) for shape in database.shapes] == [("a", {}), ("b", {})]


def test_flat_by_name_ignores_the_folders(tmp_path):
    database = read_database(make(tmp_path, "cup/1.off", "ant/1.off"), layout="flat")
    assert [(shape.id, dict(shape.labels)) for shape in database.shapes] == [("ant/1", {}), ("cup/1", {})]


def test_what_is_no_mesh_is_passed_over(tmp_path):
    make(tmp_path, "cup/1.off", "cup/1.mtl", "cup/1.jpg", "cup/1.off.md5", "cup/.hidden.off", "cup/._1.off")
    make(tmp_path, "README", "Thumbs.db", ".cache/2.off", "__MACOSX/cup/1.off", "cup/scene.bin")
    database = read_database(tmp_path)
    assert [shape.id for shape in database.shapes] == ["cup/1"]
    assert not database.failures


def test_the_gltf_of_a_site_is_no_shape_of_the_database_around_it(tmp_path):
    make(tmp_path, "1.off", "site/gltf/2.glb", "gltf/3.glb", "other/gltf/4.glb")
    for site, record in (("site", record_text({})), ("other", b'{"of": "somebody else"}')):
        (tmp_path / site / "data").mkdir()
        (tmp_path / site / "data" / "files.json").write_bytes(record)
    assert [shape.id for shape in read_database(tmp_path).shapes] == ["1", "gltf/3", "other/gltf/4"]
    assert [shape.id for shape in read_database(tmp_path / "site" / "gltf").shapes] == ["2"]


def test_other_3d_formats_are_failures_that_say_what_is_read(tmp_path):
    database = read_database(make(tmp_path, "cup/1.off", "cup/2.max", "cup/3.stl.bz2", "4.FBX"))
    assert [shape.id for shape in database.shapes] == ["cup/1"]
    assert list(failures(database)) == ["4.FBX", "cup/2.max", "cup/3.stl.bz2"]
    assert all(suffix in failures(database)["cup/2.max"] for suffix in (".max", ".off", ".gltf", ".3mf"))


@pytest.mark.parametrize("file", ["1.blend", "cup/1.blend"])
def test_folder_in_which_everything_fails(tmp_path, file):
    database = read_database(make(tmp_path, file))
    assert not database.shapes
    assert list(failures(database)) == [file]


@pytest.mark.parametrize("files", [[], ["README.txt"], ["cup/README.txt"]])
def test_nothing_to_read(tmp_path, files):
    with pytest.raises(DatabaseError, match=r"No shapes were found.*\.off.*\n.*princeton.*(\n.*)*flat"):
        read_database(make(tmp_path, *files))


def test_path_that_does_not_exist(tmp_path):
    with pytest.raises(DatabaseError, match="no such file"):
        read_database(tmp_path / "missing")


def test_file_instead_of_a_folder(tmp_path):
    with pytest.raises(DatabaseError, match="neither a folder"):
        read_database(make(tmp_path, "a.txt") / "a.txt")
    with pytest.raises(DatabaseError, match="is a mesh, not a database; give the folder that it lies in"):
        read_database(make(tmp_path, "a.off") / "a.off")
    for layout in ("class-folders", "modelnet", "flat", "princeton", "table"):
        with pytest.raises(DatabaseError):
            read_database(tmp_path / "a.off", layout=layout)


def test_links_are_followed_but_not_in_circles(tmp_path):
    elsewhere = make(tmp_path / "elsewhere", "1.off", "2.off")
    root = make(tmp_path / "root", "ant/1.off")
    (root / "cup").symlink_to(elsewhere)
    (root / "ant" / "2.off").symlink_to(elsewhere / "2.off")
    (root / "ant" / "3.off").symlink_to(elsewhere / "missing.off")
    (root / "ant" / "up").symlink_to(root)
    (root / "self").symlink_to(root / "self")
    database = read_database(root)
    assert labels(database, "class") == {"ant/1": "ant", "ant/2": "ant", "cup/1": "cup", "cup/2": "cup"}
    assert set(failures(database)) == {"ant/3.off", "ant/up", "self"}
    assert "not there" in failures(database)["ant/3.off"]
    assert "contains it" in failures(database)["ant/up"]


def test_special_file(tmp_path):
    make(tmp_path, "cup/1.off")
    os.mkfifo(tmp_path / "cup" / "2.off")
    database = read_database(tmp_path)
    assert failures(database) == {"cup/2.off": "this is not a regular file"}


@pytest.fixture
def unprivileged():
    """Root may open any folder, so a test that runs as root steps down for a while."""
    if os.geteuid() != 0:
        yield
        return
    os.seteuid(65534)
    yield
    os.seteuid(0)


def test_folder_that_cannot_be_opened(unprivileged):
    with tempfile.TemporaryDirectory() as name:
        root = make(Path(name), "cup/1.off", "ant/1.off")
        (root / "ant").chmod(0)
        try:
            database = read_database(root)
            assert [shape.id for shape in database.shapes] == ["cup/1"]
            assert "cannot be opened" in failures(database)["ant"]
            root.chmod(0)
            with pytest.raises(DatabaseError):
                read_database(root)
        finally:
            root.chmod(0o700)
            (root / "ant").chmod(0o700)


def test_ids_are_unique_whatever_the_names(tmp_path):
    latin, utf8 = "cup/Tasse-ü.off".encode("latin-1"), "cup/Tasse-ü.off".encode()
    make(
        tmp_path,
        "cup/1.off",
        "cup/1.obj",
        "cup/1.OBJ",
        "cup/2.off",
        "cup/2.off.obj",
        "cup/3.obj",
        latin,
        utf8,
    )
    ids = [shape.id for shape in read_database(tmp_path).shapes]
    assert ids == sorted(ids, key=natural)
    assert len(set(ids)) == 8
    assert {"cup/1.off", "cup/1.obj", "cup/1.OBJ", "cup/2.off.obj", "cup/3", "cup/Tasse-ü.off"} < set(ids)
    assert "".join(ids).encode("utf-8")


def test_names_are_data(tmp_path):
    strange = ['"quoted"', "🐙 octopus", "</script>", "two\nlines", "  spaces  ", "a'b;c,d", "%2e%2e", "-rf"]
    strange = [name.replace("/", "\\") for name in strange]
    database = read_database(make(tmp_path, *(f"{name}/{name}.off" for name in strange)))
    assert {shape.labels["class"] for shape in database.shapes} == {name.strip() for name in strange}
    assert {shape.id for shape in database.shapes} == {f"{name}/{name}" for name in strange}


def test_folders_that_differ_by_normal_form_are_one_class(tmp_path):
    make(tmp_path, "Mu\u0308nze/1.off", "M\u00fcnze/1.off")
    database = read_database(tmp_path)
    assert len(database.shapes) == 2
    assert {shape.labels["class"] for shape in database.shapes} == {"M\u00fcnze"}


def test_folder_without_a_name_to_speak_of_is_no_class(tmp_path):
    database = read_database(make(tmp_path, " /1.off", "cup/1.off"))
    assert labels(database, "class") == {" /1": None, "cup/1": "cup"}


def test_order_of_creation_does_not_matter(tmp_path):
    files = [f"{label}/{number}.off" for label in ("b", "a", "c") for number in range(20)] + [
        "a/x.max",
        "b/x.max",
    ]
    databases = []
    for seed in range(3):
        random.Random(seed).shuffle(files)
        databases.append(read_database(make(tmp_path / str(seed) / "zoo", *files)))
    views = [
        ([(shape.id, shape.labels) for shape in database.shapes], database.failures, database.labelings)
        for database in databases
    ]
    assert views[0] == views[1] == views[2]


def test_choice_of_layout_name_and_labeling(tmp_path):
    make(tmp_path, "animal/dog/1.off", "animal/dog/2.off", "tool/1.off")
    database = read_database(tmp_path, layout="class-folders", labeling="folder", name="My zoo")
    assert database.labelings == ("folder", "class")
    assert database.name == "My zoo"
    with pytest.raises(DatabaseError, match=r"no labeling 'colour'.*'class', 'folder'"):
        read_database(tmp_path, labeling="colour")
    with pytest.raises(DatabaseError, match=r"no layout 'tree'.*'princeton', 'table', 'modelnet'"):
        read_database(tmp_path, layout="tree")


def test_no_labeling_to_choose(tmp_path):
    with pytest.raises(DatabaseError, match="labelings: none"):
        read_database(make(tmp_path, "1.off"), labeling="class")


def test_names_tell_shapes_apart(tmp_path):
    files = [
        f"{shape}/models/model.obj" for shape in ("chair/1a04", "chair/1b21", "table/2c77", "table/1a04")
    ]
    database = read_database(make(tmp_path / "net", *files))
    assert {shape.id: shape.name for shape in database.shapes} == {
        "chair/1a04/models/model": "chair 1a04",
        "chair/1b21/models/model": "1b21",
        "table/1a04/models/model": "table 1a04",
        "table/2c77/models/model": "2c77",
    }
    database = read_database(make(tmp_path / "twice", "cup.off", "cup.ply", "ant.off"))
    assert [shape.name for shape in database.shapes] == ["ant", "cup.off", "cup.ply"]


@pytest.mark.parametrize(
    ("ids", "names"),
    [
        (["c/1a/models/m", "d/2b/models/m"], ["1a", "2b"]),
        # A stray file, beside the folders, in one of them, or of the same name, makes no name of the others longer.
        (["c/1a/models/m", "c/2b/models/m", "d/3c/models/m", "c/stray"], ["1a", "2b", "3c", "stray"]),
        (["c/1a/models/m", "c/2b/models/m", "d/3c/models/m", "c/1a/models/x"], ["1a", "2b", "3c", "x"]),
        (["c/1a/models/m", "c/2b/models/m", "d/3c/models/m", "c/m"], ["1a", "2b", "3c", "c/m"]),
        (["c/1a/models/m", "c/2b/models/m", "z/a/1", "z/b/1"], ["1a", "2b", "a", "b"]),
        # A folder that repeats in another class gets its class; the others do not.
        (["c/10/models/m", "d/10/models/m", "c/2/models/m"], ["c/10", "d/10", "2"]),
        (["cup/1", "cup/2", "ant/1", "ant/3"], ["cup/1", "2", "ant/1", "3"]),
        (["b/x/m", "a/y/m"], ["x", "y"]),
        (["x/m", "y/m", "x"], ["x/m", "y", "x"]),
    ],
)
def test_names_are_no_longer_than_needed(ids, names):
    assert shape_names(ids) == names


@given(
    st.sets(st.lists(st.sampled_from("abm"), min_size=1, max_size=4).map("/".join), min_size=1, max_size=9)
)
def test_no_two_names_are_equal(ids):
    names = shape_names(sorted(ids))
    assert len(set(names)) == len(ids)
    assert all(names)


@pytest.mark.parametrize(
    ("names", "labels", "called"),
    [
        (["61", "62"], ["airplane", None], ["airplane 61", "62"]),
        (["chair/03", "sofa/03"], ["chair", "sofa"], ["chair 03", "sofa 03"]),
        (["m1204", "1a04", "2024-05"], ["cup", "cup", "Krüge"], ["cup m1204", "1a04", "Krüge 2024-05"]),
        # Folders that are no class, and names that tell something, stay.
        (["batch/3", "Amphora, left"], ["cup", "cup"], ["batch/3", "Amphora, left"]),
        # No two are called the same.
        (["cup 1", "1"], ["cup", "cup"], ["cup 1", "1"]),
        (["1", "2"], ["", " "], ["1", "2"]),
    ],
)
def test_numbers_are_called_with_their_class(names, labels, called):
    assert display_names(names, labels) == called
    assert len(set(called)) == len(called)


def test_companions_of_a_mesh_are_no_failures(tmp_path):
    files = ["a/cup.obj", "a/cup.solid.binvox", "a/cup.step", "a/cup.obj.gz", "a/ant.step", "b/cup.binvox"]
    database = read_database(make(tmp_path / "net", *files))
    assert set(failures(database)) == {"a/ant.step", "b/cup.binvox"}


def test_packed_meshes_are_called_as_what_is_in_them(tmp_path):
    database = read_database(make(tmp_path, "cup/1.off.gz", "cup/2.OBJ.zip", "ant/1.ply", "ant/other.zip"))
    assert database.layout == "class-folders"
    assert [shape.id for shape in database.shapes] == ["ant/1", "cup/1", "cup/2"]
    assert not database.failures


def test_a_mesh_and_the_same_packed_beside_it_are_one_shape(tmp_path):
    database = read_database(make(tmp_path, "cup/1.off", "cup/1.off.gz", "cup/1.obj.gz", "cup/2.off.zip"))
    assert [shape.id for shape in database.shapes] == ["cup/1.obj.gz", "cup/1.off", "cup/2"]


def test_tables_and_classifications_find_packed_meshes(tmp_path):
    make(tmp_path, "a.off.gz", "b.stl.zip", "c.zip")
    (tmp_path / "t.csv").write_text("file,label\na,x\nb.stl.zip,y\nc.zip,z\n")
    database = read_database(tmp_path)
    assert [(shape.id, shape.path.name) for shape in database.shapes] == [
        ("a", "a.off.gz"),
        ("b", "b.stl.zip"),
    ]
    assert failures(database).keys() == {"c.zip"}
    assert "does not tell the format" in failures(database)["c.zip"]
