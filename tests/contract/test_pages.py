"""Every page in ``PAGES`` keeps the contract of a page."""

import json
from functools import cache

import jinja2
import pytest
from reports import make_report, with_bin_search, with_scores, with_search

from shapeviz_report.pages import PAGES
from shapeviz_report.site.data_files import json_text
from shapeviz_report.site.resources import site_folder, templates_folder


@cache
def whole_report(classes):
    return with_bin_search(with_scores(with_search(make_report(classes, 3))))


def test_names_and_files_are_unique():
    assert len({page.name for page in PAGES}) == len(PAGES)
    assert len({page.file for page in PAGES}) == len(PAGES)
    assert PAGES[0].file == "index.html"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
class TestPage:
    def test_it_has_a_template_that_extends_the_base(self, page):
        source = (templates_folder() / f"{page.name}.html").read_text(encoding="utf-8")
        jinja2.Environment(autoescape=True).parse(source)
        assert '{% extends "base.html" %}' in source

    def test_its_script_watches_the_theme(self, page):
        source = (site_folder() / "scripts" / "pages" / f"{page.name}.js").read_text(encoding="utf-8")
        assert "watchTheme(" in source

    @pytest.mark.parametrize("classes", [("ant", "bird"), (None,), ("ant", None)])
    def test_its_chunks_are_json_or_bytes(self, page, classes):
        for chunk in page.content(whole_report(classes)).chunks.values():
            assert isinstance(chunk, bytes) or json.loads(json_text(chunk)) == chunk

    def test_its_content_is_the_same_every_time(self, page):
        report = whole_report(("ant", "bird"))
        assert page.content(report) == page.content(report)
