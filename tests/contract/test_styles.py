"""The style sheets: in layers by folder, nothing in a sheet that its pages do not have, and breakpoints by name."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from shapeviz_report.pages import PAGES
from shapeviz_report.writing.assets import style_sheets
from shapeviz_report.writing.resources import site_folder, templates_folder

SHEETS = {sheet.relative_to(site_folder() / "styles").as_posix(): sheet for _, sheet in style_sheets()}
PAGE_NAMES = [page.name for page in PAGES]

_IMPORT = re.compile(r'^import \{[^}]*\} from "([^"]+)";$', re.MULTILINE)
_OTHER_TEMPLATE = re.compile(r'{%-? *(?:extends|include|import|from) *"([^"]+)"')
_LITERAL = re.compile(r'"(?:[^"\\\n]|\\.)*"|`[^`]*`')
_WORD = re.compile(r"[A-Za-z][\w-]*")
_LENGTH = re.compile(r"\([^()]*\b(?:width|height)\b[^()]*\)")
_SPELLING = re.compile(r"\((width|height) (?:<|>=) (\d+px)\)")


def _text(sheet: str) -> str:
    """A sheet without its comments."""
    return re.sub(r"/\*.*?\*/", "", SHEETS[sheet].read_text(encoding="utf-8"), flags=re.DOTALL)


def _names(sheet: str) -> set[str]:
    """The classes and ids in the selectors of a sheet."""
    selectors = re.sub(r"\{[^{}]*\}", "{}", _text(sheet))
    return set(re.findall(r"[.#]([A-Za-z][\w-]*)", selectors))


def _reached(start: Path, others: re.Pattern[str], folder: Path | None = None) -> list[str]:
    """The texts of a file and of all that it names in turn, which lie beside it or in ``folder``."""
    found: dict[Path, str] = {}
    waiting = [start]
    while waiting:
        path = waiting.pop().resolve()
        if path not in found:
            found[path] = path.read_text(encoding="utf-8")
            waiting += [(folder or path.parent) / other for other in others.findall(found[path])]
    return list(found.values())


@cache
def _words(page: str) -> frozenset[str]:
    """What a page may give an element as its class or id: words of its templates, and of texts in its scripts."""
    scripts = site_folder() / "scripts"
    modules = [
        *_reached(scripts / "pages" / f"{page}.js", _IMPORT),
        *_reached(scripts / "opening" / "first.js", _IMPORT),
    ]
    literals = [literal for module in modules for literal in _LITERAL.findall(_IMPORT.sub("", module))]
    templates = _reached(templates_folder() / f"{page}.html", _OTHER_TEMPLATE, templates_folder())
    return frozenset({f"page-{page}", *_WORD.findall("\n".join(templates + literals))})


def test_all_sheets_are_joined() -> None:
    styles = site_folder() / "styles"
    there = {path.relative_to(styles).as_posix() for path in styles.rglob("*.css")}
    assert set(SHEETS) == there, "give every sheet of site/styles its place in writing/assets.py"


def test_every_page_has_a_sheet_of_its_name() -> None:
    own = {Path(sheet).stem for sheet in SHEETS if sheet.startswith("pages/")}
    for name in sorted(own ^ set(PAGE_NAMES)):
        pytest.fail(
            f"site/styles/pages/{name}.css is the sheet of the page {name} of PAGES: write, or remove it"
        )


@pytest.mark.parametrize("page", PAGE_NAMES)
def test_a_page_has_every_class_and_id_of_its_sheet(page) -> None:
    strange = _names(f"pages/{page}.css") - _words(page)
    assert strange == set(), (
        "what several pages have belongs to a sheet in styles/components/; what none has, nowhere"
    )


@pytest.mark.parametrize("sheet", [sheet for sheet in SHEETS if not sheet.startswith("pages/")])
def test_every_class_and_id_is_on_some_page(sheet) -> None:
    strange = _names(sheet) - frozenset().union(*map(_words, PAGE_NAMES))
    assert strange == set(), f"no page has it: remove it from site/styles/{sheet}"


@pytest.mark.parametrize("sheet", [sheet for sheet in SHEETS if sheet.startswith("components/")])
def test_a_component_is_on_several_pages(sheet) -> None:
    pages = [page for page in PAGE_NAMES if _names(sheet) & _words(page)]
    assert len(pages) > 1, f"it is of one page: move it to styles/pages/{pages[0]}.css"


def test_breakpoints_have_names() -> None:
    """Those that ``tokens.css`` lists, in one spelling."""
    listed = set(
        re.findall(
            r"^ \* +(width|height) +(\d+px) +\w", SHEETS["tokens.css"].read_text("utf-8"), re.MULTILINE
        )
    )
    asked = {
        (sheet, feature)
        for sheet in SHEETS
        for query in re.findall(r"@media ([^{]+)", _text(sheet))
        for feature in _LENGTH.findall(query)
    }
    strange = {
        (sheet, feature)
        for sheet, feature in asked
        if (spelling := _SPELLING.fullmatch(feature)) is None or spelling.groups() not in listed
    }
    assert strange == set(), (
        "write (width < ...) or (width >= ...) with a breakpoint that styles/tokens.css lists"
    )
    used = {_SPELLING.fullmatch(feature).groups() for _, feature in asked - strange}
    assert listed - used == set(), "no sheet uses it: take it out of the list in styles/tokens.css"


def test_one_palette() -> None:
    """Dark colours stand beside light ones: a second list would fall behind."""
    for sheet in SHEETS:
        assert "prefers-color-scheme" not in _text(sheet), (
            f"site/styles/{sheet}: write light-dark(...) instead"
        )
