"""A site that is broken, half there or another's: a query says so, and measures nothing."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
from reports import make_report

from shapeviz_report.building.query import find_similar
from shapeviz_report.errors import CacheError, SiteError
from shapeviz_report.pages import base
from shapeviz_report.writing import write_site


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    site = tmp_path_factory.mktemp("sites") / "site"
    write_site(make_report(), site)
    return site


def ask(site: Path, cache: Path) -> None:
    find_similar(site, Path("nowhere.off"), cache=cache, time_limit=60)


def spoil(file: Path, how: str) -> None:
    content = file.read_bytes()
    file.unlink()
    if how == "pipe":
        os.mkfifo(file)
    elif how == "folder":
        file.mkdir()
    elif how == "loop":
        file.symlink_to(file)
    elif how == "200 GB":
        file.touch()
        os.truncate(file, 200 * 2**30)
    elif how != "missing":
        file.write_bytes({"empty": b"", "half": content[: len(content) // 2], "zeros": bytes(5000)}[how])


@pytest.mark.parametrize("name", ["summary.json", "shapes.csv", "features.npz"])
def test_a_file_of_a_site_that_cannot_be_read_is_told(site, tmp_path, name):
    with pytest.raises(SiteError, match="has other features than this version measures"):
        ask(site, tmp_path / "cache")  # whole, if not of real features
    for how in ("missing", "empty", "half", "zeros", "pipe", "folder", "loop", "200 GB"):
        copy = shutil.copytree(site / "data", tmp_path / how / "data").parent
        spoil(copy / "data" / name, how)
        with pytest.raises(SiteError, match=name) as refused:
            ask(copy, tmp_path / "cache")
        assert "[Errno" not in str(refused.value)


@pytest.mark.parametrize(
    "change",
    [
        {"projections": {}},
        {"projections": {"tsne": None}},
        {"projections": {"tsne": {"bins": ["no such"]}}},
        {"features": "x"},
        {"features": [{"name": "Gc", "dimensions": 10**9, "bins": 10}]},
        {"parameters": {"preset": "default", "edge_length": float("nan")}},
        {"parameters": {"preset": [], "edge_length": 0.01}},
        {"parameters": {"preset": "default", "edge_length": None}},
        {"database": None},
    ],
)
def test_a_summary_that_no_build_writes_is_told(site, tmp_path, change):
    copy = shutil.copytree(site / "data", tmp_path / "site" / "data").parent
    summary = json.loads((site / "data" / "summary.json").read_text())
    (copy / "data" / "summary.json").write_text(json.dumps(summary | change))
    with pytest.raises(SiteError, match=r"not complete, build it again: summary\.json"):
        ask(copy, tmp_path / "cache")


@pytest.mark.parametrize("change", ["not finite", "fewer rows", "text", "no columns"])
def test_features_that_no_build_writes_are_told(site, tmp_path, change):
    copy = shutil.copytree(site / "data", tmp_path / "site" / "data").parent
    with np.load(site / "data" / "features.npz") as archive:
        arrays = dict(archive)
    values = arrays["values"]
    if change == "no columns":
        del arrays["columns"]
    else:
        arrays["values"] = {
            "not finite": values * np.nan,
            "fewer rows": values[1:],
            "text": values.astype("U9"),
        }[change]
    np.savez(copy / "data" / "features.npz", **arrays)
    with pytest.raises(SiteError, match=r"not complete, build it again: features\.npz"):
        ask(copy, tmp_path / "cache")


def test_features_in_several_files_are_one_table(tmp_path, monkeypatch):
    monkeypatch.setattr(base, "ROWS_A_FILE", 10)
    report = make_report()
    write_site(report, tmp_path / "site")
    data = tmp_path / "site" / "data"
    assert sorted(path.name for path in data.glob("features*")) == [f"features-{n}.npz" for n in (1, 2, 3)]
    with pytest.raises(SiteError, match="has other features than this version measures"):
        ask(tmp_path / "site", tmp_path / "cache")  # whole, if not of real features
    with np.load(data / "features-2.npz") as archive:
        arrays = dict(archive)
    np.savez(data / "features-2.npz", **arrays | {"edges": arrays["edges"] + 1})
    with pytest.raises(SiteError, match=r"features\.npz: its parts are of different builds"):
        ask(tmp_path / "site", tmp_path / "cache")
    (data / "features-2.npz").unlink()
    with pytest.raises(SiteError, match=r"features-2\.npz cannot be read"):
        ask(tmp_path / "site", tmp_path / "cache")


def test_a_cache_that_takes_no_results_is_refused_first(site, tmp_path):
    (tmp_path / "cache").write_text("a file")
    with pytest.raises(CacheError, match="results cannot be kept"):
        ask(site, tmp_path / "cache")
