"""Text that a spreadsheet program would take for a formula."""

from __future__ import annotations

import csv
import io
import os
from dataclasses import replace

import pytest
from reports import make_report

from shapeviz_report import __version__
from shapeviz_report.bins import read_bins
from shapeviz_report.cells import read_cell, write_cell
from shapeviz_report.database import read_database
from shapeviz_report.errors import ConfigError, DatabaseError
from shapeviz_report.external import load_external
from shapeviz_report.types import FeatureBlock
from shapeviz_report.writing.data import data_files, read_site
from shapeviz_report.writing.data.encoding import csv_text

FORMULAS = [
    *("=1+1", "+A1", "-2+3+cmd|'!A0", "@SUM(1)", "\t=1", "\r=1", "\n=1"),
    *("-", "--1", "\uff1d1", "-inf", "'=1", "''-x"),
]
PLAIN = ["", "a=b", "it's", "'tis", "-5", "-0.25", "+1e-7", "-.5E+3", "12", "a\tb", "é", "1-"]


@pytest.mark.parametrize("text", FORMULAS)
def test_a_formula_becomes_text_and_comes_back(text) -> None:
    assert write_cell(text) == "'" + text
    assert read_cell(write_cell(text)) == text


@pytest.mark.parametrize("text", PLAIN)
def test_other_text_and_numbers_stay(text) -> None:
    assert write_cell(text) == text
    assert read_cell(text) == text


def test_every_cell_of_a_file_is_written_so() -> None:
    rows = [["id", "=HYPERLINK(1)"], ["@a,b", "-0.5"]]
    written = list(csv.reader(io.StringIO(csv_text(rows).decode())))
    assert written == [["id", "'=HYPERLINK(1)"], ["'@a,b", "-0.5"]]


def test_bins_of_a_feature_named_like_a_formula_are_read(tmp_path) -> None:
    blocks = (FeatureBlock("=deep", 2, 1),)
    (tmp_path / "scores.csv").write_text("bin,chosen\n'=deep[1],1\n")
    assert read_bins(tmp_path / "scores.csv", blocks) == ("=deep[1]",)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes")
def test_a_pipe_is_refused_wherever_a_file_is_read(tmp_path) -> None:
    for name in ("bins.txt", "values.npy", "table.csv", "all.cla"):
        os.mkfifo(tmp_path / name)
    said = "not a regular file"
    with pytest.raises(ConfigError, match=said):
        read_bins(tmp_path / "bins.txt", ())
    with pytest.raises(ConfigError, match=said):
        load_external(tmp_path / "values.npy", ["a"])
    for name in ("table.csv", "all.cla"):
        with pytest.raises(DatabaseError):
            read_database(tmp_path / name)


def test_a_query_reads_names_as_they_were(tmp_path, monkeypatch) -> None:
    report = make_report(["=kind", "+other"], 3)
    ids = tuple(f"={shape.id}" for shape in report.shapes)
    shapes = tuple(replace(shape, id=name) for shape, name in zip(report.shapes, ids, strict=True))
    report = replace(report, shapes=shapes, features=replace(report.features, shape_ids=ids))
    (tmp_path / "data").mkdir()
    for name, content in data_files(report, __version__):
        (tmp_path / "data" / name).write_bytes(content)
    monkeypatch.setattr("shapeviz_report.presets.Preset.blocks", report.features.blocks)
    site = read_site(tmp_path)
    assert [shape["id"] for shape in site.shapes] == list(ids)
    assert {shape["class"] for shape in site.shapes} == {"=kind", "+other"}
