"""What is published: a wheel that is whole, and pins that hold."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from importlib import metadata
from pathlib import Path

import pytest
import trove_classifiers
import yaml
from packaging.metadata import Metadata
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
INSTALLED = [
    *PROJECT["dependencies"],
    *(text for extra in ("docs", "test") for text in PROJECT["optional-dependencies"][extra]),
]


def build(source: Path, target: str, destination: Path) -> Path:
    subprocess.run(
        [sys.executable, "-m", "hatchling", "build", "-t", target, "-d", str(destination)],
        cwd=source,
        check=True,
        capture_output=True,
    )
    (built,) = destination.iterdir()
    return built


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build(ROOT, "wheel", tmp_path_factory.mktemp("wheel"))


def names_in(wheel: Path) -> set[str]:
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


def files_below(folder: Path) -> set[str]:
    """Files as a user of the repository sees them: neither caches nor hidden ones."""
    files = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    return {
        file.as_posix()
        for file in files
        if "__pycache__" not in file.parts and not any(part.startswith(".") for part in file.parts)
    }


@pytest.mark.parametrize(
    ("folder", "installed"),
    [("shapeviz_report", ""), ("site", "_site/"), ("templates", "_templates/")],
)
def test_the_wheel_has_every_file_that_a_checkout_has(wheel: Path, folder: str, installed: str):
    expected = {f"shapeviz_report/{installed}{name}" for name in files_below(ROOT / folder)}
    assert expected
    assert expected - names_in(wheel) == set()


def test_the_wheel_has_nothing_else(wheel: Path):
    strange = {
        name
        for name in names_in(wheel)
        if not name.startswith(("shapeviz_report/", "shapeviz_report-")) or "__pycache__" in name
    }
    assert strange == set()


def test_the_wheel_carries_its_licence_and_its_command(wheel: Path):
    with zipfile.ZipFile(wheel) as archive:
        names = {name.partition(".dist-info/")[2]: name for name in archive.namelist()}
        assert archive.read(names["licenses/LICENSE"]) == (ROOT / "LICENSE").read_bytes()
        assert b"shapeviz-report = shapeviz_report.cli:main" in archive.read(names["entry_points.txt"])


def test_the_wheel_tells_that_it_has_types(wheel: Path):
    assert "shapeviz_report/py.typed" in names_in(wheel)


def test_the_index_takes_what_the_wheel_says_of_itself(wheel: Path):
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))
        found = Metadata.from_email(archive.read(name), validate=True)
    assert found.description_content_type == "text/markdown"
    assert found.license_expression == "MIT"
    assert set(found.classifiers or ()) <= trove_classifiers.classifiers


def test_the_citation_is_of_this_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["version"] == PROJECT["version"]
    assert citation["title"] == PROJECT["name"]
    assert citation["license"] == PROJECT["license"]
    assert citation["keywords"] == PROJECT["keywords"]


def test_the_image_has_a_python_that_the_project_takes():
    text = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    (python,) = re.findall(r"^FROM python:(3\.\d+)-", text, re.MULTILINE)
    assert f"Programming Language :: Python :: {python}" in PROJECT["classifiers"]


def test_an_unpacked_wheel_finds_its_own_files(wheel: Path, tmp_path: Path):
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)
    code = "from shapeviz_report.writing.resources import site_folder, templates_folder as t; print(site_folder(), t())"
    result = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": str(tmp_path)},
        capture_output=True,
        text=True,
    )
    package = tmp_path / "shapeviz_report"
    assert result.stdout.split() == [str(package / "_site"), str(package / "_templates")], result.stderr


def test_the_source_distribution_builds_the_same_wheel(wheel: Path, tmp_path: Path):
    sdist = build(ROOT, "sdist", tmp_path / "sdist")
    with tarfile.open(sdist) as archive:
        # Debian's Python 3.11 knows no filters yet; later ones ask for one.
        archive.extractall(
            tmp_path / "unpacked", **({"filter": "data"} if hasattr(tarfile, "data_filter") else {})
        )
    (unpacked,) = (tmp_path / "unpacked").iterdir()
    assert {"Makefile", "constraints.txt", "README.md"} <= {path.name for path in unpacked.iterdir()}
    assert names_in(build(unpacked, "wheel", tmp_path / "wheel")) == names_in(wheel)


@pytest.fixture(scope="module")
def pins() -> dict[str, str]:
    lines = (ROOT / "constraints.txt").read_text(encoding="ascii").splitlines()
    requirements = [Requirement(line) for line in lines if not line.startswith("#")]
    assert all(str(r.specifier).startswith("==") and not r.url for r in requirements), "versions only"
    return {canonicalize_name(r.name): str(r.specifier).removeprefix("==") for r in requirements}


def test_the_pins_are_versions_that_the_project_asks_for(pins: dict[str, str]):
    for text in INSTALLED:
        requirement = Requirement(text)
        assert requirement.specifier.contains(pins[canonicalize_name(requirement.name)]), text


def test_whatever_an_installation_pulls_in_is_pinned(pins: dict[str, str]):
    pulled: set[str] = set()
    waiting = [Requirement(text) for text in INSTALLED]
    while waiting:
        requirement = waiting.pop()
        name = canonicalize_name(requirement.name)
        if name not in pulled:
            pulled.add(name)
            further = [Requirement(text) for text in metadata.requires(name) or ()]
            extras = requirement.extras or {""}
            waiting += [
                r for r in further if r.marker is None or any(r.marker.evaluate({"extra": e}) for e in extras)
            ]
    assert pulled - pins.keys() == set()
    assert pins.keys() - pulled == set(), "pinned but not needed"
