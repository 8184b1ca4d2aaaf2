"""Whole builds of a small real database: complete, reproducible, resumable, and not stopped by strange files."""

from __future__ import annotations

import csv
import gzip
import io
import json
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import trimesh
from packed_models import unpack
from PIL import Image
from scipy.spatial.distance import pdist
from small_database import OPTIONS, WITH_SEARCH, make_shape, read_site, write_database

import shapeviz_report
from shapeviz_report.bins import scale_bins
from shapeviz_report.building import runner, workers
from shapeviz_report.building.pipeline import build_report
from shapeviz_report.building.progress import QuietProgress
from shapeviz_report.building.stages import PAINT
from shapeviz_report.config import Config
from shapeviz_report.errors import ConfigError, DatabaseError, ShapevizError, SiteError
from shapeviz_report.features import BINS
from shapeviz_report.presets import PRESETS, compared_values
from shapeviz_report.projections import PROJECTIONS
from shapeviz_report.pruning import list_entries, remove
from shapeviz_report.scorers import SCORERS, as_one_group, score_separation
from shapeviz_report.search.bins import affordable_deals, find_minimal_bins, make_bin_space


def entries(cache: Path, stage: str) -> dict[Path, int]:
    """The cache entries of a stage and when they were written."""
    return {p: p.stat().st_mtime_ns for p in (cache / stage).rglob("*") if p.is_file()}


def test_a_site_is_complete(built) -> None:
    site, report = built
    summary = json.loads((site / "data/summary.json").read_text())
    assert (summary["shapes"], summary["classes"], summary["failures"]) == (15, 3, [])
    assert summary["database"] == "Some solids"
    assert list(summary["projections"]) == [method.name for method in PROJECTIONS]
    for name, (_, quality) in report.projections.items():
        assert summary["projections"][name]["nh_s"] == quality.nh_s
        assert set(summary["projections"][name]["nh_c"]) == {"box", "ball", "ring"}
    assert set(summary["seconds"]) >= {"read", "prepare", "describe", "render", "project", "score"}
    assert summary["cpu_seconds"]["prepare"] > 0
    assert (site / "index.html").is_file()
    assert (site / "about.html").is_file()
    assert len(list((site / "thumbnails").glob("*.webp"))) == 15
    assert len(list((site / "models").glob("*.js"))) == 15
    assert (site / "bins.html").is_file()
    with np.load(site / "data/features.npz", allow_pickle=False) as features:
        assert features["values"].shape == (15, len(report.features.columns))
        assert features["shape_ids"].tolist() == [s.id for s in report.shapes]
    with open(site / "data/shapes.csv", newline="", encoding="utf-8") as file:
        assert len(list(csv.DictReader(file))) == 15


def test_the_search_goes_over_all_subsets_of_the_papers_features(built) -> None:
    _, report = built
    search = report.search
    assert search.features == tuple(block.name for block in report.features.blocks)
    local = sum(block.bins > 1 for block in report.features.blocks)
    whole = search.subsets.members[:, local:]
    assert (~whole.any(axis=1)).sum() == 2**local - 1
    assert set(whole[search.subsets.members.sum(axis=1) == 1].sum(axis=1)) == {0, 1}
    everything = search.subsets.nh_s[search.subsets.members.all(axis=1)]
    assert everything == pytest.approx(report.projections["tsne"][1].nh_s)
    assert search.subsets.nh_s.max() >= everything
    assert "search" in report.seconds


def test_a_search_that_was_stopped_continues(database, own_cache, built, tmp_path) -> None:
    found = entries(own_cache, "searched")
    lost = sorted(found)[::2]
    for path in lost:
        path.unlink()
    report = shapeviz_report.build(database, tmp_path / "site", cache=own_cache, **WITH_SEARCH)
    again = entries(own_cache, "searched")
    assert again.keys() == found.keys()
    assert {path for path in found if again[path] != found[path]} == set(lost)
    np.testing.assert_array_equal(report.search.subsets.xy, built[1].search.subsets.xy)


def test_groups_are_found(built) -> None:
    _, report = built
    # Four of the ten neighbours can be of the own class.
    assert report.projections["tsne"][1].nh_s > 0.35
    assert report.projections["tsne"][1].null_mean == pytest.approx(4 / 14, abs=0.02)


def test_the_same_site_again_whatever_the_order_jobs_and_cache(built, database, tmp_path) -> None:
    site, _ = built
    copy = tmp_path / "Some solids"
    for path in sorted(database.rglob("*.off"), reverse=True):
        (copy / path.parent.name).mkdir(parents=True, exist_ok=True)
        shutil.copy(path, copy / path.parent.name)
    shapeviz_report.build(copy, tmp_path / "site", cache=tmp_path / "cache", **WITH_SEARCH | {"jobs": 2})
    first, second = read_site(site), read_site(tmp_path / "site")
    assert first.keys() == second.keys()
    assert [name for name in first if first[name] != second[name]] == []


def test_only_a_changed_mesh_is_computed_again(database, own_cache, built, tmp_path) -> None:
    copy = Path(shutil.copytree(database, tmp_path / "Some solids"))
    before = {stage: entries(own_cache, stage) for stage in ("prepared", "described", "rendered")}
    make_shape("ring", 99).export(copy / "ring" / "0.off")
    report = shapeviz_report.build(copy, tmp_path / "site", cache=own_cache, **OPTIONS)
    assert len(report.shapes) == 15
    for stage, old in before.items():
        new = entries(own_cache, stage)
        assert {p: new[p] for p in old} == old, "an entry was written again"
        assert len(new) == len(old) + 1


class Watcher(QuietProgress):
    """Calls a function before a stage."""

    def __init__(self, act, stage="Writing the site") -> None:
        self.act = act
        self.at = stage

    def stage(self, doing, total):
        if doing == self.at:
            self.act()
        return super().stage(doing, total)


def test_what_a_pruned_cache_has_lost_is_made_again_by_all_processes(
    built, database, own_cache, tmp_path, monkeypatch, caplog
) -> None:
    opened = []

    def open_workers(config, jobs):
        opened.append(jobs)
        return workers.open_workers(config, jobs)

    def prune() -> None:
        assert remove(list_entries(own_cache))[0] > 100
        monkeypatch.setattr(runner, "open_workers", open_workers)

    config = Config(cache=own_cache, **WITH_SEARCH | {"jobs": 2})
    build_report(database, tmp_path / "site", config, Watcher(prune))
    assert read_site(built[0]) == read_site(tmp_path / "site")
    assert opened == [2], "neither a worker a shape, nor one worker for all"
    assert len(entries(own_cache, "described")) == 15
    assert caplog.messages == [f"Note: results have gone from the cache {own_cache}; they are made again."]


def test_a_mesh_that_goes_with_its_results_is_named(database, own_cache, tmp_path) -> None:
    copy = Path(shutil.copytree(database, tmp_path / "Some solids"))

    def prune() -> None:
        shutil.rmtree(own_cache)
        (copy / "ring" / "2.off").unlink()

    config = Config(cache=own_cache, **OPTIONS)
    with pytest.raises(ShapevizError, match=r"^ring/2\.off cannot be used again: "):
        build_report(copy, tmp_path / "site", config, Watcher(prune))
    assert not (tmp_path / "site").exists()


def test_a_mesh_that_changes_while_it_is_used_is_not_shown_as_another(database, own_cache, tmp_path) -> None:
    copy = Path(shutil.copytree(database, tmp_path / "Some solids"))

    def change() -> None:
        for path in copy.rglob("*.off"):
            make_shape("ring", 99).export(path)

    config = Config(cache=own_cache, **WITH_SEARCH)
    with pytest.raises(
        ShapevizError, match=r"^Painting bins on \w+/\d failed: it was changed while it was used; run"
    ):
        build_report(copy, tmp_path / "site", config, Watcher(change, PAINT.doing))
    assert not (tmp_path / "site").exists()


def test_killed_at_any_moment_a_second_run_continues(database, unsearched, tmp_path) -> None:
    cache, site = tmp_path / "cache", tmp_path / "site"
    command = [sys.executable, "-m", "shapeviz_report", "build", str(database), "-o", str(site)]
    command += [
        "--cache",
        str(cache),
        "--edge-length",
        "0.06",
        "--thumbnail-size",
        "64",
        "--jobs",
        "2",
        "--search",
        "none",
    ]
    kept = 0
    for moment in ("prepared", "rendered", "described"):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 120
        while len(entries(cache, moment)) < 3 and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.005)
        assert process.poll() is None, "the build ended before it could be killed"
        process.kill()
        process.wait()
        assert not site.exists()
        assert len(entries(cache, "prepared")) >= kept
        kept = len(entries(cache, "prepared"))
    time.sleep(1)  # A worker that outlived its parent finishes its one task.
    before = entries(cache, "prepared")
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert {p: t for p, t in entries(cache, "prepared").items() if p in before} == before
    assert "15" in done.stdout
    # What three killed builds and one whole one made is what one whole build makes.
    assert read_site(site) == read_site(unsearched)


def test_termination_stops_the_workers(tmp_path) -> None:
    database = write_database(tmp_path / "solids")
    command = [
        sys.executable,
        "-m",
        "shapeviz_report",
        "build",
        str(database),
        "-o",
        str(tmp_path / "site"),
    ]
    process = subprocess.Popen([*command, "--cache", str(tmp_path / "cache")], stderr=subprocess.DEVNULL)
    while not entries(tmp_path / "cache", "prepared"):
        assert process.poll() is None
        time.sleep(0.01)
    workers = children_of(process.pid)
    assert workers
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=60) == 143
    assert not (tmp_path / "site").exists()
    assert not [worker for worker in workers if Path(f"/proc/{worker}").exists()]


def children_of(parent: int) -> list[int]:
    """Process ids of the children of a process."""
    found = []
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = status.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[1]) == parent:
            found.append(int(status.parent.name))
    return found


def test_a_check_before_a_build_changes_nothing_that_is_said(tmp_path) -> None:
    database = write_database(tmp_path / "mixed", per_class=1)
    (database / "box" / "text.obj").write_text("this is not a mesh\n")
    (database / "box" / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
    fresh, checked = tmp_path / "fresh", tmp_path / "checked"
    shapeviz_report.check(database, cache=checked)
    said = [
        shapeviz_report.build(database, tmp_path / f"site-{cache.name}", cache=cache, **OPTIONS).failures
        for cache in (fresh, checked)
    ]
    assert said[0] == said[1]
    assert {failure.stage for failure in said[0]} == {"prepare"}
    assert all(len(failure.reason) > 10 for failure in said[0])


def test_strange_files_are_reported_and_stop_nothing(tmp_path, cache) -> None:
    database = write_database(tmp_path / "mixed", per_class=2)
    odd = database / "box"
    (odd / "empty.off").write_bytes(b"")
    (odd / "text.obj").write_text("this is not a mesh\n")
    (odd / "cut.ply").write_bytes(make_shape("ball", 0).export(file_type="ply")[:200])
    (odd / "points.ply").write_bytes(trimesh.PointCloud(np.eye(3)).export(file_type="ply"))
    (odd / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
    (odd / "nan.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 nan\n2 1 0\n3 0 1 2\n")
    (odd / "huge.off").write_text("OFF\n3 1 0\n-1e308 0 0\n1e308 1e308 0\n0 -1e308 1e308\n3 0 1 2\n")
    (odd / "old.3ds").write_bytes(b"MM")
    (odd / "one triangle.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    report = shapeviz_report.build(database, tmp_path / "site", cache=cache, **OPTIONS)
    names = {Path(f.path).name for f in report.failures}
    assert names == {
        "empty.off",
        "text.obj",
        "cut.ply",
        "points.ply",
        "flat.off",
        "nan.off",
        "huge.off",
        "old.3ds",
    }
    assert all(len(f.reason) > 10 for f in report.failures)
    assert "box/one triangle" in {s.id for s in report.shapes}
    assert np.isfinite(report.features.values).all()
    listed = json.loads((tmp_path / "site/data/summary.json").read_text())["failures"]
    assert {Path(f["path"]).name for f in listed} == names


def test_nothing_usable_is_an_error_and_keeps_the_old_site(tmp_path, built) -> None:
    site = Path(shutil.copytree(built[0], tmp_path / "site"))
    broken = tmp_path / "broken"
    broken.mkdir()
    (broken / "a.off").write_text("OFF\n")
    with pytest.raises(DatabaseError, match=r"None of the files .* can be used:\n  a\.off: "):
        shapeviz_report.build(broken, site, cache=tmp_path / "cache", **OPTIONS)
    assert read_site(site) == read_site(built[0])


def test_clusters_stand_in_for_labels(built, database, cache, tmp_path) -> None:
    flat = tmp_path / "Some solids"
    flat.mkdir()
    for path in database.rglob("*.off"):
        shutil.copy(path, flat / f"{path.parent.name} {path.name}")
    site = tmp_path / "site"
    # A copy, for other tests count what the shared cache keeps.
    own = shutil.copytree(cache, tmp_path / "cache")
    report = shapeviz_report.build(flat, site, cache=own, **WITH_SEARCH)
    clusters = report.clusters
    assert clusters.stand_in
    assert report.database.labelings == ()
    assert report.labeling == "clusters"
    assert report.labels == tuple(clusters.clusters[code].name for code in clusters.of)
    # The same meshes in class folders have the same clusters, beside their classes.
    assert not built[1].clusters.stand_in
    np.testing.assert_array_equal(built[1].clusters.of, clusters.of)
    kinds = {shape.id.split(" ")[0] for shape, code in zip(report.shapes, clusters.of) if code == 0}
    assert len(kinds) == 1, "the largest cluster is of one kind"
    # All that needs labels has them.
    names = sorted(cluster.name for cluster in clusters.clusters)
    assert list(report.scores.classes) == list(report.search.classes) == names
    assert report.projections["tsne"][1].nh_s > report.projections["tsne"][1].null_mean
    assert report.bins is not None
    with open(site / "data/shapes.csv", newline="", encoding="utf-8") as file:
        assert [row["cluster"] for row in csv.DictReader(file)] == list(report.labels)
    summary = json.loads((site / "data/summary.json").read_text())
    assert (summary["labeling"], summary["unlabelled"]) == ("clusters", 0)
    assert [c["shapes"] for c in summary["clusters"]["clusters"]] == [c.size for c in clusters.clusters]
    notices = [(page.name, 'class="stand-in"' in page.read_text()) for page in site.glob("*.html")]
    assert notices
    assert all(there for _, there in notices)
    assert 'class="stand-in"' not in (built[0] / "index.html").read_text()


@pytest.mark.parametrize("count", [1, 2, 3])
def test_few_shapes_without_labels(tmp_path, cache, count) -> None:
    database = tmp_path / "few"
    database.mkdir()
    for i in range(count):
        make_shape("ball", i).export(database / f"{i}.stl")
    report = shapeviz_report.build(database, tmp_path / "site", cache=cache, **OPTIONS)
    assert len(report.shapes) == count
    assert report.labeling is None
    assert report.projections["tsne"][1].nh_s is None
    assert np.isfinite(report.projections["umap"][0].xy).all()


def test_one_class_and_names_that_are_hard_to_print(tmp_path, cache) -> None:
    database = tmp_path / 'data"base'
    label = "Tasse \U0001f375 \"a\" & 'b' <b>"
    (database / label).mkdir(parents=True)
    for i, name in enumerate(["x", "x'y\"z", "emoji \U0001f419", "&amp;"]):
        make_shape("ring", i).export(database / label / f"{name}.off")
    make_shape("ball", 1).export(database / label / "x.obj")
    report = shapeviz_report.build(database, tmp_path / "site", cache=cache, **OPTIONS)
    assert set(report.labels) == {label}
    assert len({s.id for s in report.shapes}) == 5
    assert {"x.obj", "x.off"} < {s.name for s in report.shapes}, "names tell shapes apart"
    assert report.projections["pca"][1].nh_s == 1


def test_external_features_join(tmp_path, database, cache, built) -> None:
    values = np.random.default_rng(0).normal(size=(15, 3))
    np.save(tmp_path / "depth.npy", values)
    report = shapeviz_report.build(
        database, tmp_path / "site", cache=cache, external=[tmp_path / "depth.npy"], **OPTIONS
    )
    assert [b.name for b in report.features.blocks][-1] == "depth"
    assert report.features.columns[-3:] == ("depth[0]", "depth[1]", "depth[2]")
    assert (report.features.values[:, -3:] == values).all()
    assert "depth" in report.projections["tsne"][0].features
    np.save(tmp_path / "PFH.npy", values)
    with pytest.raises(ConfigError, match="already a feature named 'PFH'"):
        shapeviz_report.build(
            database, tmp_path / "s", cache=cache, external=[tmp_path / "PFH.npy"], **OPTIONS
        )


def test_own_coordinates_are_one_more_map(tmp_path, database, cache, built) -> None:
    _, usual = built
    places = {shape.id: (3.0 * row, 100.0 - row) for row, shape in enumerate(usual.shapes)}
    lines = [f"{shape},{x},{y}\n" for shape, (x, y) in {"else": (0, 0), **places}.items()]
    (tmp_path / "shelf.csv").write_text("id,x,y\n" + "".join(lines))
    site = tmp_path / "site"
    report = shapeviz_report.build(
        database, site, cache=cache, coordinates=[tmp_path / "shelf.csv"], **OPTIONS
    )
    assert list(report.projections) == [*usual.projections, "shelf"]
    for method, (projection, _) in usual.projections.items():
        np.testing.assert_array_equal(report.projections[method][0].xy, projection.xy)
    own, hits = report.projections["shelf"]
    assert own.brought
    assert not report.projections["tsne"][0].brought
    last = len(places) - 1
    np.testing.assert_allclose(own.xy[[0, last]], [[-1, 1 / 3], [1, -1 / 3]])
    assert hits.nh_s == pytest.approx(hits.range.highest), "shapes of a class lie side by side"
    assert {"shelf"} < report.faithfulness.keys()
    assert "shelf" in report.separation.maps
    with (site / "data" / "projection-shelf.csv").open(newline="") as file:
        assert [row["id"] for row in csv.DictReader(file)] == list(places)
    told = json.loads((site / "data" / "summary.json").read_text())
    assert told["projections"]["shelf"]["features"] == []
    assert told["projections"]["shelf"]["seed"] is None
    assert told["parameters"]["coordinates"] == ["shelf.csv"]
    assert "brought along" in (site / "about.html").read_text(encoding="utf-8")


def test_every_shape_as_gltf(tmp_path, database, own_cache, built) -> None:
    usual = built[1]
    whole = shapeviz_report.build(
        database, tmp_path / "whole", cache=own_cache, gltf="prepared", gltf_values="Agd,Sc", **OPTIONS
    )
    few = shapeviz_report.build(database, tmp_path / "few", cache=own_cache, gltf="decimated", **OPTIONS)
    for report, site in ((whole, tmp_path / "whole"), (few, tmp_path / "few")):
        with (site / "data" / "shapes.csv").open(newline="") as file:
            rows = list(csv.DictReader(file))
        assert {row["gltf"] for row in rows} == {f"gltf/{path.name}" for path in (site / "gltf").iterdir()}
        for row, facts, content in zip(rows, report.facts, report.exported.contents, strict=True):
            assert (site / row["gltf"]).read_bytes() == content
            (read,) = trimesh.load_scene(site / row["gltf"], process=False).geometry.values()
            assert len(read.faces) == (min(facts.faces, 4000) if report is few else facts.faces)
            assert np.linalg.norm(read.vertices, axis=1).max() <= 1 + 1e-3
    described = shapeviz_report.describe(
        usual.shapes[0].path, cache=own_cache, edge_length=OPTIONS["edge_length"]
    )
    (read,) = trimesh.load_scene(
        io.BytesIO(whole.exported.contents[0]), file_type="glb", process=False
    ).geometry.values()
    np.testing.assert_allclose(read.vertices, described.vertices, atol=1e-6)
    np.testing.assert_array_equal(np.ravel(read.vertex_attributes["_AGD"]), described.values["Agd"][:, 0])
    assert "_SC_0" in read.vertex_attributes
    model = json.loads((tmp_path / "few" / "data" / "catalogue.jsonld").read_text())["hasPart"][0]
    assert model["encoding"]["contentUrl"] == f"../gltf/{few.exported.names[0]}"
    kept = entries(own_cache, "exported")
    again = shapeviz_report.build(database, tmp_path / "few", cache=own_cache, gltf="decimated", **OPTIONS)
    assert entries(own_cache, "exported") == kept
    assert again.exported.names == few.exported.names
    with pytest.raises(ConfigError, match="gltf_values names 'Panorama'"):
        shapeviz_report.build(database, tmp_path / "s", gltf="prepared", gltf_values="Panorama", **OPTIONS)


def test_every_class_is_scored_against_the_rest(built, database, own_cache, tmp_path) -> None:
    _, report = built
    assert report.scores.classes == ("ball", "box", "ring")
    assert report.scores.methods == tuple(scorer.name for scorer in SCORERS)
    assert report.scores.values.max(axis=2) == pytest.approx(1)
    values = compared_values(report.features, PRESETS["default"])
    scored = score_separation(SCORERS[0], values, as_one_group(report.labels, ["ring"]))
    assert report.scores.values[0, 2] == pytest.approx(scored, abs=1e-6)
    found = entries(own_cache, "scored")
    again = shapeviz_report.build(database, tmp_path / "site", cache=own_cache, **OPTIONS)
    assert entries(own_cache, "scored") == found
    shapeviz_report.build(database, tmp_path / "site", cache=own_cache, **OPTIONS, seed=71)
    assert len(entries(own_cache, "scored")) == len(found) + 3, "a task a class"
    np.testing.assert_array_equal(again.scores.values, report.scores.values)


def test_the_search_for_bins_asks_everything_once(built, database, own_cache, tmp_path) -> None:
    _, report = built
    found = report.bins
    assert [separated.label for separated in found.minimal] == ["ball", "box", "ring"]
    deals = affordable_deals(15)
    assert deals == 10
    assert sum(fold.shapes for fold in found.held_out) == 15 * deals
    assert [fold.shapes for fold in found.shuffled] == [3, 3]
    # Four of the other fourteen shapes are of the own class.
    assert found.chance == pytest.approx(4 / 14)
    space = make_bin_space(report.features, PRESETS["default"], report.labels)
    assert find_minimal_bins(space, report.labels, "ring").sets[0].bins == found.minimal[2].sets[0].bins
    stored = entries(own_cache, "selected") | entries(own_cache, "painted")
    assert len(entries(own_cache, "selected")) == 1 + 5 * deals + 2 + 3 + 1
    again = shapeviz_report.build(database, tmp_path / "site", cache=own_cache, **WITH_SEARCH)
    assert entries(own_cache, "selected") | entries(own_cache, "painted") == stored
    assert again.paintings == report.paintings
    np.testing.assert_array_equal(again.bins.automatic.path[-1].xy, found.automatic.path[-1].xy)


def test_a_painting_marks_what_falls_into_the_bin(built, cache) -> None:
    _, report = built
    found = {bin for separated in report.bins.minimal for chosen in separated.sets for bin in chosen.bins}
    assert {painting.column for painting in report.paintings} == found | set(report.bins.automatic.bins)
    marked, shares = [], []
    for painting in report.paintings:
        pixels = np.asarray(Image.open(io.BytesIO(painting.inside)).convert("RGBA"), float)
        outline = np.asarray(Image.open(io.BytesIO(painting.value)).convert("RGBA"))[..., 3]
        np.testing.assert_array_equal(outline, pixels[..., 3])
        surface = pixels[..., 3] == 255
        marked.append((pixels[..., 0] - pixels[..., 2] > 60)[surface].mean())
        shares.append(report.features.values[painting.shape, report.features.columns.index(painting.column)])
    # Half of a surface is out of sight, so that the share seen is not quite the share there is.
    assert np.corrcoef(marked, shares)[0, 1] > 0.9
    assert np.abs(np.array(marked) - shares).max() < 0.35


def test_models_are_of_their_shapes(built) -> None:
    _, report = built
    for row, model in enumerate(report.models):
        view, vertices, faces, bins = unpack(gzip.decompress(model))
        assert view @ view.T == pytest.approx(np.eye(3), abs=1e-6)
        assert len(faces) <= 4000
        assert np.linalg.norm(vertices, axis=1).max() == pytest.approx(1, abs=0.02)
        assert bins.shape == (len(report.edges), len(vertices))
        # Of its ten bins, the one with most vertices is one of the fullest of the whole surface.
        fullest = np.stack([np.bincount(row, minlength=10) for row in bins]).argmax(axis=1)
        shares = report.features.values[row, : len(report.edges) * BINS].reshape(-1, BINS)
        held = shares[np.arange(len(shares)), fullest]
        assert (held > shares.max(axis=1) - 0.2).mean() > 0.9


def test_models_may_be_left_out(built, database, own_cache, tmp_path) -> None:
    site, _ = built
    described = entries(own_cache, "described")
    report = shapeviz_report.build(database, tmp_path / "site", cache=own_cache, meshes=False, **WITH_SEARCH)
    assert report.models is None
    assert entries(own_cache, "described") == described
    whole, slim = read_site(site), read_site(tmp_path / "site")
    models = {name for name in whole if name.startswith("models/")}
    assert len(models) == 15
    assert whole.keys() - slim.keys() == models
    differing = {name for name in slim if slim[name] != whole[name]}
    assert "assets/chunk-selection.js" in differing
    # Nothing but the pages, which say so, and what they load by its content.
    assert {name for name in differing if not name.endswith(".html")} == {"assets/chunk-selection.js"}


def test_no_search_no_bins(built, database, cache, tmp_path) -> None:
    report = shapeviz_report.build(database, tmp_path / "site", cache=cache, **OPTIONS)
    assert report.bins is None
    assert report.paintings == ()
    assert json.loads((tmp_path / "site/data/summary.json").read_text())["bins"] is None
    assert list(report.models) == list(built[1].models)


def test_maps_of_chosen_bins(tmp_path, database, cache, built) -> None:
    chosen = tmp_path / "best.txt"
    chosen.write_text("# from the Workbench\nFPFH[14]:3\nAgd:6\nNd:2\n")
    report = shapeviz_report.build(database, tmp_path / "site", cache=cache, bins=chosen, **WITH_SEARCH)
    for method, (projection, _) in report.projections.items():
        assert projection.bins == ("Agd:6", "Nd:2", "FPFH[14]:3")
        assert projection.features == ("Agd", "Nd", "FPFH")
        assert not np.allclose(projection.xy, built[1].projections[method][0].xy, atol=0.01)
    # A map of one component: along it, shapes stand as in the values that are compared.
    scaled = scale_bins(report.features, PRESETS["default"], ("Agd:6", "Nd:2", "FPFH[14]:3"))
    pca = pdist(report.projections["pca"][0].xy)
    assert np.corrcoef(pca, pdist(scaled - scaled.mean(axis=0)))[0, 1] > 0.9
    np.testing.assert_array_equal(report.search.subsets.nh_s, built[1].search.subsets.nh_s)
    np.testing.assert_array_equal(report.scores.values, built[1].scores.values)
    summary = json.loads((tmp_path / "site/data/summary.json").read_text())
    assert summary["projections"]["umap"]["bins"] == ["Agd:6", "Nd:2", "FPFH[14]:3"]
    assert summary["parameters"]["bins"] == "best.txt"


def test_bins_that_are_not_there_stop_a_build_before_any_work(tmp_path, database) -> None:
    (tmp_path / "bins.txt").write_text("deep[3]\n")
    with pytest.raises(ConfigError, match=r"no such feature.*--external"):
        shapeviz_report.build(
            database, tmp_path / "site", cache=tmp_path / "cache", bins=tmp_path / "bins.txt", **OPTIONS
        )
    assert not (tmp_path / "cache").exists()


def test_the_papers_preset(tmp_path, database, cache, built) -> None:
    report = shapeviz_report.build(database, tmp_path / "site", cache=cache, preset="paper", **OPTIONS)
    assert report.features.values.reshape(15, -1, BINS).sum(axis=2) == pytest.approx(1)
    assert not np.allclose(
        report.features.values, built[1].features.values[:, : len(report.features.columns)]
    )


def test_the_papers_features_alone(tmp_path, database, cache, built) -> None:
    report = shapeviz_report.build(database, tmp_path / "site", cache=cache, preset="local", **OPTIONS)
    np.testing.assert_array_equal(
        report.features.values, built[1].features.values[:, : len(report.features.columns)]
    )
    assert {block.weight for block in report.features.blocks} == {1.0}
    weights = [block.weight for block in built[1].features.blocks]
    assert np.mean(weights) == pytest.approx(1)
    assert np.std(weights) > 0.05


def test_a_folder_that_is_not_ours_is_never_replaced(tmp_path, database) -> None:
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter.tex").write_text("years of work")
    with pytest.raises(SiteError, match="thesis"):
        shapeviz_report.build(database, tmp_path / "thesis", **OPTIONS)
    assert (tmp_path / "thesis" / "chapter.tex").read_text() == "years of work"


def test_a_plain_script_without_a_main_guard_can_build(tmp_path, database, cache, built) -> None:
    script = tmp_path / "script.py"
    script.write_text(
        f"import shapeviz_report\n"
        f"report = shapeviz_report.build({str(database)!r}, 'site', cache={str(cache)!r}, **{WITH_SEARCH!r})\n"
        f"print(len(report.shapes))\n"
    )
    done = subprocess.run(
        [sys.executable, script.name], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert done.stdout == "15\n"
    assert read_site(tmp_path / "site") == read_site(built[0])
