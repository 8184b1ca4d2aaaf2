"""The example of a plug-in, installed and built with, as its guide says."""

from __future__ import annotations

import csv
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from browsers import program
from playwright.sync_api import sync_playwright
from small_database import OPTIONS, make_shape

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "plugin"

Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def packages(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("packages")
    source = shutil.copytree(EXAMPLE, folder / "source")
    install = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--no-build-isolation",
        "--no-deps",
        "--no-index",
        "--target",
    ]
    subprocess.run([sys.executable, *install, folder / "installed", source], check=True)
    return folder / "installed"


@pytest.fixture(scope="module")
def run(packages) -> Run:
    """Run Python where the example is installed."""

    def call(*arguments: object) -> subprocess.CompletedProcess[str]:
        environment = os.environ | {"PYTHONPATH": str(packages)}
        command = [sys.executable, *map(str, arguments)]
        return subprocess.run(command, capture_output=True, text=True, env=environment)

    return call


@pytest.fixture(scope="module")
def extended(run, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("prefixed")
    meshes = folder / "meshes"
    meshes.mkdir()
    for kind in ("box", "ball", "ring"):
        for index in range(4):
            make_shape(kind, index).export(meshes / f"{kind}_{index}.off")
    options = [f"--{name.replace('_', '-')}={value}" for name, value in OPTIONS.items()]
    told = run(
        "-m", "shapeviz_report", "build", meshes, "-o", folder / "site", "--cache", folder / "cache", *options
    )
    assert told.returncode == 0, told.stderr
    return folder / "site"


def test_plugins_are_listed(run) -> None:
    told = run("-m", "shapeviz_report", "plugins")
    assert told.returncode == 0, told.stderr
    rows = [line.split("  ") for line in told.stdout.splitlines()]
    assert [row[0] for row in rows] == [
        "descriptor", "global descriptor", "wording", "scorer", "projection", "layout",
    ]  # fmt: skip
    assert all("shapeviz-example 0.1.0" in line for line in told.stdout.splitlines())


def test_a_site_has_all_that_the_example_brings(extended) -> None:
    summary = json.loads((extended / "data" / "summary.json").read_text())
    assert summary["versions"]["shapeviz-example"] == "0.1.0"
    with np.load(extended / "data" / "features.npz") as arrays:
        columns, values = arrays["columns"].tolist(), arrays["values"]
    assert len(columns) == 2705 + 10 + 3
    hub = [columns.index(f"Hub:{place}") for place in range(1, 11)]
    np.testing.assert_allclose(values[:, hub].sum(axis=1), 1)
    box = values[:, [columns.index(f"Box[{place}]") for place in range(3)]]
    assert (np.diff(box, axis=1) <= 0).all()
    with np.load(extended / "data" / "scores.npz") as arrays:
        assert arrays["methods"].tolist()[-1] == "gap"
        assert arrays["scores"][-1].max() == 1
    with (extended / "data" / "projection-rings.csv").open() as file:
        assert len(list(csv.reader(file))) == 1 + 12
    with (extended / "data" / "shapes.csv").open() as file:
        assert [row["class"] for row in csv.DictReader(file)] == ["ball"] * 4 + ["box"] * 4 + ["ring"] * 4


def test_pages_explain_what_the_example_brings(extended) -> None:
    about = (extended / "about.html").read_text(encoding="utf-8")
    assert "How far a point is from the middle of the shape, on a straight line." in about
    assert "How long, broad and high the box is that the shape just fits into." in about
    assert "shapeviz-example" in about


def test_a_mesh_is_described_with_them(run, extended) -> None:
    cache = str(extended.parent / "cache")
    code = f"""
import shapeviz_report, trimesh
box = trimesh.creation.box(extents=(1, 2, 4))
found = shapeviz_report.describe(box, edge_length=0.06, cache={cache!r})
print(found.values["Hub"].max().round(6), found.features.values[0, found.features.slice_of("Box")].round(2))
"""
    told = run("-c", code)
    assert told.stdout.split("\n")[0] == "1.0 [1.   0.5  0.25]", told.stdout + told.stderr


def test_results_belong_to_a_version_of_the_plugin(run, packages) -> None:
    code = (
        "from shapeviz_report.building.stages import *\n"
        "print(*(stage.version for stage in (PREPARE, RENDER, MEASURE, DESCRIBE_WHOLE, SCORE, PROJECT)))\n"
        "print(make_key(fingerprint()))"
    )

    def versions() -> list[str]:
        return run("-c", code).stdout.split()

    before = versions()
    source = packages / "shapeviz_example.py"
    text = source.read_text()
    source.write_text(text.replace("sizes / sizes[0]", "sizes / sizes[1]"))
    changed = [first != second for first, second in zip(before, versions())]
    # all parts of the example are in one module, which is what counts
    assert changed == [False, False, True, True, True, True, True]
    source.write_text(text)
    assert versions() == before
    (info,) = packages.glob("*.dist-info")
    metadata = (info / "METADATA").read_text()
    (info / "METADATA").write_text(metadata.replace("Version: 0.1.0", "Version: 0.1.1"))
    changed = [first != second for first, second in zip(before, versions())]
    (info / "METADATA").write_text(metadata)
    assert changed == [False, False, True, True, True, True, True]
    without = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.split()
    assert [first != second for first, second in zip(before, without)] == changed


def test_a_plugin_that_is_broken_ends_a_build_with_a_sentence(run, packages, extended, tmp_path) -> None:
    source = packages / "shapeviz_example.py"
    text = source.read_text()
    source.write_text(text + "\nraise RuntimeError('no licence')\n")
    try:
        told = run("-m", "shapeviz_report", "build", extended.parent / "meshes", "-o", tmp_path / "site")
        listed = run("-m", "shapeviz_report", "plugins")
    finally:
        source.write_text(text)
    sentence = "of the package shapeviz-example 0.1.0 cannot be loaded (RuntimeError: no licence)"
    for found in (told, listed):
        assert found.returncode == 1
        assert sentence in found.stderr
        assert "Traceback" not in found.stderr
    assert "scorer" in listed.stdout


def test_the_workbench_says_what_a_scorer_of_the_build_alone_answers(extended) -> None:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=program("chromium-headless-shell"), args=["--no-sandbox"]
        )
        page = browser.new_page()
        address = (extended / "workbench.html").as_uri()
        status = page.locator("#scores-status")
        page.goto(f"{address}#scorer=gap&separate=box&separate=ring&together=")
        status.wait_for()
        assert status.inner_text().startswith(
            "Gap was computed with the site, for all features and every class"
        )
        page.locator("#scorer").select_option("anova")
        status.wait_for(state="hidden")
        page.goto("about:blank")
        page.goto(f"{address}#scorer=gap")
        page.locator("html[data-ready]").wait_for()
        assert page.locator("#scorer").input_value() == "gap"
        assert status.is_hidden()
        browser.close()
