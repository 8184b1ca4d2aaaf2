"""The style sheets: nothing in them that no page has."""

from __future__ import annotations

import re

import pytest

from shapeviz_report.pages import PAGES
from shapeviz_report.writing.assets import STYLES
from shapeviz_report.writing.resources import site_folder, templates_folder

SHEETS = {path.name: path for path in (site_folder() / "styles").glob("*.css")}


def _words() -> set[str]:
    """Everything that a page may give an element as its class or id."""
    sources = [*templates_folder().glob("*.html"), *(site_folder() / "scripts").rglob("*.js")]
    text = "".join(path.read_text(encoding="utf-8") for path in sources)
    return {*re.findall(r"[\w-]+", text), *(f"page-{page.name}" for page in PAGES)}


def test_all_sheets_are_joined() -> None:
    assert sorted(STYLES) == sorted(SHEETS)


@pytest.mark.parametrize("name", STYLES)
def test_every_class_and_id_is_on_some_page(name) -> None:
    text = re.sub(r"/\*.*?\*/", "", SHEETS[name].read_text(encoding="utf-8"), flags=re.DOTALL)
    selectors = re.sub(r"\{[^{}]*\}", "{}", text)
    assert set(re.findall(r"[.#]([A-Za-z][\w-]*)", selectors)) - _words() == set()


def test_one_palette() -> None:
    """Dark colours stand beside light ones: a second list would fall behind."""
    for name, path in SHEETS.items():
        assert "prefers-color-scheme" not in path.read_text(encoding="utf-8"), name
