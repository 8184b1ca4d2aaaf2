"""What every descriptor, projection, layout and demo class must bring along; names whatever is missing."""

from __future__ import annotations

import ast
import inspect
import pkgutil
from pathlib import Path

import pytest
from solids import lump

from shapeviz_report import database, demo, descriptors, projections
from shapeviz_report.config import SEARCHES
from shapeviz_report.database import LAYOUTS
from shapeviz_report.demo import CLASSES
from shapeviz_report.descriptors import DESCRIPTORS, Surface
from shapeviz_report.features import PRESETS
from shapeviz_report.projections import PROJECTIONS

ROOT = Path(__file__).parents[2]
METHOD = (ROOT / "docs" / "method" / "method.md").read_text(encoding="utf-8")
DATABASES = (ROOT / "docs" / "using" / "databases.md").read_text(encoding="utf-8")


def modules_of(package) -> set[str]:
    return {m.name for m in pkgutil.iter_modules(package.__path__) if not m.ispkg}


@pytest.mark.parametrize("descriptor", DESCRIPTORS, ids=lambda d: d.name)
def test_descriptor(descriptor) -> None:
    source = inspect.getmodule(descriptor.compute)
    assert source.__doc__.startswith(f"{descriptor.title} ({descriptor.name})")
    text = inspect.getdoc(descriptor.compute)
    assert "Returns" in text
    assert f"(n, {descriptor.dimensions})" in text
    assert descriptor.measures.endswith(".")
    assert len(set(descriptor.quantities)) == descriptor.dimensions
    assert descriptor.compute(Surface(lump())).shape[1] == descriptor.dimensions
    for words in (*descriptor.quantities, descriptor.low, descriptor.high):
        assert words
        assert not words.endswith("."), "these words stand within a sentence"
    assert f"**{descriptor.name}**" in METHOD


def test_one_file_a_descriptor() -> None:
    files = {inspect.getmodule(d.compute).__name__.rpartition(".")[2] for d in DESCRIPTORS}
    assert len(files) == len({d.name for d in DESCRIPTORS}) == len(DESCRIPTORS)
    assert files == modules_of(descriptors) - {"base", "surface"}


@pytest.mark.parametrize("method", PROJECTIONS, ids=lambda m: m.name)
def test_projection(method) -> None:
    assert method.name.isidentifier()
    assert method.explanation.endswith(".")
    assert method.title in METHOD


def test_searches_are_by_the_methods_that_have_rounds() -> None:
    searched = tuple(method.name for method in PROJECTIONS if method.rounds)
    assert searched == SEARCHES[:-1]


@pytest.mark.slow
def test_only_its_own_file_names_a_projection() -> None:
    """What uses maps asks the record; the options, which stand below all methods, are held by the test above."""
    names = {method.name for method in PROJECTIONS}
    package = Path(projections.__file__).parents[1]
    own = {package / "config.py", *(package / "projections").rglob("*.py")}
    found = [
        f"{path.relative_to(ROOT)}:{node.lineno} names {node.value}: ask PROJECTIONS or MAIN_PROJECTION"
        for path in sorted({*package.rglob("*.py")} - own)
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Constant) and node.value in names
    ]
    assert not found, "\n".join(found)


def test_one_file_a_projection() -> None:
    assert {m.name for m in PROJECTIONS} == modules_of(projections) - {"base"}


@pytest.mark.parametrize("preset", PRESETS.values(), ids=lambda p: p.name)
def test_preset(preset) -> None:
    assert f"`{preset.name}`" in METHOD


@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: layout.name)
def test_layout(layout) -> None:
    assert layout.description
    assert f"`{layout.name}`" in DATABASES
    assert inspect.getmodule(type(layout)).__name__.rpartition(".")[2] in modules_of(database)


def test_demo_classes_are_sorted_and_distinct() -> None:
    names = [c.name for c in CLASSES]
    assert names == sorted(set(names))
    assert len(names) >= 10
    assert set(names) <= modules_of(demo)
