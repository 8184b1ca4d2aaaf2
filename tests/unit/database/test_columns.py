"""Tables with typed columns: Parquet files, and data frames."""

from __future__ import annotations

import datetime
import decimal
import importlib.util
import io
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas
import pyarrow
import pytest
from pyarrow import parquet

from shapeviz_report.arrow import parquet_texts
from shapeviz_report.database import Listing, read_database
from shapeviz_report.database import rows as tables
from shapeviz_report.errors import ConfigError, DatabaseError

FILES = ["a.off", "b.obj", "deep/c.ply"]


@pytest.fixture
def root(tmp_path) -> Path:
    for name in (*FILES, "d.off"):
        path = tmp_path / "db" / name
        path.parent.mkdir(exist_ok=True, parents=True)
        path.touch()
    return tmp_path / "db"


def write(root: Path, columns: object, name: str = "shapes.parquet") -> Path:
    found = columns if isinstance(columns, pyarrow.Table) else pyarrow.table(columns)
    parquet.write_table(found, root / name)
    return root / name


def values(root: Path, cells: object) -> list[str | None]:
    database = read_database(write(root, {"file": FILES, "x": cells}))
    return [shape.metadata.get("x") for shape in database.shapes]


def test_a_table_of_parquet_is_read_as_one_of_csv(root) -> None:
    columns = {
        "File": FILES,
        "label": pyarrow.array(["cup", "ant", None]).dictionary_encode(),
        "author": ["Ada", "", "Bob"],
        "year": pyarrow.array([1990.0, 1991.0, None]),
    }
    path = write(root, columns)
    for place in (path, root):
        database = read_database(place)
        assert (database.layout, database.name, database.root) == ("table", "db", root)
        assert [(shape.id, dict(shape.labels), dict(shape.metadata)) for shape in database.shapes] == [
            ("a", {"label": "cup"}, {"author": "Ada", "year": "1990"}),
            ("b", {"label": "ant"}, {"year": "1991"}),
            ("deep/c", {}, {"author": "Bob"}),
        ]
        assert database.warnings == (f"1 mesh file below {root} is not in shapes.parquet and is left out.",)


@pytest.mark.parametrize(
    ("cells", "texts"),
    [
        ([True, False, None], ["true", "false", None]),
        ([2**63 - 1, 0, -1], ["9223372036854775807", "0", "-1"]),
        (pyarrow.array([2**64 - 1, 0, None], pyarrow.uint64()), ["18446744073709551615", "0", None]),
        ([0.1, float("nan"), 3.0], ["0.1", None, "3"]),
        (pyarrow.array([0.1, None, -3.5], pyarrow.float32()), ["0.1", None, "-3.5"]),
        ([decimal.Decimal("1.20"), None, decimal.Decimal("3.00")], ["1.20", None, "3.00"]),
        ([datetime.date(2018, 1, 2), None, datetime.date(1999, 12, 31)], ["2018-01-02", None, "1999-12-31"]),
        ([datetime.datetime(2018, 1, 2), None, datetime.datetime(2018, 1, 10)], ["2018-01-02", None, "2018-01-10"]),
        (
            [datetime.datetime(2018, 1, 2), None, datetime.datetime(2018, 1, 2, 3, 4, 5, 500_000)],
            ["2018-01-02 00:00:00", None, "2018-01-02 03:04:05.5"],
        ),
        ([datetime.time(1, 20), None, datetime.time(1, 2, 3, 40)], ["01:20:00", None, "01:02:03.00004"]),
        ([datetime.timedelta(hours=25, seconds=1.5), None, datetime.timedelta(-1)], ["25:00:01.5", None, "-24:00:00"]),
        (pyarrow.array([3600, None, 59], pyarrow.duration("s")), ["1:00:00", None, "0:00:59"]),
        (pyarrow.array([7, None, 7]).dictionary_encode(), ["7", None, "7"]),
        ([b"stone", None, "Münze".encode()], ["stone", None, "Münze"]),
        (["N/A", " x ", "=1+1"], [None, "x", "=1+1"]),
        (pyarrow.nulls(3), [None, None, None]),
    ],
)  # fmt: skip
def test_cells_are_what_one_would_write(root, cells, texts) -> None:
    assert values(root, cells) == texts


@pytest.mark.parametrize(
    "cells",
    [
        [b"\xff", b"a", None],
        [[1, 2], [3], []],
        [{"a": 1}, {"a": 2}, None],
        pyarrow.array([b"\xff", b"a", b"\xff"]).dictionary_encode(),
        # numbers of months, which only pandas knows to be such
        pyarrow.array(pandas.period_range("2020", periods=3, freq="M")),
    ],
)
def test_what_is_no_text_is_left_out_with_a_word(root, cells) -> None:
    database = read_database(write(root, {"file": FILES, "image": cells, "label": ["x", "y", "z"]}))
    assert [dict(shape.metadata) for shape in database.shapes] == [{}, {}, {}]
    assert (
        "Columns of shapes.parquet hold neither text, numbers nor dates and are left out: image."
        in database.warnings
    )


def test_rows_that_cannot_be_taken_are_named_by_number(root) -> None:
    files = ["a.off", None, "z.off", "a.off"]
    database = read_database(write(root, {"file": files, "label": ["x", "y", "z", "other"]}))
    assert [(failure.path, failure.reason) for failure in database.failures] == [
        ("a.off", "shapes.parquet lists it 2 times with different values (row 1, row 4); keep one"),
        ("shapes.parquet, row 2", "its column 'file' is empty"),
        ("z.off", "shapes.parquet lists it (row 3), but it is not there"),
    ]


@pytest.mark.parametrize(
    ("columns", "said"),
    [
        ({"name": ["x"], "class": ["y"]}, r"has no column 'file'\.$"),
        ({"file": [["a.off"]], "class": ["y"]}, r"no column 'file'\. Columns .* hold neither text.*: file\.$"),
        ({"file": ["a.off"], "File": ["a.off"]}, "two columns named 'file' .*rename one"),
        ({"file": pyarrow.array([], pyarrow.string())}, "lists no files"),
        ({"file": ["a.off"], "x": ["y" * 131_073]}, r"a value longer than 131,072 letters in its column 'x'"),
    ],
)  # fmt: skip
def test_tables_that_cannot_be_understood(root, columns, said) -> None:
    path = write(root, columns)
    with pytest.raises(DatabaseError, match=said):
        read_database(path)


def test_two_columns_of_one_name(root) -> None:
    columns = pyarrow.Table.from_arrays([pyarrow.array(["a.off"])] * 3, ["file", "x", "x"])
    path = write(root, columns)
    with pytest.raises(DatabaseError, match="two columns named 'x'"):
        read_database(path)


def test_a_file_that_is_no_parquet(root) -> None:
    (root / "shapes.parquet").write_bytes(b"file,label\na.off,cup\n")
    with pytest.raises(
        DatabaseError, match=r"shapes\.parquet cannot be read: it is no Parquet: Parquet magic"
    ):
        read_database(root / "shapes.parquet")
    (warning,) = read_database(root).warnings
    assert warning.startswith("shapes.parquet lies in the folder and is not used. The table")


def test_what_is_too_large_is_refused_before_it_is_unpacked(root, monkeypatch) -> None:
    path = write(root, {"file": FILES, "x": ["y" * 60_000, "z", "z"]})
    assert os.path.getsize(path) < 10_000
    with monkeypatch.context() as patch:
        patch.setattr(tables, "MOST_UNPACKED", 50_000)
        with pytest.raises(DatabaseError, match="it unpacks to more than 0 MiB"):
            read_database(path)
    monkeypatch.setattr(tables, "MOST_CELLS", 5)
    with pytest.raises(DatabaseError, match="it has more than 5 cells"):
        read_database(path)


def test_a_text_of_many_rows_is_held_once(root) -> None:
    # unpacked, it would be 200 MB
    text = "y" * 100_000 + " "
    columns = {"file": ["a.off"] * 2_000, "x": pyarrow.array([text] * 2_000)}
    found = tables.read_rows(write(root, columns))
    assert len({id(row.cells["x"]) for row in found.rows}) == 1
    assert found.rows[0].cells["x"] == text.strip()


def test_a_text_of_many_rows_is_looked_at_once(root, monkeypatch) -> None:
    """A thousand bytes of Parquet may say a long text a million times."""
    looked = []
    monkeypatch.setattr(tables, "clean", lambda text: looked.append(text) or text)
    monkeypatch.setattr(
        "shapeviz_report.database.table.spellings", lambda file: looked.append(file) or [file]
    )
    texts = ["a.off", "y" * 1000, "z" * 1000]
    place = pyarrow.array([0] * 2_000, pyarrow.int32())
    columns = [pyarrow.DictionaryArray.from_arrays(place, pyarrow.array([text])) for text in texts]
    path = write(root, dict(zip(["file", "x", "label"], columns)))
    (shape,) = read_database(path).shapes
    assert shape.labels == {"label": texts[2]}
    assert all(looked.count(text) <= 1 for text in texts)


def test_another_process_reads_what_a_stranger_wrote(root) -> None:
    write(root, {"file": FILES})
    parquet.write_table(pyarrow.table({"id": ["a", "b", "deep/c"], "x": [1, 2, 3]}), root / "own.parquet")
    program = (
        "import sys\nfrom pathlib import Path\nfrom shapeviz_report.database import read_database\n"
        "from shapeviz_report.external import load_external\nroot = Path(sys.argv[1])\n"
        "database = read_database(root / 'shapes.parquet')\n"
        "values = load_external(root / 'own.parquet', [shape.id for shape in database.shapes])\n"
        "print(values.ravel().tolist(), 'pyarrow' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program, root], capture_output=True, text=True)
    assert done.stdout == "[1.0, 2.0, 3.0] False\n", done.stderr


def test_damaged_files_are_refused(root) -> None:
    content = write(root, {"file": FILES, "label": ["x", "y", "z"], "n": [1, 2, 3]}).read_bytes()
    random = np.random.default_rng(0)
    refused = 0
    for _ in range(150):
        damaged = bytearray(content)
        for place in random.integers(0, len(damaged), 3):
            damaged[place] = random.integers(256)
        try:
            parquet_texts(bytes(damaged), 100, 10_000)
        except ValueError:
            refused += 1
    assert refused > 75


def test_without_pyarrow_it_is_said_what_to_install(root, monkeypatch) -> None:
    path = write(root, {"file": FILES})
    frame = pandas.DataFrame({"file": FILES})
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(DatabaseError, match=r"pip install 'shapeviz-report\[parquet\]'; or save it as CSV"):
        read_database(path)
    database = read_database(root)
    assert database.layout == "flat" or len(database.shapes) == 4
    assert any("needs pyarrow" in warning for warning in database.warnings)
    with pytest.raises(ConfigError, match="a data frame as a database needs pyarrow"):
        Listing(frame)


def test_files_that_are_something_else_are_no_tables(root) -> None:
    write(root, {"id": ["a", "b", "deep/c", "d"], "width": [1, 2, 3, 4]}, "own.parquet")
    assert read_database(root).layout == "table"
    database = read_database(root, besides=[root / "own.parquet"])
    assert database.layout == "class-folders"
    assert len(database.shapes) == 4
    assert not database.warnings


class TestDataFrame:
    @pytest.fixture(autouse=True)
    def above(self, root, monkeypatch) -> None:
        monkeypatch.chdir(root.parent)

    def test_the_folder_is_the_deepest_that_holds_all(self, root) -> None:
        frame = pandas.DataFrame(
            {"file": [f"db/{name}" for name in FILES], "label": ["x", None, "y"], "n": 7}
        )
        database = read_database(Listing(frame))
        assert (database.layout, database.name, database.root) == ("table", "db", root)
        assert [shape.id for shape in database.shapes] == ["a", "b", "deep/c"]
        assert [dict(shape.labels) for shape in database.shapes] == [{"label": "x"}, {}, {"label": "y"}]
        assert {shape.metadata["n"] for shape in database.shapes} == {"7"}
        assert database.warnings == (f"1 mesh file below {root} is not in the data frame and is left out.",)

    def test_of_pandas_and_of_pyarrow_alike(self) -> None:
        frame = pandas.DataFrame(
            {"label": pandas.Categorical(["x", "x", "y"])}, index=[f"db/{name}" for name in FILES]
        )
        with pytest.raises(DatabaseError, match="The table of the data frame has no column 'file'"):
            Listing(frame)
        frame = frame.rename_axis("file")
        listed = [read_database(Listing(given)) for given in (frame, pyarrow.table(frame))]
        assert [shape.labels for shape in listed[0].shapes] == [
            {"label": "x"},
            {"label": "x"},
            {"label": "y"},
        ]
        assert listed[0] == listed[1]

    def test_an_index_without_a_name_is_none_of_its_columns(self) -> None:
        frame = pandas.DataFrame({"file": [f"db/{name}" for name in FILES]}, index=[3, 5, 9])
        assert [dict(shape.metadata) for shape in read_database(Listing(frame)).shapes] == [{}, {}, {}]

    @pytest.mark.parametrize(
        ("cells", "texts"),
        [
            ([1900, "about 1850", None], ["1900", "about 1850", None]),
            ([Path("x/y"), None, float("nan")], ["x/y", None, None]),
            (pandas.period_range("2020", periods=3, freq="M"), ["2020-01", "2020-02", "2020-03"]),
            (pandas.cut([1, 2, 3], [0, 2, 4]), ["(0, 2]", "(0, 2]", "(2, 4]"]),
            (pandas.to_timedelta([1, None, 2.5], unit="h"), ["1:00:00", None, "2:30:00"]),
            (pandas.array([1, None, 3], dtype="Int64"), ["1", None, "3"]),
        ],
    )
    def test_cells_of_pandas_are_what_one_would_write(self, cells, texts) -> None:
        frame = pandas.DataFrame({"file": [Path("db", name) for name in FILES], "x": cells})
        database = read_database(Listing(frame))
        assert [shape.metadata.get("x") for shape in database.shapes] == texts
        assert [shape.id for shape in database.shapes] == ["a", "b", "deep/c"]

    def test_frames_that_cannot_be_read(self) -> None:
        with pytest.raises(DatabaseError, match=r"file with type complex128.*paths as text"):
            Listing(pandas.DataFrame({"file": [1j]}))
        with pytest.raises(DatabaseError, match="lists no files"):
            Listing(pandas.DataFrame({"file": [None, ""]}))
        with pytest.raises(TypeError, match="list is neither a path nor a data frame"):
            Listing(["db/a.off"])
        with pytest.raises(TypeError, match="Series is neither a path nor a data frame"):
            Listing(pandas.Series(["db/a.off"]))
        with pytest.raises(DatabaseError, match="has the layout 'table', not 'flat'"):
            read_database(Listing(pandas.DataFrame({"file": ["db/a.off"]})), layout="flat")


def test_texts_of_columns_survive_a_round_trip(root) -> None:
    file = io.BytesIO()
    parquet.write_table(pyarrow.table({"file": FILES, "x": ["'", "\u202e", "<b>"]}), file)
    (root / "t.parquet").write_bytes(file.getvalue())
    assert [shape.metadata["x"] for shape in read_database(root).shapes] == ["'", "\u202e", "<b>"]
