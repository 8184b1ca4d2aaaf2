"""What a curator would publish beside the demo shapes."""

from __future__ import annotations

import csv
import io
import re
from datetime import date

from shapeviz_report.database import read_database
from shapeviz_report.demo import CLASSES, PER_CLASS, shape_path
from shapeviz_report.demo.catalogue import DESCRIPTION, INTRODUCTION, write_catalogue


def test_it_lists_every_shape_with_numbers_and_dates() -> None:
    rows = list(csv.DictReader(io.StringIO(write_catalogue(0))))
    assert len(rows) == len(CLASSES) * PER_CLASS
    assert len({row["number"] for row in rows}) == len(rows)
    for row in rows:
        assert float(row["height cm"]) > 0
        assert float(row["mass g"]) > 0
        assert date.fromisoformat(row["catalogued"]).year > 2008
        assert row["made"] == "" or 1900 < int(row["made"]) < 2009
    # A few things nobody knows, as in every catalogue.
    assert 0 < sum(row["made"] == "" for row in rows) < len(rows) / 5


def test_it_is_the_same_for_a_seed() -> None:
    assert write_catalogue(3) == write_catalogue(3) != write_catalogue(4)


def test_words_count_what_there_is() -> None:
    count = len(CLASSES) * PER_CLASS
    for text in (DESCRIPTION, INTRODUCTION):
        assert re.search(rf"\b{count} models", text)
    assert f"each of {len(CLASSES)} classes" in INTRODUCTION


def test_it_is_read_as_the_table_of_its_folder(tmp_path) -> None:
    for entry in CLASSES:
        for index in range(PER_CLASS):
            path = shape_path(tmp_path, entry.name, index)
            path.parent.mkdir(exist_ok=True)
            path.touch()
    (tmp_path / "shapes.csv").write_text(write_catalogue(0))
    database = read_database(tmp_path)
    assert (database.layout, database.failures, database.warnings) == ("table", (), ())
    assert database.labelings[0] == "label"
    first = database.shapes[0]
    assert (first.id, first.name, first.labels["label"]) == ("airplane/00", "airplane 00", "airplane")
    assert list(first.metadata)[:4] == ["number", "kind", "material", "height cm"]
