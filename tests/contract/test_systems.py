"""The package runs on every system: what only some have stands in ``system/``, and nowhere else is asked which this is.

Names that a system lacks are found by mypy, which `make style` runs for three of them.
"""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

import shapeviz_report

SOURCE = Path(shapeviz_report.__file__).parent
MODULES = {
    file.relative_to(SOURCE).as_posix(): file
    for file in sorted(SOURCE.rglob("*.py"))
    if file.parent.name != "system"
}

ONLY_SOME_HAVE = frozenset(
    {
        *("fcntl", "grp", "posix", "pty", "pwd", "resource", "select", "syslog", "termios", "tty"),
        *("_winapi", "msvcrt", "nt", "winreg", "winsound"),
    }
)
ASKS = frozenset({"os.name", "os.uname", "sys.platform", "platform.system", "platform.uname"})
PLACE = re.compile(r"/(proc|dev|sys|tmp|etc|var|usr)(/|$)|[A-Z]:[\\/]")


def breaches(tree: ast.AST) -> list[str]:
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names = [alias.name.partition(".")[0] for alias in node.names]
            found += [name for name in names if name in ONLY_SOME_HAVE]
        elif isinstance(node, ast.ImportFrom):
            full = [f"{node.module}.{alias.name}" for alias in node.names]
            found += [name for name in full if name in ASKS or node.module in ONLY_SOME_HAVE]
        elif isinstance(node, ast.Attribute) and ast.unparse(node) in ASKS:
            found.append(ast.unparse(node))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and PLACE.match(node.value):
            found.append(node.value)
    return found


@pytest.mark.parametrize("module", MODULES)
def test_a_module_is_of_no_system(module: str) -> None:
    assert breaches(ast.parse(MODULES[module].read_text(encoding="utf-8"))) == []


def test_a_breach_would_be_seen() -> None:
    text = """
import fcntl
from os import name
from select import poll
if sys.platform == "linux":
    open("/proc/meminfo")
"""
    assert breaches(ast.parse(text)) == ["fcntl", "os.name", "select.poll", "sys.platform", "/proc/meminfo"]


def test_both_halves_have_the_same() -> None:
    halves = []
    for half in ("posix", "windows"):
        tree = ast.parse((SOURCE / "system" / f"{half}.py").read_text(encoding="utf-8"))
        halves.append(
            {
                node.name: [argument.arg for argument in (*node.args.args, *node.args.kwonlyargs)]
                for node in tree.body
                if isinstance(node, ast.FunctionDef) and not node.name.startswith("_")
            }
        )
    # where `proc` is may be said to the one half that reads it
    assert halves[0].pop("free_memory") == ["root"]
    assert halves[1].pop("free_memory") == []
    assert halves[0] == halves[1]
