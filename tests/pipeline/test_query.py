"""A mesh as a query of a built site: prepared and measured as the site's own shapes were."""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from reports import with_bins, with_external
from small_database import OPTIONS, make_shape, write_database

import shapeviz_report
from shapeviz_report.cli import main
from shapeviz_report.errors import ConfigError, MeshError, SiteError
from shapeviz_report.pages import base
from shapeviz_report.presets import PRESETS, scale
from shapeviz_report.types import Report
from shapeviz_report.writing import write_site


@pytest.fixture
def ask(built, cache):
    return lambda mesh, **options: shapeviz_report.query(built[0], mesh, cache=cache, **options)


def test_a_mesh_of_the_database_finds_itself(ask, built, database) -> None:
    _, report = built
    result = ask(database / "ring" / "2.off", count=99)
    itself = result.found[0]
    assert (itself.id, itself.label, itself.file) == ("ring/2", "ring", "ring/2.off")
    assert itself.distance == pytest.approx(0, abs=1e-6)
    assert set(itself.closer.values()) == {1.0}
    assert result.facts == report.facts[report.features.shape_ids.index("ring/2")]
    scaled = scale(report.features, PRESETS["default"])
    row = report.features.shape_ids.index("ring/2")
    for found in result.found:
        there = report.features.shape_ids.index(found.id)
        assert found.distance == pytest.approx(np.linalg.norm(scaled[there] - scaled[row]), abs=1e-6)


def test_a_new_shape_finds_its_kind(ask, tmp_path) -> None:
    for kind in ("box", "ring"):
        path = tmp_path / f"{kind}.ply"
        make_shape(kind, 77).export(path)
        result = ask(path, count=3)
        assert {found.label for found in result.found} == {kind}
        assert 0 < result.found[0].distance < result.typical


def test_a_moved_and_grown_mesh_is_the_same_shape(ask, tmp_path) -> None:
    path = tmp_path / "moved.off"
    shape = make_shape("ring", 3)
    shape.apply_scale(40)
    shape.apply_translation([5, -3, 100])
    shape.export(path)
    first, second = ask(path, count=2).found
    assert first.id == "ring/3"
    assert first.distance < second.distance / 2


def test_typical_is_the_mean_over_pairs(ask, built, database) -> None:
    _, report = built
    result = ask(database / "box" / "0.off", features=["Gc", "PFH"])
    scaled = scale(report.features, PRESETS["default"])
    columns = np.r_[report.features.slice_of("Gc"), report.features.slice_of("PFH")]
    pairs = scaled[:, None, columns] - scaled[None, :, columns]
    count = len(scaled)
    squared = (pairs**2).sum(axis=2).sum() / (count * (count - 1))
    assert result.typical == pytest.approx(np.sqrt(squared))


def test_features_and_bins_are_chosen(ask, database, tmp_path) -> None:
    mesh = database / "ball" / "0.off"
    everything = ask(mesh, count=5)
    assert everything.features == tuple(block.name for block in PRESETS["default"].blocks)
    one = ask(mesh, features=["Nd"], count=5)
    assert (one.features, one.bins) == (("Nd",), None)
    bins = tmp_path / "bins.txt"
    bins.write_text("PFH[3]:2\nNd:4\n")
    some = ask(mesh, bins=bins, count=5)
    assert (some.features, some.bins) == (None, ("Nd:4", "PFH[3]:2"))
    assert len({tuple(found.distance for found in result.found) for result in (everything, one, some)}) == 3


def test_the_paper_preset_measures_with_the_database_s_own_ranges(cache, tmp_path) -> None:
    database, site = write_database(tmp_path / "d", per_class=2), tmp_path / "site"
    shapeviz_report.build(database, site, cache=cache, preset="paper", **OPTIONS)
    found = shapeviz_report.query(site, database / "box" / "1.off", cache=cache, count=1).found[0]
    assert found.id == "box/1"
    assert found.distance == pytest.approx(0, abs=1e-6)


def unscored(report: Report) -> Report:
    """The report without scores, which know nothing of a feature that comes later."""
    return replace(report, scores=None)


def test_features_that_were_brought_along_are_left_out_and_refused(built, database, cache, tmp_path) -> None:
    site, bins = tmp_path / "site", tmp_path / "bins.txt"
    write_site(with_external(unscored(built[1])), site)
    mesh = database / "box" / "1.off"
    result = shapeviz_report.query(site, mesh, cache=cache, count=1)
    assert result.left_out == ("own",)
    assert result.found[0].id == "box/1"
    assert "own" not in result.found[0].closer
    with pytest.raises(ConfigError, match="'own' cannot be compared"):
        shapeviz_report.query(site, mesh, cache=cache, features=["own"])
    bins.write_text("own[0]\n")
    with pytest.raises(ConfigError, match=r"'own\[0\]', which was brought along"):
        shapeviz_report.query(site, mesh, cache=cache, bins=bins)


def test_a_site_of_chosen_bins_is_compared_by_these(built, database, cache, tmp_path) -> None:
    report = with_external(unscored(built[1]))
    mesh = database / "box" / "1.off"
    write_site(with_bins(report, ("Nd:4", "Na:2", "own[1]")), tmp_path / "some")
    result = shapeviz_report.query(tmp_path / "some", mesh, cache=cache)
    assert (result.bins, result.left_out) == (("Nd:4", "Na:2"), ("own[1]",))
    write_site(with_bins(report, ("own[1]",)), tmp_path / "own")
    with pytest.raises(ConfigError, match="only values that were brought along"):
        shapeviz_report.query(tmp_path / "own", mesh, cache=cache)


@pytest.mark.parametrize(
    ("content", "reason"), [("OFF\n1 2", "cannot be used"), (None, "cannot be opened"), ("", "empty")]
)
def test_a_mesh_that_cannot_be_used_says_why(ask, tmp_path, content, reason) -> None:
    mesh = tmp_path / "mesh.off"
    if content is not None:
        mesh.write_text(content)
    with pytest.raises(MeshError, match=reason):
        ask(mesh)


def test_what_is_no_site_of_this_version_says_so(built, database, cache, tmp_path) -> None:
    mesh = database / "box" / "1.off"

    def query(site: Path) -> None:
        shapeviz_report.query(site, mesh, cache=cache)

    with pytest.raises(SiteError, match="is not a folder that"):
        query(database)
    site = shutil.copytree(built[0] / "data", tmp_path / "site" / "data").parent
    summary = json.loads((site / "data" / "summary.json").read_text())
    for change, reason in (
        ({"version": "0.0.1"}, "version 0.0.1"),
        ({"generator": "another"}, "not a site of shapeviz-report"),
        ({"parameters": {}}, "not complete"),
        ({"features": summary["features"][1:]}, "different builds"),
    ):
        (site / "data" / "summary.json").write_text(json.dumps(summary | change))
        with pytest.raises(SiteError, match=reason):
            query(site)
    (site / "data" / "summary.json").write_text(json.dumps(summary))
    (site / "data" / "features.npz").write_bytes(b"PK\x03\x04 cut off")
    with pytest.raises(SiteError, match="not complete"):
        query(site)


def test_features_that_a_large_site_leaves_out_are_described(
    ask, built, database, cache, tmp_path, monkeypatch
) -> None:
    mesh = database / "box" / "1.off"
    site = shutil.copytree(built[0] / "data", tmp_path / "site" / "data").parent
    features = site / "data" / "features.npz"
    features.unlink()
    monkeypatch.setattr(base, "MOST_IN_FULL", 10)
    with pytest.raises(SiteError, match=f"shapeviz-report describe DATABASE -o {re.escape(str(features))}"):
        shapeviz_report.query(site, mesh, cache=cache)
    options = ["--edge-length", OPTIONS["edge_length"], "--jobs", 1, "--cache", cache]
    assert main([str(part) for part in ("describe", database, "-o", features, *options)]) == 0
    assert shapeviz_report.query(site, mesh, cache=cache) == ask(mesh)


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"features": ["Gc", "Colour"]}, "no feature 'Colour'"),
        ({"features": ["Gc", "Gc"]}, "named 2 times"),
        ({"features": []}, "no feature is named"),
        ({"features": "PFH"}, "a list of names, .* and not the text 'PFH'"),
        ({"count": 0}, "whole number from 1 on, not 0"),
        ({"count": 2.5}, "whole number from 1 on, not 2.5"),
        ({"features": ["Gc"], "bins": "bins.txt"}, "choose one"),
    ],
)
def test_what_cannot_be_compared_says_why(ask, database, options, reason) -> None:
    with pytest.raises(ConfigError, match=reason):
        ask(database / "box" / "1.off", **options)


def test_the_command_prints_a_table_or_json(built, database, cache, capsys) -> None:
    command = ["query", built[0], database / "box" / "1.off", "-n", "4", "--cache", cache]
    assert main([*map(str, command)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "the most similar of 15 shapes of Some solids, by Gc, Agd" in lines[0]
    heading = next(number for number, line in enumerate(lines) if line.split()[:2] == ["distance", "class"])
    first = lines[heading + 1].split()
    assert first[:3] == ["1", "0.000", "box"]
    assert first[-1] == "box/1"
    assert len(lines) == heading + 5

    assert main([*map(str, command), "--features", "FPFH, Gc", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["features"] == ["Gc", "FPFH"]
    assert told["found"][0]["id"] == "box/1"
    assert told["facts"]["watertight"] is True


def test_the_command_says_what_is_wrong(tmp_path, capsys) -> None:
    write_database(tmp_path / "d", per_class=1)
    assert main(["query", str(tmp_path / "d"), str(tmp_path / "d" / "box" / "0.off")]) == 1
    assert "is not a folder that" in capsys.readouterr().err
