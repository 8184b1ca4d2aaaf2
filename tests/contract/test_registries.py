"""What every descriptor, projection, layout and demo class must bring along; names whatever is missing."""

from __future__ import annotations

import ast
import inspect
import pkgutil
from pathlib import Path

import pytest
from solids import lump

from shapeviz_report import database, demo, descriptors, global_descriptors, projections
from shapeviz_report.config import SEARCHES
from shapeviz_report.database import LAYOUTS
from shapeviz_report.demo import CLASSES
from shapeviz_report.descriptors import DESCRIPTORS, Descriptor, Surface
from shapeviz_report.global_descriptors import GLOBAL_DESCRIPTORS, GlobalDescriptor, PosedShape
from shapeviz_report.presets import PRESETS
from shapeviz_report.projections import PROJECTIONS
from shapeviz_report.wording import GLOBAL_WORDINGS, WORDINGS

ROOT = Path(__file__).parents[2]
METHOD = (ROOT / "docs" / "method" / "method.md").read_text(encoding="utf-8")
DATABASES = (ROOT / "docs" / "using" / "databases.md").read_text(encoding="utf-8")


def modules_of(package) -> set[str]:
    return {m.name for m in pkgutil.iter_modules(package.__path__) if not m.ispkg}


def check_texts(descriptor: Descriptor | GlobalDescriptor, shape: str) -> Path:
    """What the file of a descriptor says of it, and of the shape of its values; the file."""
    source = inspect.getmodule(descriptor.compute)
    where = Path(inspect.getfile(descriptor.compute)).relative_to(ROOT)
    head = f"{descriptor.title} ({descriptor.name})"
    assert (source.__doc__ or "").startswith(head), f"{where}: begin its docstring with {head!r}"
    text = inspect.getdoc(descriptor.compute) or ""
    for part in ("Returns", shape):
        assert part in text, f"{where}: its function's docstring needs {part!r}"
    assert descriptor.measures.endswith("."), (
        f"{where}: `measures` is a sentence, which ends with a full stop"
    )
    return where


@pytest.mark.parametrize("descriptor", DESCRIPTORS, ids=lambda d: d.name)
def test_descriptor(descriptor) -> None:
    where = check_texts(descriptor, f"(n, {descriptor.dimensions})")
    width = descriptor.compute(Surface(lump())).shape[1]
    assert width == descriptor.dimensions, f"{where}: `dimensions` is not the {width} columns it computes"
    assert descriptor.name in WORDINGS, (
        f"say in shapeviz_report/wording/, and name in its WORDINGS, what values of {descriptor.name} mean"
    )
    assert f"**{descriptor.name}**" in METHOD, (
        f"say in docs/method/method.md, in the table of descriptors, how **{descriptor.name}** is read"
    )


def test_one_file_a_descriptor() -> None:
    files = {inspect.getmodule(d.compute).__name__.rpartition(".")[2] for d in DESCRIPTORS}
    names = [d.name for d in DESCRIPTORS]
    assert len(files) == len(set(names)) == len(names), "two of DESCRIPTORS share a file or a name"
    left = modules_of(descriptors) - {"base", "registry", "surface"} - files
    assert not left, f"name {sorted(left)} in DESCRIPTORS of descriptors/__init__.py, or remove the file"


@pytest.mark.parametrize("descriptor", GLOBAL_DESCRIPTORS, ids=lambda d: d.name)
def test_global_descriptor(descriptor) -> None:
    where = check_texts(descriptor, f"({descriptor.width},)")
    values = descriptor.compute(PosedShape(lump()))
    assert values.shape == (descriptor.width,), (
        f"{where}: `width` is not the {values.size} values it computes"
    )
    assert descriptor.name in GLOBAL_WORDINGS, (
        f"say in shapeviz_report/wording/, and name in its GLOBAL_WORDINGS, what values of {descriptor.name} mean"
    )
    assert f"**{descriptor.name}**" in METHOD, (
        f"say in docs/method/method.md, in the table of global descriptors, how **{descriptor.name}** is read"
    )


def test_one_file_a_global_descriptor() -> None:
    files = {inspect.getmodule(d.compute).__name__.rpartition(".")[2] for d in GLOBAL_DESCRIPTORS}
    names = [d.name for d in (*DESCRIPTORS, *GLOBAL_DESCRIPTORS)]
    assert len(files) == len(GLOBAL_DESCRIPTORS), "two of GLOBAL_DESCRIPTORS share a file"
    assert len(set(names)) == len(names), "two descriptors share a name"
    left = modules_of(global_descriptors) - {"base", "posed_shape", "registry"} - files
    assert not left, (
        f"name {sorted(left)} in GLOBAL_DESCRIPTORS of global_descriptors/__init__.py, or remove the file"
    )


@pytest.mark.parametrize("method", PROJECTIONS, ids=lambda m: m.name)
def test_projection(method) -> None:
    where = f"projections/{method.name}.py"
    assert method.name.isidentifier(), f"{where}: `name` is part of file names and of addresses: letters only"
    assert method.explanation.endswith("."), (
        f"{where}: `explanation` is a sentence, which ends with a full stop"
    )
    assert method.title in METHOD, f"say in docs/method/method.md, under Projections, what {method.title} is"


def test_searches_are_by_the_methods_that_have_rounds() -> None:
    searched = tuple(method.name for method in PROJECTIONS if method.rounds)
    assert searched == SEARCHES[:-1], f"SEARCHES of config.py: write {(*searched, SEARCHES[-1])}"


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
    for name in sorted({m.name for m in PROJECTIONS} ^ (modules_of(projections) - {"base", "registry"})):
        pytest.fail(f"projections/{name}.py holds the Method of that name in PROJECTIONS of __init__.py")


@pytest.mark.parametrize("preset", PRESETS.values(), ids=lambda p: p.name)
def test_preset(preset) -> None:
    assert f"`{preset.name}`" in METHOD, f"say in docs/method/method.md what the preset `{preset.name}` does"


@pytest.mark.parametrize("layout", LAYOUTS, ids=lambda layout: layout.name)
def test_layout(layout) -> None:
    file = inspect.getmodule(type(layout)).__name__.rpartition(".")[2]
    assert layout.description, f"database/{file}.py: give the layout a line of description"
    assert f"`{layout.name}`" in DATABASES, f"describe `{layout.name}` in docs/using/databases.md"
    assert file in modules_of(database), (
        f"put the layout {layout.name} into a file of shapeviz_report/database"
    )


def test_demo_classes_are_sorted_and_distinct() -> None:
    names = [c.name for c in CLASSES]
    assert names == sorted(set(names)), "CLASSES of demo/classes.py: each once, sorted by name"
    assert len(names) >= 10, "the demo shows what a database of ten classes or more looks like"
    assert set(names) <= modules_of(demo), "one file a class in shapeviz_report/demo"
