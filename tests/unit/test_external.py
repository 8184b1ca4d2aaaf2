"""Features that are brought along: by the order of the shapes, or by their ids."""

from __future__ import annotations

import csv
import io
import zipfile
from typing import ClassVar

import numpy as np
import pandas
import pyarrow
import pytest
from pyarrow import parquet

from shapeviz_report import external
from shapeviz_report.errors import ConfigError
from shapeviz_report.external import load_coordinates, load_external

IDS = ["ant/1", "ant/2", "cup/1"]


def test_in_the_order_of_the_shapes(tmp_path) -> None:
    np.save(tmp_path / "depth.npy", np.arange(6, dtype=np.int16).reshape(3, 2))
    assert load_external(tmp_path / "depth.npy", IDS).tolist() == [[0, 1], [2, 3], [4, 5]]
    np.save(tmp_path / "flat.npy", np.arange(3.0))
    assert load_external(tmp_path / "flat.npy", IDS).shape == (3, 1)


def test_by_ids_in_any_order_and_of_more_shapes(tmp_path) -> None:
    rows = {"cup/1": [5, 6], "zebra": [7, 8], "ant/2": [3, 4], "ant/1": [1, 2]}
    np.savez(tmp_path / "own.npz", shape_ids=list(rows), values=list(rows.values()))
    with (tmp_path / "own.csv").open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["class", "width", "id", "height", "metadata:year"])
        table.writerows([["a", *row[:1], shape, *row[1:], "?"] for shape, row in rows.items()])
    for name in ("own.npz", "own.csv"):
        assert load_external(tmp_path / name, IDS).tolist() == [[1, 2], [3, 4], [5, 6]]


def test_numbers_of_rows_are_no_part_of_a_feature(tmp_path) -> None:
    frame = pandas.DataFrame({"id": IDS, "width": [1, 2, 3]}, index=[7, 8, 9])
    frame.to_csv(tmp_path / "own.csv")
    frame.to_parquet(tmp_path / "own.parquet")
    pandas.read_csv(tmp_path / "own.csv").to_csv(tmp_path / "again.csv")
    for name in ("own.csv", "own.parquet", "again.csv"):
        assert load_external(tmp_path / name, IDS).tolist() == [[1], [2], [3]]


@pytest.mark.parametrize("scale", [1e-320, 1e-200, 1e200])
def test_numbers_whose_squares_are_none_are_refused(tmp_path, scale) -> None:
    np.save(tmp_path / "own.npy", np.array([[0, 1], [1, 1], [2, 1]]) * scale)
    with pytest.raises(
        ConfigError, match=r"numbers above 1e\+100, or that differ by less than 1e-100; scale them"
    ):
        load_external(tmp_path / "own.npy", IDS)
    np.save(tmp_path / "own.npy", np.array([[0, 1e-320], [1e-99, 1e-320], [1e99, 1e-320]]))
    assert load_external(tmp_path / "own.npy", IDS).shape == (3, 2)


def test_ids_as_other_programs_write_them(tmp_path) -> None:
    np.savez(tmp_path / "own.npz", shape_ids=np.array([shape.encode() for shape in IDS]), values=[1, 2, 3])
    assert load_external(tmp_path / "own.npz", IDS).tolist() == [[1], [2], [3]]
    composed, parted = "M\u00fcnze", "Mu\u0308nze"
    np.savez(tmp_path / "own.npz", shape_ids=["cup", composed], values=[1, 2])
    assert load_external(tmp_path / "own.npz", [parted, "cup"]).tolist() == [[2], [1]]
    with pytest.raises(ConfigError, match="no row for 1 of the 2"):
        load_external(tmp_path / "own.npz", [composed, parted])
    np.savez(tmp_path / "own.npz", shape_ids=[parted, composed], values=[1, 2])
    assert load_external(tmp_path / "own.npz", [composed, parted]).tolist() == [[2], [1]]


@pytest.mark.parametrize("name", ["own.csv", "own.tsv"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
@pytest.mark.parametrize("told", ["", "sep={}\r\n"])
def test_tables_parted_in_any_way(tmp_path, name, delimiter, told) -> None:
    rows = [["id", "a b", "x"], ["cup/1", "5", "6"], ["ant/2", "3", "4"], ["ant/1", "1", "2.5"]]
    (tmp_path / name).write_text(
        told.format(delimiter) + "".join(delimiter.join(row) + "\r\n" for row in rows)
    )
    assert load_external(tmp_path / name, IDS).tolist() == [[1, 2.5], [3, 4], [5, 6]]


@pytest.mark.parametrize("encoding", ["cp1252", "utf-16"])
def test_tables_in_other_encodings_say_what_to_do(tmp_path, encoding) -> None:
    (tmp_path / "own.csv").write_bytes("id;Höhe\nant/1;1\n".encode(encoding))
    with pytest.raises(ConfigError, match="cannot be read: it is not UTF-8; save it so"):
        load_external(tmp_path / "own.csv", IDS)


def test_parquet_by_ids_with_numbers_or_lists(tmp_path) -> None:
    columns = {
        "class": ["c", "z", "a", "a"],
        "width": [5, 7, 3, 1],
        "id": pyarrow.array(["cup/1", "zebra", "ant/2", "ant/1"]).dictionary_encode(),
        "flat": [True, False, False, True],
        "learnt": pyarrow.array([[5.5, 6], [7, 8], [3, 4], [1, 2]]),
        "metadata:year": [None, "2", "3", "4"],
    }
    parquet.write_table(pyarrow.table(columns), tmp_path / "own.parquet")
    expected = [[1, 1, 1, 2], [3, 0, 3, 4], [5, 1, 5.5, 6]]
    assert load_external(tmp_path / "own.parquet", IDS).tolist() == expected


@pytest.mark.parametrize(
    ("columns", "reason"),
    [
        ({"name": IDS, "width": [1, 2, 3]}, r"needs one column 'id' \(the index of a data frame"),
        ({"id": IDS, "width": ["1", "2", "3"]}, "its column 'width' holds neither numbers nor lists"),
        ({"id": IDS, "width": [[1], [2], [3, 4]]}, "its column 'width' holds neither"),
        (
            {"id": IDS, "width": [1, None, 3]},
            "finite numbers only, and has nan as number 1 of the shape 'ant/2'$",
        ),
        ({"id": IDS, "class": IDS}, "has no columns of numbers"),
        ({"id": [*IDS, "cup/1"], "width": [1, 2, 3, 4]}, "two rows for the shape 'cup/1'"),
        ({"id": IDS[1:], "width": [1, 2]}, "no row for 1 of the 3 shapes.*such as 'ant/1'"),
        ({"id": [[1], [2], [3]], "width": [1, 2, 3]}, "its column 'id' holds no text"),
    ],
)
def test_parquet_that_does_not_fit(tmp_path, columns, reason) -> None:
    parquet.write_table(pyarrow.table(columns), tmp_path / "x.parquet")
    with pytest.raises(ConfigError, match=reason):
        load_external(tmp_path / "x.parquet", IDS)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (np.zeros((4, 2)), "4 rows, but the database has 3"),
        (
            np.array([[1.0, 1], [1, -np.inf], [np.nan, 1]]),
            "has -inf as number 2 of .*'ant/2', and such of 1 more$",
        ),
        (np.array(["a", "b", "c"]), "numbers"),
        (np.array([{}, [], 0], dtype=object), "cannot be read: it holds Python objects, not numbers alone"),
        (np.zeros((3, 2, 2)), "one array"),
        (np.zeros((3, 0)), "has no columns of numbers"),
    ],
)
def test_arrays_that_do_not_fit(tmp_path, content, reason) -> None:
    np.save(tmp_path / "x.npy", content, allow_pickle=True)
    with pytest.raises(ConfigError, match=reason):
        load_external(tmp_path / "x.npy", IDS)


@pytest.mark.parametrize(
    ("arrays", "reason"),
    [
        ({"values": np.zeros((3, 2))}, "it has no array 'shape_ids'"),
        ({"shape_ids": IDS}, "it has no array 'values'"),
        ({"shape_ids": IDS, "values": np.zeros((2, 2))}, "has 2 rows, but 3 ids of shapes"),
        ({"shape_ids": IDS[:2], "values": np.zeros((2, 2))}, "no row for 1 of the 3 shapes.*such as 'cup/1'"),
        (
            {"shape_ids": [f"{shape}.off" for shape in IDS], "values": np.zeros(3)},
            "no row for 3 of the 3 shapes.*such as 'ant/1', but rows of none, such as 'ant/1.off'",
        ),
        ({"shape_ids": [*IDS, "ant/1"], "values": np.zeros(4)}, "two rows for the shape 'ant/1'"),
        (
            {"shape_ids": np.array(IDS, object), "values": np.zeros(3)},
            r"ids are no text, as numpy.array\(ids, str\)",
        ),
        ({"shape_ids": IDS, "values": [np.inf] * 3}, "finite"),
        ({"shape_ids": IDS, "values": np.array([1.0, "a", {}], object)}, "cannot be read"),
    ],
)
def test_archives_that_do_not_fit(tmp_path, arrays, reason) -> None:
    np.savez(tmp_path / "x.npz", **arrays)
    with pytest.raises(ConfigError, match=reason):
        load_external(tmp_path / "x.npz", IDS)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "cannot be read: it is empty"),
        ("name,width\nant/1,1\n", "it has no column 'id'"),
        ("id,width\nant/1,wide\n", "row 2 has 'wide' in the column 'width', which is no number"),
        ("id;width\nant/1;1,5\n", "row 2 has '1,5' in the column 'width', .* with a decimal point"),
        ("id,width\nant/1,1\nant/2,2,3\n", "row 3 has 3 cells, and the head 2"),
        ("id,width\nant/1,1\nant/2,2\n", "no row for 1 of the 3 shapes"),
        ("id,width\nant/1,nan\nant/2,2\ncup/1,1\n", "finite numbers only"),
        ("id,class\nant/1,ant\nant/2,ant\ncup/1,cup\n", "has no columns of numbers"),
        ('id,width\nant/1,"1', "cannot be read"),
    ],
)
def test_tables_that_do_not_fit(tmp_path, text, reason) -> None:
    (tmp_path / "x.csv").write_text(text)
    with pytest.raises(ConfigError, match=reason):
        load_external(tmp_path / "x.csv", IDS)


def test_files_that_are_none(tmp_path) -> None:
    for name, reason in (
        ("x.npy", r"x\.npy cannot be read"),
        ("x.txt", r"must end in \.npy, \.npz, \.csv, \.tsv, \.parquet"),
        ("x.parquet", r"x\.parquet cannot be read"),
    ):
        with pytest.raises(ConfigError, match=reason):
            load_external(tmp_path / name, IDS)
    (tmp_path / "x.npz").write_bytes(b"PK\x03\x04")
    with pytest.raises(ConfigError, match="cannot be read"):
        load_external(tmp_path / "x.npz", IDS)


def test_an_archive_that_unpacks_to_too_much(tmp_path, monkeypatch) -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("values.npy", bytes(2_000_000))
    (tmp_path / "x.npz").write_bytes(packed.getvalue())
    monkeypatch.setattr(external, "MOST_EXTERNAL_BYTES", 2**20)
    with pytest.raises(ConfigError, match="it holds more than 1 MiB"):
        load_external(tmp_path / "x.npz", IDS)


class TestCoordinates:
    PLACES: ClassVar = {"cup/1": (5.0, 6.0), "zebra": (9.0, 9.0), "ant/2": (3.0, 4.0), "ant/1": (1.0, 2.0)}
    EXPECTED: ClassVar = [[1, 2], [3, 4], [5, 6]]

    def test_columns_are_found_by_their_names(self, tmp_path) -> None:
        rows = "".join(f"{y},?,{shape},{x}\n" for shape, (x, y) in self.PLACES.items())
        (tmp_path / "own.csv").write_text(f"y,name,id,x\n{rows}")
        x, y = zip(*self.PLACES.values())
        parquet.write_table(
            pyarrow.table({"y": y, "name": ["?"] * 4, "id": list(self.PLACES), "x": x}),
            tmp_path / "own.parquet",
        )
        np.savez(tmp_path / "own.npz", shape_ids=list(self.PLACES), values=list(self.PLACES.values()))
        np.save(tmp_path / "own.npy", self.EXPECTED)
        for name in ("own.csv", "own.parquet", "own.npz", "own.npy"):
            assert load_coordinates(tmp_path / name, IDS).tolist() == self.EXPECTED

    def test_semicolons_part_cells_too(self, tmp_path) -> None:
        rows = "".join(f"{shape};{x};{y}\n" for shape, (x, y) in self.PLACES.items())
        (tmp_path / "own.csv").write_text(f"id;x;y\n{rows}")
        assert load_coordinates(tmp_path / "own.csv", IDS).tolist() == self.EXPECTED

    def test_the_map_of_another_site_is_one(self, tmp_path) -> None:
        (tmp_path / "projection-tsne.csv").write_text("id,x,y\nant/1,0.5,-1\nant/2,1,1\ncup/1,-1,1e-3\n")
        places = load_coordinates(tmp_path / "projection-tsne.csv", IDS)
        assert places.tolist() == [[0.5, -1], [1, 1], [-1, 0.001]]

    @pytest.mark.parametrize(
        ("text", "reason"),
        [
            ("id,x\nant/1,1\n", "the file of coordinates .*own.csv cannot be read: it has no column 'y'"),
            ("id,x,y\nant/1,1,1\nant/2,1,2\n", "no row for 1 of the 3 shapes .* such as 'cup/1'"),
            ("id,x,y\nant/1,1,1\nant/2,1,nan\ncup/1,1,1\n", "must hold finite numbers only"),
            ("id,x,y\nant/1,1,1\nant/2,1,1\ncup/1,1,1\n", "all 3 shapes of the database in one place"),
            ("id,x,y\nant/1,1,1e308\nant/2,1,-1e308\ncup/1,1,1\n", "farther apart than numbers can tell"),
            ("id,x,y\nant/1,1,1\nant/1,1,2\nant/2,2,2\ncup/1,1,1\n", "two rows for the shape 'ant/1'"),
        ],
    )
    def test_files_that_are_no_map(self, tmp_path, text, reason) -> None:
        (tmp_path / "own.csv").write_text(text)
        with pytest.raises(ConfigError, match=reason):
            load_coordinates(tmp_path / "own.csv", IDS)

    def test_places_in_space_are_none(self, tmp_path) -> None:
        np.save(tmp_path / "own.npy", np.eye(3))
        with pytest.raises(ConfigError, match="3 values a shape, and not two"):
            load_coordinates(tmp_path / "own.npy", IDS)

    def test_of_one_shape_any_place_will_do(self, tmp_path) -> None:
        np.save(tmp_path / "own.npy", [[7.0, 7.0]])
        assert load_coordinates(tmp_path / "own.npy", IDS[:1]).tolist() == [[7, 7]]
