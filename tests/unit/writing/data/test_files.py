"""What scripts read from ``data/``."""

import csv
import io
import json
from dataclasses import replace

import numpy as np
import pytest
from pyarrow import parquet
from reports import NASTY_LABELS, make_report, with_bin_search, with_bins, with_scores, with_search

from shapeviz_report.bins import read_bins
from shapeviz_report.pages import base
from shapeviz_report.types import Failure
from shapeviz_report.writing.data import data_files, json_text, summary
from shapeviz_report.writing.data.encoding import read_archive
from shapeviz_report.writing.data.tables import shape_rows


@pytest.fixture
def folder(tmp_path):
    """``data/`` of a small report with strange labels, and the report."""
    report = make_report(
        [*NASTY_LABELS[:3], None],
        6,
        failures=[Failure("bad.off", "read", "no faces")],
        metadata={"artist": 'O"Neill, line\nbreak', "__proto__": "x"},
    )
    for name, content in data_files(report, "1.2.3"):
        (tmp_path / name).write_bytes(content)
    return tmp_path, report


def rows_of(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_summary_has_the_promised_keys(folder):
    path, report = folder
    content = json.loads((path / "summary.json").read_text())
    assert content["generator"] == "shapeviz-report"
    assert content["version"] == "1.2.3"
    assert (content["shapes"], content["classes"], content["unlabelled"]) == (24, 3, 6)
    assert content["failures"] == [{"path": "bad.off", "stage": "read", "reason": "no faces"}]
    assert content["seconds"] == report.seconds
    assert content["cpu_seconds"] == report.cpu_seconds
    assert content["parameters"]["edge_length"] == 0.01
    assert set(content["projections"]) == {"tsne", "umap", "pca"}
    tsne = content["projections"]["tsne"]
    quality = report.projections["tsne"][1]
    assert tsne["features"] == ["Gc", "Sc"]
    assert tsne["bins"] is None
    assert tsne["nh_s"] == quality.nh_s
    assert tsne["nh_c"] == dict(quality.nh_c)
    assert list(tsne["nh_c"]) == list(quality.nh_c)
    assert tsne["null"] == {"mean": quality.null_mean, "std": quality.null_std}
    assert content["repairs"]["class000/0000"] == {"duplicate faces removed": 4}
    assert "class000/0001" not in content["repairs"]


def test_summary_without_labels_has_nulls():
    content = summary(make_report([None], 5), "1")
    assert content["labeling"] is None
    assert content["projections"]["pca"]["nh_s"] is None
    assert content["projections"]["pca"]["null"] == {"mean": None, "std": None}
    assert content["projections"]["pca"]["nh_c"] == {}


def test_shapes_table_keeps_every_text_as_it_is(folder):
    path, report = folder
    rows = rows_of(path / "shapes.csv")
    assert [row["id"] for row in rows] == [shape.id for shape in report.shapes]
    assert [row["class"] for row in rows] == [label or "" for label in report.labels]
    assert [row["label:folder"] for row in rows] == [label or "" for label in report.labels]
    assert {row["metadata:artist"] for row in rows} == {'O"Neill, line\nbreak'}
    assert rows[0]["file"] == "class000/0000.off"
    assert rows[0]["sha256"] == report.facts[0].sha256
    assert float(rows[0]["nh:umap"]) == report.projections["umap"][1].nh[0]
    assert rows[-1]["nh:umap"] == ""


def test_coordinates_read_back_exactly(folder):
    path, report = folder
    for method, (projection, _) in report.projections.items():
        rows = rows_of(path / f"projection-{method}.csv")
        assert [row["id"] for row in rows] == [shape.id for shape in report.shapes]
        np.testing.assert_array_equal([[float(row["x"]), float(row["y"])] for row in rows], projection.xy)


def test_features_need_no_pickle(folder):
    path, report = folder
    with np.load(path / "features.npz", allow_pickle=False) as content:
        np.testing.assert_array_equal(content["values"], report.features.values)
        assert tuple(content["columns"]) == report.features.columns
        assert tuple(content["shape_ids"]) == report.features.shape_ids
        np.testing.assert_array_equal(content["edges"], report.edges)


def test_features_of_many_shapes_come_in_files_of_so_many_rows(tmp_path, monkeypatch):
    monkeypatch.setattr(base, "ROWS_A_FILE", 7)
    report = make_report(["ant", "bird"], 8)
    files = {name: content for name, content in data_files(report, "1") if name.startswith("features")}
    assert list(files) == ["features-1.npz", "features-2.npz", "features-3.npz"]
    parts = [read_archive(content) for content in files.values()]
    assert [len(part["values"]) for part in parts] == [7, 7, 2]
    np.testing.assert_array_equal(np.concatenate([part["values"] for part in parts]), report.features.values)
    assert tuple(np.concatenate([part["shape_ids"] for part in parts])) == report.features.shape_ids
    for part in parts:
        np.testing.assert_array_equal(part["edges"], report.edges)


def test_summary_names_the_bins_that_maps_are_made_of():
    content = summary(with_bins(make_report(), ("Gc:3", "Gc:4")), "1")
    assert {tuple(projection["bins"]) for projection in content["projections"].values()} == {("Gc:3", "Gc:4")}
    assert content["projections"]["pca"]["features"] == ["Gc"]


def test_scores_stand_beside_what_they_are_scores_of(tmp_path):
    report = with_scores(make_report([*NASTY_LABELS[:3], None], 4))
    (tmp_path / "scores.npz").write_bytes(dict(data_files(report, "1"))["scores.npz"])
    with np.load(tmp_path / "scores.npz", allow_pickle=False) as content:
        np.testing.assert_array_equal(content["scores"], report.scores.values)
        assert tuple(content["methods"]) == report.scores.methods
        assert tuple(content["classes"]) == tuple(sorted(NASTY_LABELS[:3]))
        assert tuple(content["columns"]) == report.features.columns
    assert "scores.npz" not in dict(data_files(make_report(), "1"))


@pytest.fixture(scope="module")
def searched():
    return with_bin_search(make_report([*NASTY_LABELS[:3], None], 6))


class TestBins:
    @pytest.mark.slow
    def test_summary_has_the_promised_keys(self, searched):
        bins = json.loads(dict(data_files(searched, "1"))["summary.json"])["bins"]
        automatic = bins["automatic"]
        assert tuple(automatic["bins"]) == searched.bins.automatic.bins
        assert automatic["nh_s"] == searched.bins.automatic.nh_s == automatic["path"][-1]["nh_s"]
        assert automatic["seconds"] == searched.bins.automatic.cpu_seconds
        for part, folds in (("held_out", searched.bins.held_out), ("permuted", searched.bins.shuffled)):
            weights = [fold.shapes for fold in folds]
            for name in ("nh_s", "knn_accuracy"):
                mean = np.average([getattr(fold, name) for fold in folds], weights=weights)
                assert automatic[part][name] == pytest.approx(mean)
        assert set(bins["minimal"]) == set(NASTY_LABELS[:3])
        for separated in searched.bins.minimal:
            sets = bins["minimal"][separated.label]
            assert [(tuple(s["bins"]), s["nh_c"]) for s in sets] == [(s.bins, s.nh_c) for s in separated.sets]

    def test_the_list_of_selected_bins_is_what_a_build_reads(self, searched, tmp_path):
        path = tmp_path / "selected-bins.txt"
        path.write_bytes(dict(data_files(searched, "1"))["selected-bins.txt"])
        assert read_bins(path, searched.features.blocks) == searched.bins.automatic.bins

    def test_without_a_search_there_is_neither(self):
        assert summary(make_report(), "1")["bins"] is None
        assert "selected-bins.txt" not in dict(data_files(make_report(), "1"))


@pytest.fixture(scope="module")
def report():
    return with_search(make_report([*NASTY_LABELS[:3], None], 6, features=("Gc", "Sc", 'own "one", x')))


class TestSearch:
    @pytest.fixture
    def folder(self, report, tmp_path):
        for name, content in data_files(report, "1"):
            (tmp_path / name).write_bytes(content)
        return tmp_path

    def test_summary_has_the_promised_keys(self, report, folder):
        search = json.loads((folder / "summary.json").read_text())["search"]
        assert search["method"] == "tsne"
        assert search["exhaustive"]["runs"] == len(search["exhaustive"]["subsets"]) == 7
        assert search["exhaustive"]["seconds"] == pytest.approx(report.search.subsets.cpu_seconds.sum())
        best = search["exhaustive"]["subsets"][0]
        assert best["nh_s"] == report.search.subsets.nh_s.max()
        assert set(best["nh_c"]) == set(NASTY_LABELS[:3])
        assert search["greedy"]["s"] == 1
        assert search["greedy"]["path"][-1]["nh_s"] == report.search.greedy[0].path[-1].nh_s
        assert [run["s"] for run in search["greedy_all"]] == [run.s for run in report.search.greedy]
        assert len(search["table"]) == len(report.search.table)
        assert search["effects"]["Gc"]["alone"] == report.search.effects[0].alone
        # Ten deals, by the maps of both rounds in turn.
        assert sum(fold["shapes"] for fold in search["held_out"]) == 180
        assert {(fold["deal"], fold["seed"]) for fold in search["held_out"]} == {
            (d + 1, d % 2) for d in range(10)
        }
        gains = [(f["nh_s"] - f["nh_s_all"]) * f["shapes"] for f in search["held_out"]]
        assert search["held_out_gain"]["mean"] == pytest.approx(sum(gains) / 180)
        assert search["held_out_gain"]["deals"] == 10
        assert search["spread"][0]["behind"] == 0

    def test_tables_hold_every_subset_step_and_round(self, report, folder):
        subsets = rows_of(folder / "subsets.csv")
        scores = [float(row["nh_s"]) for row in subsets]
        assert scores == sorted(report.search.subsets.nh_s, reverse=True)
        members = {tuple(row[f"feature:{name}"] for name in report.search.features) for row in subsets}
        assert members == {
            tuple("01"[has] for has in row.astype(int)) for row in report.search.subsets.members
        }
        assert f"nh_c:{NASTY_LABELS[0]}" in subsets[0]
        steps = rows_of(folder / "greedy.csv")
        assert len(steps) == sum(len(run.path) for run in report.search.greedy)
        rounds = rows_of(folder / "table2.csv")
        assert {(row["round"], row["method"], row["s"]) for row in rounds} == {
            (str(row.round), row.method, "" if row.s is None else str(row.s)) for row in report.search.table
        }

    def test_tables_hold_no_times(self, report, folder):
        subsets = replace(report.search.subsets, cpu_seconds=report.search.subsets.cpu_seconds + 7)
        table = tuple(replace(row, cpu_seconds=row.cpu_seconds + 7) for row in report.search.table)
        slower = replace(report, search=replace(report.search, subsets=subsets, table=table))
        for name, content in data_files(slower, "1"):
            assert (content == (folder / name).read_bytes()) == (name != "summary.json")

    def test_without_labels_there_are_subsets_without_scores(self, tmp_path):
        files = dict(data_files(with_search(make_report([None], 8)), "1"))
        assert "table2.csv" not in files
        search = json.loads(files["summary.json"])["search"]
        assert search["greedy"] is None
        assert [subset["nh_s"] for subset in search["exhaustive"]["subsets"]] == [None] * 3
        faithful = "kept,trustworthiness,continuity,stress,stress_by_chance"
        head = f"feature:Gc,feature:Sc,nh_s,nh_max,{faithful}"
        assert files["subsets.csv"].decode().splitlines()[0] == head

    @pytest.mark.slow
    def test_a_search_that_could_not_be_exhaustive_says_so(self):
        report = with_search(make_report(["a", "b"], 4, features=[f"f{number}" for number in range(11)]))
        search = summary(report, "1")["search"]
        assert search["exhaustive"] is None
        assert "2,047" in search["refusal"]
        assert search["evaluated"]["runs"] == len(search["evaluated"]["subsets"]) < 2047


def test_json_refuses_what_is_not_json():
    with pytest.raises(ValueError, match="not JSON compliant"):
        json_text({"value": float("nan")})


def keys_beside(value: object, name: str) -> list[dict[str, object]]:
    """Every mapping that has a key, at any depth."""
    if isinstance(value, list):
        return [found for item in value for found in keys_beside(item, name)]
    if not isinstance(value, dict):
        return []
    own = [value] if name in value else []
    return own + [found for item in value.values() for found in keys_beside(item, name)]


@pytest.mark.slow
def test_the_maximum_stands_beside_every_hit() -> None:
    """Six of a class have at most five of ten neighbours in it."""
    report = with_bin_search(with_search(make_report(("ant", "bird", "cup"), 6)))
    content = json.loads(dict(data_files(report, "1.2.3"))["summary.json"])
    for name in ("nh_s", "nh_c"):
        places = keys_beside(content, name)
        assert len(places) > 10
        assert all(place["nh_max"] == pytest.approx(0.5) for place in places)
    of_classes = [place for place in keys_beside(content, "nh_c") if isinstance(place["nh_c"], dict)]
    assert all(place["nh_c_max"] == {"ant": 0.5, "bird": 0.5, "cup": 0.5} for place in of_classes)
    tsne = content["projections"]["tsne"]
    chance = tsne["null"]["mean"]
    assert tsne["nh_share"] == pytest.approx((tsne["nh_s"] - chance) / (0.5 - chance))
    by_chance = content["bins"]["minimal_by_chance"]
    assert list(by_chance) == ["6"]
    assert [len(found["bins"]) for found in by_chance["6"]] == [1, 2]
    gain = content["bins"]["automatic"]["held_out"]["gain"]
    assert gain["deals"] == 1
    assert gain["spread"] >= 0


def test_parquet_has_the_tables_with_types_and_places():
    labels = [*NASTY_LABELS[:3], None]
    metadata = {"artist": 'O"Neill, line\nbreak', "formula": "=1+1", "bytes": "\udcff"}
    report = make_report(labels, 6, metadata=metadata)
    report = replace(report, parameters={**report.parameters, "parquet": True})
    files = dict(data_files(report, "1"))
    table = parquet.read_table(io.BytesIO(files["shapes.parquet"]))
    head = next(shape_rows(report))
    assert table.column_names == [*head, *(f"{axis}:{name}" for name in report.projections for axis in "xy")]
    assert table["id"].to_pylist() == [shape.id for shape in report.shapes]
    assert table["class"].to_pylist() == list(report.labels)
    assert set(table["metadata:formula"].to_pylist()) == {"=1+1"}
    assert set(table["metadata:bytes"].to_pylist()) == {r"\udcff"}
    assert table["faces_read"].to_pylist() == [facts.faces_read for facts in report.facts]
    assert table["watertight"].to_pylist() == [facts.watertight for facts in report.facts]
    assert table["volume"].to_pylist() == [facts.volume for facts in report.facts]
    assert table["nh_max"].null_count == 6
    assert table["repairs"].null_count > 0
    for method, (projection, quality) in report.projections.items():
        places = np.stack([table[f"{axis}:{method}"].to_numpy() for axis in "xy"], axis=1)
        np.testing.assert_array_equal(places, projection.xy)
        np.testing.assert_array_equal(table[f"nh:{method}"].to_numpy(), quality.nh)
    features = parquet.read_table(io.BytesIO(files["features.parquet"]))
    assert features.column_names == ["id", *report.features.columns]
    assert features["id"].to_pylist() == list(report.features.shape_ids)
    np.testing.assert_array_equal(
        np.stack([features[name].to_numpy() for name in report.features.columns], axis=1),
        report.features.values,
    )
    assert dict(data_files(report, "1")) == files
    assert not any(name.endswith(".parquet") for name, _ in data_files(make_report(labels, 6), "1"))
