"""Features without a site: those of a site, from Python and by the command."""

from __future__ import annotations

import csv
import importlib.util
import pickle
import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pandas
import pytest
import trimesh
from pyarrow import parquet
from sklearn.base import clone
from sklearn.compose import ColumnTransformer
from sklearn.exceptions import NotFittedError
from sklearn.utils import estimator_checks

import shapeviz_report
from shapeviz_report import ShapeDescriptors, ShapevizError
from shapeviz_report.demo import encode_shape
from shapeviz_report.errors import ConfigError, MeshError
from shapeviz_report.features import compute_histograms
from shapeviz_report.types import Mesh
from shapeviz_report.writing.feature_files import check_feature_file

ROOT = Path(__file__).parents[2]
COARSE = 0.06


@pytest.fixture
def files(database) -> list[Path]:
    return sorted(database.rglob("*.off"))


@pytest.fixture
def descriptors(cache) -> ShapeDescriptors:
    return ShapeDescriptors(edge_length=COARSE, jobs=1, cache=cache)


def command(*arguments: object) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "shapeviz_report", *map(str, arguments)], capture_output=True, text=True
    )


def test_a_mesh_has_what_its_site_has(built, files, cache) -> None:
    report = built[1]
    described = shapeviz_report.describe(files[0], edge_length=COARSE, cache=cache)
    np.testing.assert_array_equal(described.features.values[0], report.features.values[0])
    assert described.features.columns == report.features.columns
    assert described.facts == report.facts[0]
    assert described.features.shape_ids == (str(files[0]),)


def test_values_at_vertices_are_those_that_are_counted(files, cache) -> None:
    described = shapeviz_report.describe(files[0], edge_length=COARSE, cache=cache)
    count = len(described.vertices)
    assert described.areas.shape == (count,)
    assert {name: values.shape for name, values in described.values.items()} == {
        block.name: (count, block.dimensions) for block in described.features.blocks if block.bins > 1
    }
    mesh = Mesh(described.vertices, described.faces)
    edges = np.concatenate(list(described.edges.values()))
    own = described.features.values[0, : 10 * len(edges)]
    np.testing.assert_allclose(compute_histograms(mesh, edges, by_area=True), own)


def test_a_mesh_in_memory_is_its_file(files, cache) -> None:
    mesh = trimesh.load_mesh(files[0], process=False)
    first, second = (
        shapeviz_report.describe(given, edge_length=COARSE, cache=cache)
        for given in (mesh, (np.array(mesh.vertices), np.array(mesh.faces)))
    )
    np.testing.assert_array_equal(first.features.values, second.features.values)
    file = shapeviz_report.describe(files[0], edge_length=COARSE, cache=cache)
    np.testing.assert_allclose(first.features.values, file.features.values)


def test_a_mesh_that_cannot_be_used(tmp_path, cache) -> None:
    (tmp_path / "empty.off").touch()
    with pytest.raises(MeshError, match=r"empty\.off cannot be used: the file is empty"):
        shapeviz_report.describe(tmp_path / "empty.off", cache=cache)
    with pytest.raises(MeshError, match=r"it is no name of a file"):
        shapeviz_report.describe("a\0b.off", cache=cache)
    with pytest.raises(MeshError, match="of type int"):
        shapeviz_report.describe(3, cache=cache)


def test_a_database_has_the_features_of_its_site(built, database, cache) -> None:
    report = built[1]
    found = shapeviz_report.describe_database(database, edge_length=COARSE, jobs=1, cache=cache)
    np.testing.assert_array_equal(found.features.values, report.features.values)
    np.testing.assert_array_equal(found.edges, report.edges)
    assert found.shapes == report.shapes


def test_rows_are_those_of_a_site(built, files, descriptors) -> None:
    report = built[1]
    rows = descriptors.fit_transform(files)
    np.testing.assert_array_equal(rows, report.features.values)
    columns = list(report.features.columns)
    assert descriptors.get_feature_names_out().tolist() == columns
    assert descriptors.get_feature_names_out(["mesh"]).tolist() == columns
    with pytest.raises(ValueError, match="one column of meshes, and not 2"):
        descriptors.get_feature_names_out(["mesh", "year"])
    np.testing.assert_array_equal(descriptors.transform(files[::-3]), rows[::-3])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(descriptors)).transform(files[:1]), rows[:1])


def test_data_frames(files, descriptors) -> None:
    paths = pandas.Series(files, index=[f"{file.parent.name} {file.stem}" for file in files])
    frame = descriptors.set_output(transform="pandas").fit_transform(paths)
    assert frame.index.tolist() == paths.index.tolist()
    assert frame.columns.tolist() == descriptors.get_feature_names_out().tolist()
    columns = ColumnTransformer([("shape", clone(descriptors), ["file"]), ("year", "passthrough", ["year"])])
    table = pandas.DataFrame({"file": map(str, files), "year": 1})
    np.testing.assert_array_equal(columns.fit_transform(table)[:, :-1], frame.to_numpy())


def test_ranges_of_the_paper_are_learned(database, files, cache) -> None:
    learned = ShapeDescriptors("paper", edge_length=COARSE, jobs=1, cache=cache)
    rows = learned.fit_transform(files)
    found = shapeviz_report.describe_database(
        database, preset="paper", edge_length=COARSE, jobs=1, cache=cache
    )
    np.testing.assert_array_equal(learned.edges_, found.edges)
    np.testing.assert_array_equal(rows, found.features.values)
    np.testing.assert_array_equal(learned.transform(files[:2]), rows[:2])


def test_a_row_that_fails(tmp_path, files, descriptors) -> None:
    missing = tmp_path / "missing.off"
    with pytest.raises(MeshError, match=r"(?s)1 of 2 meshes cannot be used:.*1, .*missing\.off"):
        descriptors.fit_transform([files[0], missing])
    descriptors.set_params(on_failure="nan")
    with pytest.warns(UserWarning, match="missing") as told:
        rows = descriptors.transform([files[0], missing])
    assert told[0].filename == __file__
    assert np.isfinite(rows[0]).all()
    assert np.isnan(rows[1]).all()


def test_a_file_that_fails_is_told_once(tmp_path, database, cache) -> None:
    shutil.copytree(database, tmp_path / "shapes")
    (tmp_path / "shapes" / "box" / "9.off").touch()
    for preset in ("default", "paper"):
        found = shapeviz_report.describe_database(
            tmp_path / "shapes", preset=preset, edge_length=COARSE, jobs=1, cache=cache
        )
        assert [failure.path for failure in found.failures] == ["box/9.off"]
        assert found.features.shape_ids == tuple(shape.id for shape in found.shapes)
        assert len(found.shapes) == 15


@pytest.mark.parametrize(
    ("parameters", "meshes", "said"),
    [
        ({"preset": "none"}, [], "preset must be one of"),
        ({"on_failure": "skip"}, [], "on_failure must be 'raise' or 'nan', not 'skip'"),
        ({"edge_length": 7.0}, [], "edge_length must be from"),
        ({}, "cup.off", "several meshes"),
        ({}, trimesh.creation.box(), "several meshes"),
        ({}, np.zeros((2, 3)), "one column, their files, and not 3"),
    ],
)
def test_what_cannot_be_fitted(parameters, meshes, said) -> None:
    with pytest.raises(ConfigError, match=said):
        ShapeDescriptors(**parameters).fit(meshes)


def test_the_package_tells_all_its_names() -> None:
    assert set(shapeviz_report.__all__) <= set(dir(shapeviz_report))


def test_unfitted() -> None:
    with pytest.raises(NotFittedError):
        ShapeDescriptors().transform([])


@pytest.mark.parametrize(
    "check",
    [
        # the others hand over arrays of numbers, which are no meshes
        "check_estimator_cloneable",
        "check_estimator_repr",
        "check_estimator_tags_renamed",
        "check_get_params_invariance",
        "check_do_not_raise_errors_in_init_or_set_params",
        "check_mixin_order",
        "check_no_attributes_set_in_init",
        "check_parameters_default_constructible",
        "check_set_params",
        "check_valid_tag_types",
    ],
)
def test_conventions_of_scikit_learn(check) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        getattr(estimator_checks, check)("ShapeDescriptors", ShapeDescriptors())


def test_files_of_features(built, database, cache, tmp_path) -> None:
    report = built[1]
    options = ("--edge-length", COARSE, "--jobs", 1, "--cache", cache)
    for suffix in ("csv", "npz", "parquet"):
        told = command("describe", database, "-o", tmp_path / f"features.{suffix}", *options)
        assert told.returncode == 0, told.stderr
        assert told.stdout.endswith(f"features.{suffix}: 15 shapes, 2,705 feature values each\n")
        check_feature_file(tmp_path / f"features.{suffix}")  # which may be replaced by another
    columns, classes = list(report.features.columns), [str(label) for label in report.labels]
    with (tmp_path / "features.csv").open(newline="") as file:
        head, *rows = csv.reader(file)
    assert head == ["id", "class", "label:class", *columns]
    assert [row[:2] for row in rows] == [[s.id, label] for s, label in zip(report.shapes, classes)]
    np.testing.assert_array_equal(np.array([row[3:] for row in rows], float), report.features.values)
    with np.load(tmp_path / "features.npz") as arrays:
        np.testing.assert_array_equal(arrays["values"], report.features.values)
        assert arrays["classes"].tolist() == classes
        assert arrays["shape_ids"].tolist() == [shape.id for shape in report.shapes]
    table = parquet.read_table(tmp_path / "features.parquet")
    assert table.column_names == head
    assert table["class"].to_pylist() == classes
    np.testing.assert_array_equal(
        np.stack([table[name].to_numpy() for name in columns], axis=1), report.features.values
    )


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("features.xlsx", "must end in .parquet, .csv or .npz"),
        ("folder.csv", "is a folder"),
        (f"{'n' * 300}.csv", "File name too long"),
        ("/proc/features.csv", "choose another place"),
    ],
)
def test_files_that_cannot_be_written(database, tmp_path, name, said) -> None:
    (tmp_path / "folder.csv").mkdir()
    told = command("describe", database, "-o", tmp_path / name)
    assert (told.returncode, told.stdout) == (1, "")
    assert said in told.stderr
    assert "Measuring" not in told.stderr, "it is known before anything is computed"


@pytest.mark.parametrize("suffix", [".csv", ".npz", ".parquet"])
def test_a_file_of_another_kind_is_not_replaced(built, database, tmp_path, suffix) -> None:
    """As the table of the database, features of a network, or what a site offers."""
    path = tmp_path / f"shapes{suffix}"
    pandas.DataFrame({"id": ["cup"], "label": ["cup"]}).to_parquet(tmp_path / "shapes.parquet")
    np.savez(tmp_path / "shapes.npz", values=np.zeros((1, 3)), shape_ids=np.array(["cup"]))
    (tmp_path / "shapes.csv").write_text("file,label\ncup.off,cup\n")
    for content in (path.read_bytes(), b"\xff\0PK of no kind"):
        path.write_bytes(content)
        told = command("describe", database, "-o", path)
        assert f"{path} is not what `describe` writes" in told.stderr
        assert path.read_bytes() == content
    with pytest.raises(ConfigError, match="would be replaced"):
        check_feature_file(built[0] / "data" / "features.npz")
    path.write_bytes(b"")
    check_feature_file(path)


def test_without_pyarrow_parquet_is_refused_before_anything_is_computed(
    database, tmp_path, monkeypatch
) -> None:
    from shapeviz_report.writing import feature_files

    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(
        ShapevizError, match=r"pip install 'shapeviz-report\[parquet\]'; \.csv and \.npz need"
    ):
        feature_files.check_feature_file(tmp_path / "features.parquet")


def test_the_examples_of_the_guide(tmp_path, cache, monkeypatch) -> None:
    guide = (ROOT / "docs" / "using" / "python.md").read_text(encoding="utf-8")
    for kind in ("chair", "cup"):
        (tmp_path / "meshes" / kind).mkdir(parents=True)
        for index in range(2):
            (tmp_path / "meshes" / kind / f"{index:02}.off").write_bytes(encode_shape(kind, index, 0))
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SHAPEVIZ_CACHE", str(cache))
    names: dict[str, object] = {}
    for block in re.findall(r"```python\n(.*?)```", guide, re.DOTALL):
        exec(compile(block, "docs/using/python.md", "exec"), names)
    assert names["chair"].features.values.shape == names["table"][:1].shape
    assert names["frame"].index.tolist() == ["00", "01"] * 2
    assert (tmp_path / "site" / "index.html").is_file()
    for line in re.findall(r"```sh\nshapeviz-report (.*?)\n```", guide):
        told = command(*line.split())
        assert told.returncode == 0, told.stderr
    assert (tmp_path / "features.parquet").is_file()


def test_a_notebook_shows_the_site(built) -> None:
    report = built[1]
    assert repr(report) == "<Report of 'Some solids': 15 shapes, 3 classes>"
    shown = report._repr_html_()
    assert shown.startswith('<iframe title="Some solids" sandbox="allow-scripts allow-downloads"')
    assert shown.count('"') == 8  # nothing of the site ends the frame
    assert len(shown) < 5_000_000


def test_a_large_site_stays_where_it_is(built, monkeypatch) -> None:
    from shapeviz_report.writing import notebook

    monkeypatch.setattr(notebook, "MOST_SHOWN", 1000)
    shown = built[1]._repr_html_()
    assert re.search(r"15 shapes, 3 classes&gt; Its site would add \d+ MB to this notebook", shown)
    assert len(shown) < 500
