from __future__ import annotations

import json
import os
import random
from pathlib import Path

import pytest

from shapeviz_report.database import read_database
from shapeviz_report.errors import DatabaseError


@pytest.fixture
def root(tmp_path) -> Path:
    for name in ("a.off", "b.obj", "deep/c.ply", "d.off", "e.fbx"):
        path = tmp_path / "db" / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.touch()
    return tmp_path / "db"


def table(root: Path, text: str | bytes, name: str = "shapes.csv") -> Path:
    path = root / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def as_read(database):
    return [(shape.id, dict(shape.labels), dict(shape.metadata)) for shape in database.shapes]


EXPECTED = [
    ("a", {"label": "cup"}, {"author": "Ada", "year": "1990"}),
    ("b", {"label": "ant"}, {"year": "1991"}),
    ("deep/c", {}, {"author": "Bob"}),
]


@pytest.mark.parametrize(
    "text",
    [
        "file,label,author,year\na.off,cup,Ada,1990\nb.obj,ant,,1991\ndeep/c.ply,,Bob,\n",
        "file;label;author;year\na.off;cup;Ada;1990\nb.obj;ant;;1991\ndeep/c.ply;;Bob;\n",
        "file\tlabel\tauthor\tyear\na.off\tcup\tAda\t1990\nb.obj\tant\t\t1991\ndeep/c.ply\t\tBob\t\n",
        "\ufefffile,label,author,year\r\na.off,cup,Ada,1990\r\nb.obj,ant,,1991\r\ndeep/c.ply,,Bob\r\n",
        ' File , LABEL ,author,year,\n" a.off ", cup ,Ada,1990,\n\n./b.obj,ant,,1991,\ndeep\\c.ply,,Bob,,\n,,,,\n',
        "file,label,author,year\na.off,cup,Ada,1990\nb.obj,ant,,1991\ndeep/c.ply,,Bob,\n".encode("utf-16"),
    ],
)
def test_csv(root, text):
    database = read_database(table(root, text))
    assert (database.layout, database.name, database.root) == ("table", "db", root)
    assert as_read(database) == EXPECTED
    assert database.labelings == ("label",)
    assert not database.failures
    assert database.warnings == (f"1 mesh file below {root} is not in shapes.csv and is left out.",)
    assert all(shape.path.is_file() for shape in database.shapes)
    assert as_read(read_database(root)) == EXPECTED  # the folder as well


def test_json(root):
    rows = [
        {"file": "deep/c.ply", "label": None, "author": "Bob"},
        {"file": "a.off", "label": "cup", "year": 1990, "author": "Ada"},
        {"year": 1991, "file": "b.obj", "label": " ant "},
    ]
    database = read_database(table(root, json.dumps(rows), "shapes.json"))
    assert as_read(database) == EXPECTED
    assert as_read(read_database(root)) == EXPECTED


def test_json_values_become_text(root):
    row = {
        "file": "a.off",
        "label": True,
        "parts": [1, 2],
        "size": 1.5,
        "note": "\ud800",
        "none": None,
        "void": "",
    }
    (shape,) = read_database(table(root, json.dumps([row]), "shapes.json")).shapes
    assert shape.labels == {"label": "true"}
    assert shape.metadata == {"parts": "[1, 2]", "size": "1.5", "note": "\N{REPLACEMENT CHARACTER}" * 3}


def test_latin_1_is_read_and_said(root):
    database = read_database(table(root, "file,label\na.off,Flügel\n".encode("latin-1")))
    assert database.shapes[0].labels == {"label": "Flügel"}
    assert "not UTF-8" in database.warnings[0]


def test_cells_are_data(root):
    label = 'a "quoted" </script>\n🐙, second line; third'
    quoted = '"' + label.replace('"', '""') + '"'
    database = read_database(table(root, f"file,label,note\na.off,{quoted},{'x' * 100_000}\n"))
    assert database.shapes[0].labels == {"label": label}
    assert len(database.shapes[0].metadata["note"]) == 100_000


def test_rows_that_cannot_be_taken(root):
    database = read_database(
        table(
            root,
            "file,label\na.off,cup\nmissing.off,cup\ne.fbx,cup\nm123,cup\ndeep,cup\n,cup\n"
            "d.off,cup\nd.off,ant\nb.obj,ant\n./b.obj,ant\nhttp://example.org/x.off,cup\n",
        )
    )
    assert [shape.id for shape in database.shapes] == ["a", "b"]
    reasons = {failure.path: failure.reason for failure in database.failures}
    assert set(reasons) == {
        "missing.off", "e.fbx", "m123", "deep", "shapes.csv, line 7", "d.off", "http:/example.org/x.off"
    }  # fmt: skip
    assert "line 3), but it is not there" in reasons["missing.off"]
    assert ".fbx are not read" in reasons["e.fbx"]
    assert "a folder" in reasons["deep"]
    assert "empty" in reasons["shapes.csv, line 7"]
    assert "2 times with different values (line 8, line 9)" in reasons["d.off"]
    assert (
        database.warnings[0]
        == "1 file stands in shapes.csv more than once with the same values and is taken once: b.obj."
    )


def test_all_rows_fail(root):
    database = read_database(table(root, "file,label\nmissing.off,cup\n"))
    assert not database.shapes
    assert len(database.failures) == 1


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("t.csv", "author,label\na.off,cup\n", "no column 'file'"),
        ("t.csv", "", "no column 'file'"),
        ("t.csv", "file,label\n", "lists no files"),
        ("t.csv", "file,label\na.off,cup,too,many\n", "line 2: there are more cells than the 2 columns"),
        ("t.csv", "file,label,label\na.off,cup,ant\n", "two columns named 'label'"),
        ("t.csv", f"file,label\na.off,{'x' * 200_000}\n", "line 2: this is not CSV"),
        ("t.csv", 'file,label\na.off,"c\nup"\nb.obj,"ant\nd.off,cup\n', "line 4: this is not CSV"),
        ("t.json", "{", "not JSON"),
        ("t.json", "[" * 100_000, "not JSON"),
        ("t.json", '{"file": "a.off"}', "not a list of objects"),
        ("t.json", '["a.off"]', "not a list of objects"),
        ("t.json", '[{"author": "a.off"}]', "no key 'file'"),
    ],
)
def test_table_that_cannot_be_read(root, name, text, reason):
    with pytest.raises(DatabaseError, match=reason):
        read_database(table(root, text, name))


def test_other_tables_in_the_folder_do_not_disturb(root):
    table(root, "name,value\nx,1\n", "prices.csv")
    table(root, '{"settings": {}}', "settings.json")
    table(root, "not json at all", "broken.json")
    assert read_database(root).layout == "class-folders"
    table(root, "file,label\na.off,cup\n")
    assert read_database(root).layout == "table"
    table(root, "file,label\nb.obj,ant\n", "more.csv")
    with pytest.raises(DatabaseError, match=r"several tables \(more\.csv, shapes\.csv\)"):
        read_database(root)
    assert [shape.id for shape in read_database(root / "more.csv").shapes] == ["b"]


def test_folder_without_table_by_name(root):
    with pytest.raises(DatabaseError, match="holds no table"):
        read_database(root, layout="table")


def test_paths_outside_the_tables_folder(root, tmp_path):
    (tmp_path / "x.off").touch()
    database = read_database(table(root, f"file\n../x.off\n{root}/a.off\n"))
    assert [shape.id for shape in database.shapes] == ["../x", "a"]
    assert database.labelings == ()


@pytest.mark.parametrize("file", ["//host/share/x.off", r"\\\\host\\share\\x.off"])
def test_another_machine_is_not_asked(root, file, monkeypatch):
    asked = []
    for name in ("isfile", "isdir", "lexists"):
        real = getattr(os.path, name)
        monkeypatch.setattr(
            os.path, name, lambda path, real=real: asked.append(os.fspath(path)) or real(path)
        )
    database = read_database(table(root, f"file\n{file}\na.off\n"))
    assert [shape.id for shape in database.shapes] == ["a"]
    assert [failure.reason for failure in database.failures] == [
        "shapes.csv lists it (line 2), but it is on another machine; copy it into the folder"
    ]
    assert asked
    assert not any("host" in path for path in asked)


def test_path_in_another_normal_form(root):
    (root / "Mu\u0308nze.off").touch()
    database = read_database(table(root, "file,label\nM\u00fcnze.off,coin\n"))
    assert database.shapes[0].path.is_file()


@pytest.fixture
def many(tmp_path) -> tuple[Path, list[str]]:
    """Forty shapes with columns of all kinds."""
    rows = []
    for number in range(40):
        (tmp_path / f"{number:02}.off").touch()
        rows.append(
            f"{number:02}.off,{'ab'[number % 2]},{number % 5},same,{number},{'x' if number < 2 else ''}"
        )
    return tmp_path, rows


def test_which_metadata_columns_are_labelings(many):
    root, rows = many
    rows[0] = "00.off,a"  # a short row, and first: the columns keep the order of the header
    text = "\n".join(["file,label,group,constant,number,rare", *rows])
    database = read_database(table(root, text))
    assert database.labelings == ("label", "group")
    assert database.shapes[7].labels == {"label": "b", "group": "2"}
    assert database.shapes[7].metadata == {"group": "2", "constant": "same", "number": "7"}
    assert read_database(table(root, text), labeling="group").labelings == ("group", "label")


def test_table_without_labels_is_grouped_by_its_first_such_column(many):
    root, rows = many
    database = read_database(table(root, "\n".join(["file,side,group,constant,number,rare", *rows])))
    assert database.labelings == ("side", "group")
    assert "no labels; the shapes are grouped by its column 'side'" in database.warnings[0]


@pytest.mark.parametrize("suffix", [".csv", ".json"])
def test_order_of_rows_does_not_matter(many, suffix):
    root, rows = many
    columns = ["file", "label", "group", "constant", "number", "rare"]
    databases = []
    for seed in range(3):
        random.Random(seed).shuffle(rows)
        if suffix == ".csv":
            text = "\n".join([",".join(columns), *rows])
        else:
            text = json.dumps([dict(zip(columns, row.split(","))) for row in rows])
        databases.append(read_database(table(root, text, f"shapes{suffix}")))
    assert databases[0] == databases[1] == databases[2]


def test_a_name_longer_than_any_file_can_have_is_not_there(root) -> None:
    found = read_database(table(root, "file\na.off\n" + "x" * 5000 + ".off\n"))
    assert [shape.id for shape in found.shapes] == ["a"]
    assert "it is not there" in found.failures[0].reason
    with pytest.raises(DatabaseError, match="no such file or folder"):
        read_database(root / ("x" * 5000))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("t.csv", "sep=;\nfile;label\nmeshes/a.off;cup\n"),
        ("t.csv", "\ufeffsep=|\r\nfile|label\r\nmeshes/a.off|cup\r\n"),
        ("t.csv", "File_Name|label\nmeshes/a|cup\n"),
        ("t.csv", "\n\r\n\nsep=;\nfile;label\nmeshes/a.off;cup\n"),
        ("t.csv", "\nfile,label\n\nmeshes/a.off,cup\n"),
        ("t.csv", 'PATH, label\n"meshes\\a.off", "cup"\n'),
        ("t.json", '[{"fullId": "meshes/a", "label": "cup", "year": NaN, "size": Infinity}]'),
        ("t.csv", "id,label,year\nmeshes/a.off,cup,NaN\n"),
    ],
)
def test_usual_tables_of_other_programs(tmp_path, name, text):
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "a.off").write_text("OFF")
    (tmp_path / name).write_text(text, encoding="utf-8")
    database = read_database(tmp_path)
    assert [(shape.id, shape.labels, shape.metadata) for shape in database.shapes] == [
        ("meshes/a", {"label": "cup"}, {})
    ]


@pytest.mark.parametrize("above", ["", "\n\n", "sep=,\n", "\r\nsep=,\r\n"])
def test_lines_are_counted_with_those_above_the_header(tmp_path, above):
    (tmp_path / "t.csv").write_text(f"{above}file,label\na.off,cup\nb.off,a,b\n", newline="")
    with pytest.raises(DatabaseError, match=f"line {3 + above.count(chr(10))}: there are more cells"):
        read_database(tmp_path / "t.csv")


@pytest.mark.parametrize("label", ["NaN", "null"])
def test_no_value_is_no_label(tmp_path, label):
    (tmp_path / "a.off").write_text("OFF")
    (tmp_path / "t.json").write_text(f'[{{"file": "a.off", "label": {label}}}]')
    assert read_database(tmp_path).shapes[0].labels == {}


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("t.json", '[{"file": "a.off"},\n]', "line 2 column 1"),
        ("t.csv", "author,label\nAda,cup\n", "no column 'file'"),
        ("t.csv", "model,label\nlinear,1\n", "No mesh that its rows name is there"),
        ("t.jsonl", '{"file": "a.off"}\n{"file": "b.off"\n', "line 2"),
        ("t.json", '[{"category": "cup"}]', "no key 'file'"),
        ("t.csv", "id,label,label\na,cup,ant\n", "two columns named 'label'"),
        # as pandas writes them by default
        (
            "t.json",
            '{"file": {"0": "a.off"}, "label": {"0": "cup"}}',
            'pandas writes it with orient="records"',
        ),
        ("t.csv", "# made by Ada\nfile,label\na.off,cup\n", "first line must name the columns"),
        ("t.csv", 'file,label,note\na.off,cup,"big\nb.off,ant,\n', "line 2: this is not CSV"),
    ],
)
def test_a_table_that_is_passed_over_is_told_of(tmp_path, name, text, reason):
    (tmp_path / "a.off").write_text("OFF")
    (tmp_path / "a.json").write_text("{}")
    (tmp_path / name).write_text(text)
    database = read_database(tmp_path)
    assert database.layout == "flat"
    (warning,) = database.warnings
    assert warning.startswith(f"{name} lies in the folder and is not used")
    assert reason in warning


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("taxonomy.json", '[{"synsetId": "1", "name": "cup", "children": []}]'),
        ("package.json", '{"name": "x", "contributors": [{"name": "Ada"}]}'),
        ("datapackage.json", '{"resources": [{"path": "readme.csv", "name": "x"}]}'),
        ("results.csv", "model,score\nlinear,1\n"),
        ("list.json", "[1, 2]"),
        ("empty.csv", ""),
        ("settings.json", '{"model": "elsewhere.off", "format": ".off"}'),
        # features that `describe` wrote beside the meshes
        ("features.csv", "id,class,label:class,Gc:1,Sc[0]:1\na,cup,cup,0.5,0.5\n"),
        ("features.json", '[{"id": "a.off", "class": "", "Gc:1": 0.5}]'),
    ],
)
def test_tables_of_other_things_are_passed_over_in_silence(root, name, text):
    table(root, text, name)
    (root / "readme.csv").touch()
    assert not read_database(root).warnings
    table(root, "file\na.off\nb.obj\ndeep/c.ply\nd.off\n")
    assert not read_database(root).warnings


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("labels.json", '[{"file": "a.off",}]', "not JSON"),
        ("labels.csv", "file,label\nz.off,cup\n", "No mesh"),
        ("labels.csv", "name,class\na,cup\n", "no column 'file'"),
        ("labels.csv", "file,label\na.off,cup,big\n", "line 2: there are more cells"),
    ],
)
def test_a_table_beside_the_one_that_is_read_is_told_of(root, name, text, reason):
    table(root, "file\na.off\nb.obj\ndeep/c.ply\nd.off\n")
    table(root, text, name)
    database = read_database(root)
    assert len(database.shapes) == 4
    (warning,) = database.warnings
    assert warning.startswith(f"{name} lies in the folder and is not used.")
    assert reason in warning


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("t.jsonl", '{"file": "a.off", "label": "cup"}\r\n\r\n{"file": "b.obj", "label": "ant"}\r\n'),
        ("t.ndjson", '{"file": "a.off", "label": "cup"}\n{"file": "b.obj", "label": "ant"}'),
        ("t.json", '{"file": "a.off", "label": "cup"}\n{"file": "b.obj", "label": "ant"}\n'),
        (
            "t.json",
            '{"version": [1], "shapes": [{"file": "a.off", "label": "cup"}, {"file": "b", "label": "ant"}]}',
        ),
    ],
)
def test_other_arrangements_of_json(root, name, text):
    table(root, text, name)
    assert [(shape.id, shape.labels["label"]) for shape in read_database(root).shapes] == [
        ("a", "cup"),
        ("b", "ant"),
    ]


@pytest.mark.parametrize("label", ["none", "null", "None", "NULL", "NA", "01", "1.0", "-"])
@pytest.mark.parametrize("suffix", [".csv", ".json"])
def test_labels_keep_their_spelling(root, suffix, label):
    text = (
        f"file,label\na.off,{label}\n"
        if suffix == ".csv"
        else json.dumps([{"file": "a.off", "label": label}])
    )
    assert read_database(table(root, text, f"t{suffix}")).shapes[0].labels == {"label": label}


@pytest.mark.parametrize("cell", ["", " ", "NaN", "nan", "N/A", "#N/A", "<NA>"])
def test_cells_without_a_value(root, cell):
    assert read_database(table(root, f"file,label\na.off,{cell}\n")).shapes[0].labels == {}


@pytest.mark.parametrize(("value", "label"), [("1", "1"), ("1.0", "1.0"), ('"01"', "01"), ("-3", "-3")])
def test_numbers_of_json_are_labels_as_they_are_written(root, value, label):
    text = f'[{{"file": "a.off", "label": {value}}}]'
    assert read_database(table(root, text, "t.json")).shapes[0].labels == {"label": label}


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("t.csv", "file,Label,label\na.off,1,2\n", "'label' \\(written 'Label', 'label'\\)"),
        ("t.csv", "file,File\na.off,b.off\n", "'file' \\(written 'file', 'File'\\)"),
        (
            "t.json",
            '[{"file": "b"}, {"file": "a.off", "FILE": "b"}]',
            "entry 2, has two columns named 'file'",
        ),
        ("t.json", '[{"file": "a.off", "label": "x", "label": "y"}]', "has the key 'label' twice"),
    ],
)
def test_columns_of_one_name_are_named(root, name, text, reason):
    with pytest.raises(DatabaseError, match=reason):
        read_database(table(root, text, name))


def test_files_of_another_case_are_found_where_that_is_clear(root):
    (root / "Twin.off").touch()
    (root / "twin.off").touch()
    database = read_database(table(root, "file\nA.OFF\nDEEP\\C\nTWIN.off\ntwin.off\n"))
    assert [shape.id for shape in database.shapes] == ["a", "deep/c", "twin"]
    assert [(failure.path, "line 4" in failure.reason) for failure in database.failures] == [
        ("TWIN.off", True)
    ]


@pytest.mark.parametrize(
    ("files", "cell", "found"),
    [
        (["1.off"], "1.0", "1"),
        (["1.off"], "1.00", "1"),
        (["1.0.off"], "1", "1.0"),
        (["007.off"], "7", "007"),
        (["deep/0042.stl"], "deep/42", "deep/0042"),
        (["7.OFF"], "007.off", "7"),
        (["1.off", "01.off"], "1", "1"),  # as it is written, before anything like it
        (["1.off", "01.off"], "001", None),  # it cannot be said which
        (["1.5.off"], "1", None),
        (["10.off"], "1", None),
        (["m1.off"], "1", None),
    ],
)
def test_numbers_are_found_as_spreadsheets_write_them(tmp_path, files, cell, found):
    for name in files:
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.touch()
    (tmp_path / "other.off").touch()
    database = read_database(table(tmp_path, f"file,label\n{cell},cup\nother.off,ant\n"))
    assert [shape.id for shape in database.shapes if shape.labels["label"] == "cup"] == (
        [found] if found else []
    )
    assert len(database.failures) == (0 if found else 1)


def test_paths_of_mixed_normal_forms_are_found(root):
    folder = root / "Mu\u0308nzen"
    folder.mkdir()
    (folder / "\u00c4.off").touch()
    database = read_database(table(root, "file\nM\u00fcnzen/A\u0308.off\n"))
    assert not database.failures
    assert database.shapes[0].path.is_file()


def test_meshes_that_no_row_names_are_counted(root):
    database = read_database(table(root, "file,label\na.off,cup\nb,x\nb,y\nmissing.off,cup\n"))
    assert [failure.path for failure in database.failures] == ["b.obj", "missing.off"]
    assert database.warnings == (f"2 mesh files below {root} are not in shapes.csv and are left out.",)


def test_a_column_of_classes_is_a_labeling_however_few_there_are(root):
    database = read_database(table(root, "file,split,Class\na.off,x,cup\nb.obj,x,ant\ndeep/c.ply,x,\n"))
    assert database.labelings == ("Class",)
    assert [shape.labels for shape in database.shapes] == [{"Class": "cup"}, {"Class": "ant"}, {}]


def test_names_tell_the_shapes_of_a_table_apart(root):
    for folder in ("x/1a/models", "y/2b/models"):
        (root / folder).mkdir(parents=True)
        (root / folder / "model.obj").touch()
    database = read_database(table(root, "file\nx/1a/models/model.obj\ny/2b/models/model.obj\na.off\n"))
    assert [shape.name for shape in database.shapes] == ["a", "1a", "2b"]
