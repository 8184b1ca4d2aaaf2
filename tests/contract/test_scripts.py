"""The rooms of the site's scripts: imports go one way, as those of the package do."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from shapeviz_report.pages import PAGES
from shapeviz_report.writing.assets import join_scripts
from shapeviz_report.writing.resources import site_folder

#: From the scripts that start a page down to what knows nothing of the site. Rooms of one layer do not meet.
LAYERS = (
    ("pages", "opening"),
    ("overview", "shapes", "shape", "compare", "features", "workbench", "bins", "about"),
    ("tray", "colors"),
    ("addresses",),
    ("map", "bins-kit"),
    ("database",),
    ("base",),
)

#: Any room may use these; they import nothing of the others.
APART = ("engine", "viewer")

#: Lines of a script that starts a page.
LONGEST_ENTRY = 80

_IMPORT = re.compile(r'^import \{[^}]*\} from "([^"]+)";$', re.MULTILINE)
_TYPE_IMPORT = re.compile(r'^/\*\* @import \{[^}]*\} from "([^"]+)" \*/$', re.MULTILINE)


def _scripts() -> Path:
    return (site_folder() / "scripts").resolve()


def _imports() -> list[tuple[Path, Path]]:
    """Every import that leaves its room, those of types too: who imports, and what; below the folder of scripts."""
    root = _scripts()
    pairs = [
        (path.relative_to(root), (path.parent / source).resolve().relative_to(root))
        for path in sorted(root.rglob("*.js"))
        for pattern in (_IMPORT, _TYPE_IMPORT)
        for source in pattern.findall(path.read_text(encoding="utf-8"))
    ]
    return [(one, other) for one, other in pairs if one.parts[0] != other.parts[0]]


def test_imports_go_one_way():
    layer = {room: number for number, rooms in enumerate(LAYERS) for room in rooms}
    wrong = [
        f"{one} imports {other}"
        for one, other in _imports()
        if one.parts[0] in APART
        or (other.parts[0] not in APART and layer[other.parts[0]] <= layer[one.parts[0]])
    ]
    assert wrong == [], "move what both need to a room below them"


def test_every_script_has_a_room():
    root = _scripts()
    rooms = {path.relative_to(root).parts[0] for path in root.rglob("*.js")}
    known = {*APART, *(room for rooms in LAYERS for room in rooms)}
    assert rooms == known, f"give {sorted(rooms ^ known)} a place in LAYERS of {__file__}, or remove it there"


def test_every_page_has_one_script_that_starts_it():
    entries = {path.stem for path in (_scripts() / "pages").glob("*.js")}
    for name in sorted({page.name for page in PAGES} ^ entries):
        pytest.fail(f"write site/scripts/pages/{name}.js, or name {name} in PAGES of pages/__init__.py")


def test_what_starts_a_page_only_wires():
    long = {
        path.name: lines
        for path in (_scripts() / "pages").glob("*.js")
        if (lines := len(path.read_text(encoding="utf-8").splitlines())) >= LONGEST_ENTRY
    }
    assert long == {}, (
        f"under {LONGEST_ENTRY} lines: move what a page does into a class of its room, site/scripts/PAGE/"
    )


def test_marks_are_drawn_in_one_place():
    """Where Vega does not: any other would look a little different beside it."""
    root = _scripts()
    drawing = [path for path in root.rglob("*.js") if "Path2D" in path.read_text(encoding="utf-8")]
    assert drawing == [root / "map" / "marks.js"], "lay a stamp of map/marks.js instead"


def test_no_script_is_left_over():
    root = _scripts()
    imported = {
        (path.parent / source).resolve()
        for path in root.rglob("*.js")
        for source in _IMPORT.findall(path.read_text(encoding="utf-8"))
    }
    starts = {
        *(root / "pages").glob("*.js"),
        root / "opening" / "first.js",
        root / "opening" / "single-file.js",
    }
    unused = set(root.rglob("*.js")) - imported - starts - {root / "engine" / "worker.js"}
    left = sorted(path.relative_to(root).as_posix() for path in unused)
    assert not left, f"nothing imports {left}: remove them from site/scripts"


#: Reads scripts without running them.
_PARSE = "for (const file of process.argv.slice(1)) new vm.Script(fs.readFileSync(file, 'utf8'), { filename: file })"


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_the_scripts_of_a_site_are_scripts(tmp_path):
    for name, text in join_scripts().items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    paths = sorted(tmp_path.iterdir())
    read = subprocess.run(["node", "-e", _PARSE, *paths], capture_output=True, text=True, check=False)
    assert read.stderr == ""
    assert "@param" not in "".join(path.read_text(encoding="utf-8") for path in paths if path.stem != "vega")
