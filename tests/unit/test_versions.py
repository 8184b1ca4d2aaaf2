from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

from shapeviz_report.versions import find_closure, library_versions, source_version

FILES = {
    "__init__": "def build(): ...",
    "work": """
        from typing import TYPE_CHECKING

        import numpy as np
        from some_stage.shapes import Box
        from . import tools

        if TYPE_CHECKING:
            from some_stage.pages import Page

        LIMIT = 3

        def helper(): return LIMIT

        def first(page: "Page") -> float:
            from some_stage.late import late
            return late(helper(), Box)

        @tools.twice
        def second(): return 2
    """,
    "shapes/__init__": "from some_stage.shapes.box import Box\nfrom some_stage.shapes.ball import Ball",
    "shapes/box": "Box = 1",
    "shapes/ball": "Ball = 2",
    "tools": "import json, scipy\ndef twice(f): return f",
    "late": "def late(*a): return 0",
    "pages": "Page = 1",
}


@pytest.fixture
def package(tmp_path) -> Path:
    for name, text in FILES.items():
        path = tmp_path / "some_stage" / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))
    return tmp_path / "some_stage"


def ask(package: Path, expression: str) -> str:
    """What Python says in a new process that can import the package."""
    script = f"from shapeviz_report.versions import *\nfrom some_stage import work\nprint({expression})"
    path = os.pathsep.join([str(package.parent), *sys.path])
    environment = os.environ | {"PYTHONPATH": path}
    return subprocess.run(
        [sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=True
    ).stdout.strip()


def test_a_function_reaches_what_it_uses(package) -> None:
    first = ask(package, "find_function_closure(work.first)")
    assert "'some_stage.late', 'some_stage.shapes.box'" in first
    assert "some_stage.shapes.Box=some_stage.shapes.box.Box" in first
    for unreached in ("ball", "pages", "tools", "some_stage',", "numpy"):
        assert unreached not in first
    second = ask(package, "find_function_closure(work.second)")
    assert "modules=('some_stage.tools',)" in second
    assert "libraries=('scipy',)" in second


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "old", "new", "first", "second"),
    [
        ("work", "LIMIT = 3", "LIMIT = 4", True, False),
        ("work", "return LIMIT", "return -LIMIT", True, False),
        ("work", "@tools.twice", "@tools.twice  # and again", False, True),
        ("work", "return 2", "return 3", False, True),
        ("work", "LIMIT = 3", "LIMIT = 3\nprint()", True, True),
        ("shapes/__init__", "shapes.box import Box", "shapes.ball import Ball as Box", True, False),
        ("shapes/__init__", "shapes.ball import Ball", "shapes.ball import Ball as Globe", False, False),
        ("shapes/box", "1", "5", True, False),
        ("shapes/ball", "2", "5", False, False),
        ("late", "0", "1", True, False),
        ("tools", "return f", "return f or f", False, True),
        ("pages", "1", "5", False, False),
    ],
)
def test_a_version_follows_what_is_reached(package, file, old, new, first, second) -> None:
    versions = "function_version(work.first), function_version(work.second)"
    before = ask(package, versions).split()
    path = package / f"{file}.py"
    assert old in path.read_text()
    path.write_text(path.read_text().replace(old, new))
    after = ask(package, versions).splitlines()[-1].split()
    assert [a != b for a, b in zip(after, before, strict=True)] == [first, second]


@pytest.mark.slow
def test_a_version_does_not_depend_on_place_or_time(package, tmp_path) -> None:
    first = ask(package, "function_version(work.first)")
    elsewhere = tmp_path / "elsewhere" / "some_stage"
    elsewhere.parent.mkdir()
    package.rename(elsewhere)
    for file in elsewhere.rglob("*.py"):
        os.utime(file, (0, 0))
    assert ask(elsewhere, "function_version(work.first)") == first


def test_libraries_count_with_what_they_require() -> None:
    names = [line.split()[0] for line in library_versions(("umap",))]
    assert {"umap-learn", "pynndescent", "numba", "llvmlite", "scikit-learn"} <= set(names)
    assert names == sorted(names)
    assert library_versions(("not_installed",)) == ()


def test_a_missing_source_is_named() -> None:
    with pytest.raises(ModuleNotFoundError, match=r"shapeviz_report\.nowhere"):
        source_version("shapeviz_report.nowhere")
    assert find_closure("shapeviz_report.errors").modules == ("shapeviz_report.errors",)
