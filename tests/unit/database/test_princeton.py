from __future__ import annotations

from pathlib import Path

import pytest

from shapeviz_report.database import read_database
from shapeviz_report.errors import DatabaseError

TRAIN = """PSB 1
6 8

aircraft 0 1
3

animal 0 0

quadruped animal 0

dog quadruped 3
1 2
4

    horse  quadruped 2
5
6
-1 0 2
7
8
"""
TEST = "PSB 1\n3 2\nanimal 0 0\nant animal 1\n101\naircraft 0 1\n102\n"
COARSE = "PSB 1\n2 4\nnatural 0 2\n1\n2\nmanmade 0 2\n3\n102\n"


def models(root: Path, *numbers: int) -> Path:
    """Models where the benchmark keeps them."""
    for number in numbers:
        path = root / "db" / str(number // 100) / f"m{number}" / f"m{number}.off"
        path.parent.mkdir(parents=True)
        path.touch()
    return root


def cla(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def labels(database, labeling):
    return {shape.path.stem: shape.labels.get(labeling) for shape in database.shapes}


def test_hierarchy(tmp_path):
    file = cla(tmp_path / "mine.cla", TRAIN)
    database = read_database(models(tmp_path, *range(1, 9)))
    assert database.layout == "princeton"
    assert database.labelings == ("mine", "mine, level 2", "mine, level 1")
    leaf = {"m1": "dog", "m2": "dog", "m3": "aircraft", "m4": "dog", "m5": "horse", "m6": "horse"}
    unlabelled = {"m7": None, "m8": None}  # the class -1
    assert labels(database, "mine") == leaf | unlabelled
    middle = {name: "aircraft" if label == "aircraft" else "quadruped" for name, label in leaf.items()}
    assert labels(database, "mine, level 2") == middle | unlabelled
    top = {name: "aircraft" if label == "aircraft" else "animal" for name, label in leaf.items()}
    assert labels(database, "mine, level 1") == top | unlabelled
    assert database.parents == {
        "mine": {"dog": "quadruped", "horse": "quadruped", "quadruped": "animal"},
        "mine, level 2": {"quadruped": "animal"},
    }
    assert database.shapes[0].id == "db/0/m1/m1"
    assert not database.failures
    assert not database.warnings
    assert read_database(file).shapes == database.shapes


def test_the_benchmarks_own_tree(tmp_path):
    root = models(tmp_path, *range(1, 9), 101, 102)
    folder = root / "classification" / "v1"
    cla(folder / "base" / "train.cla", TRAIN)
    file = cla(folder / "base" / "test.cla", TEST)
    cla(folder / "coarse1" / "coarse1Train.cla", COARSE)
    database = read_database(root)
    assert database.labelings == ("base", "base, level 2", "base, level 1", "coarse1")
    assert len(database.shapes) == 10
    by_name = {shape.path.stem: shape for shape in database.shapes}
    assert by_name["m101"].labels == {"base": "ant", "base, level 2": "ant", "base, level 1": "animal"}
    assert by_name["m101"].metadata == {"split": "test"}
    assert by_name["m1"].metadata == {"split": "train"}
    assert by_name["m1"].labels["coarse1"] == "natural"
    assert "coarse1" not in by_name["m4"].labels

    half = read_database(file)
    assert half.root == root
    assert [shape.name for shape in half.shapes] == ["ant m101", "aircraft m102"]
    assert half.labelings == ("base", "base, level 1")
    assert half.warnings == (f"8 mesh files below {root} are in no .cla file and are left out.",)


def test_several_files_are_several_labelings(tmp_path):
    cla(tmp_path / "shape.cla", "PSB 1\n2 2\nround 0 1\n1\nlong 0 1\n2\n")
    cla(tmp_path / "train.cla", "PSB 1\n1 1\ncup 0 1\n1\n")
    cla(tmp_path / "test.cla", "PSB 1\n1 1\ncup 0 1\n2\n")
    database = read_database(models(tmp_path, 1, 2))
    assert database.labelings == ("shape", "class")
    assert [(shape.labels, shape.metadata["split"]) for shape in database.shapes] == [
        ({"shape": "round", "class": "cup"}, "train"),
        ({"shape": "long", "class": "cup"}, "test"),
    ]


def test_files_of_one_name_are_told_apart_by_their_folders(tmp_path):
    for version in ("v1", "v2"):
        cla(tmp_path / "classification" / version / "base.cla", "PSB 1\n1 1\ncup 0 1\n1\n")
    database = read_database(models(tmp_path, 1))
    assert database.labelings == ("classification/v1/base", "classification/v2/base")


def test_models_without_the_letter_and_of_other_formats(tmp_path):
    for name in ("D1.obj", "m2.stl", "deep/m2.off", "unlisted.off"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    cla(tmp_path / "a.cla", "PSB 1\n1 2\ncup 0 2\nD1\n2\n")
    database = read_database(tmp_path)
    assert [shape.id for shape in database.shapes] == ["D1", "deep/m2"]
    assert "1 mesh files" in database.warnings[0]


def test_models_without_a_mesh(tmp_path):
    cla(tmp_path / "a.cla", "PSB 1\n1 2\ncup 0 2\n1\n2\n")
    database = read_database(models(tmp_path, 1))
    assert [shape.name for shape in database.shapes] == ["cup m1"]
    (failure,) = database.failures
    assert failure.path == "m2.off"
    assert "a.cla lists the model 2" in failure.reason


def test_counts_and_second_classes_are_warned_of(tmp_path):
    cla(tmp_path / "a.cla", "PSB 1\n9 9\ncup 0 1\n1\nant 0 2\n1\n2\n")
    database = read_database(models(tmp_path, 1, 2))
    assert labels(database, "a") == {"m1": "cup", "m2": "ant"}
    assert database.warnings == (
        "a.cla announces 9 classes and 9 models, but holds 2 classes and 3 models.",
        "In a.cla the model 1 is in a second class, 'ant'; it keeps 'cup'.",
    )


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "cut off"),
        ("OFF 1", "does not begin with 'PSB 1'"),
        ("PSB 2\n1 1\ncup 0 0\n", "version 2"),
        ("PSB 1\n1 one\n", "line 2: 'one' stands where the number of models"),
        ("PSB 1\n1 1\ncup 0\n", "ends where the number of models of the class 'cup'"),
        ("PSB 1\n1 3\ncup 0 3\n1\n2\n", "ends where a model of the class 'cup'"),
        ("PSB 1\n1 1\ncup 0 -1\n", "line 3: '-1' stands"),
        (
            "PSB 1\n1 1\ndog animal 1\n1\n",
            "line 3: the parent 'animal' of the class 'dog' is not defined above",
        ),
        ("PSB 1\n2 0\ncup 0 0\n\ncup 0 0\n", "line 5: the class 'cup' is defined a second time"),
    ],
)
def test_file_that_is_wrong(tmp_path, text, reason):
    cla(tmp_path / "a.cla", text)
    with pytest.raises(DatabaseError, match=reason):
        read_database(models(tmp_path, 1))


def test_folder_without_cla_by_name(tmp_path):
    with pytest.raises(DatabaseError, match=r"no \.cla file"):
        read_database(models(tmp_path, 1), layout="princeton")


def test_padded_numbers_where_only_one_mesh_has_them(tmp_path):
    cla(tmp_path / "c.cla", "PSB 1\n1 3\ncup 0 3\n1\n2\n3\n")
    for name in ("D00001", "D2", "E2", "T3_x"):
        (tmp_path / f"{name}.off").write_text("OFF")
    database = read_database(tmp_path)
    assert [shape.id for shape in database.shapes] == ["D00001"]
    assert [failure.path for failure in database.failures] == ["m2.off", "m3.off"]
