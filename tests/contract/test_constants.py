"""Numbers of the method: what a module binds to a name in capitals stands under it in docs/method/method.md, and how
many dimensions and columns the features have is written nowhere.

What another number does without a name, in an expression, is not looked for.
"""

from __future__ import annotations

import ast
import importlib
import pkgutil
import re
from pathlib import Path

import numpy as np
import pytest

import shapeviz_report
from shapeviz_report import descriptors, global_descriptors
from shapeviz_report.features import BLOCKS

ROOT = Path(__file__).parents[2]
METHOD = ROOT / "docs" / "method" / "method.md"

ROW = re.compile(r"^\| `([\w.]+)` \| `(\w+)` \| ([^|`]+) \|", re.MULTILINE)


def constants() -> dict[tuple[str, str], np.ndarray]:
    """The numbers that modules of the method bind to names in capitals where they are defined, by module and name."""
    modules = [
        found.name
        for package in (descriptors, global_descriptors)
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    ]
    found = {}
    for name in (*modules, *(f"shapeviz_report.{one}" for one in ("features", "agreement", "quality"))):
        module = importlib.import_module(name)
        for statement in ast.parse(Path(str(module.__file__)).read_text(encoding="utf-8")).body:
            targets = statement.targets if isinstance(statement, ast.Assign) else []
            targets += [statement.target] if isinstance(statement, ast.AnnAssign) else []
            for target in targets:
                value = (
                    np.asarray(getattr(module, target.id)) if isinstance(target, ast.Name) else np.array("")
                )
                if value.dtype.kind in "iuf":
                    found[name.removeprefix(f"{shapeviz_report.__name__}."), target.id] = value
    return found


def stated() -> dict[tuple[str, str], list[float]]:
    """The rows of the table of constants, by module and name."""
    text = METHOD.read_text(encoding="utf-8")
    return {(m[1], m[2]): [float(number) for number in m[3].split(",")] for m in ROW.finditer(text)}


def test_sweep_finds_what_the_modules_hold() -> None:
    assert {("descriptors.surface", "NEIGHBOURS"), ("descriptors.kernels.pairs", "SMALLEST")} <= set(
        constants()
    )


def test_every_constant_is_stated_with_its_value() -> None:
    rows = stated()
    for key, value in constants().items():
        numbers = value.ravel().astype(float).tolist()
        row = f"| `{key[0]}` | `{key[1]}` | {', '.join(f'{number:g}' for number in numbers)} | what it decides |"
        assert key in rows, f"add to the table of constants in docs/method/method.md: {row}"
        assert rows[key] == pytest.approx(numbers, rel=1e-5), f"write in docs/method/method.md: {row}"


def test_every_row_is_a_constant() -> None:
    for (module, name), values in stated().items():
        held = getattr(importlib.import_module(f"{shapeviz_report.__name__}.{module}"), name, None)
        assert held is not None, f"docs/method/method.md: {module} has no {name}; remove its row"
        numbers = np.ravel(held).astype(float).tolist()
        assert values == pytest.approx(numbers, rel=1e-5), f"docs/method/method.md: {module}.{name} is {held}"


def test_how_many_features_there_are_follows_from_the_descriptors() -> None:
    dimensions, columns = sum(block.dimensions for block in BLOCKS), sum(block.width for block in BLOCKS)
    number = re.compile(rf"(?<![\w.]){dimensions}(?!\w)|(?<![\w.]){columns}(?!\w)")
    sources = [
        *(ROOT / "shapeviz_report").rglob("*.py"),
        *(ROOT / "tests").rglob("*.py"),
        *(ROOT / "site" / "scripts").rglob("*.js"),
    ]
    found = [
        f"{source.relative_to(ROOT)}:{place}: write what follows from BLOCKS or fixed_edges() instead: {line.strip()}"
        for source in sorted(sources)
        for place, line in enumerate(source.read_text(encoding="utf-8").splitlines(), start=1)
        if number.search(line)
    ]
    assert not found, "\n".join(found)
