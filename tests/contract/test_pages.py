"""Every page in ``PAGES`` keeps the contract of a page."""

import csv
import json
from collections.abc import Mapping
from dataclasses import replace
from functools import cache

import jinja2
import pytest
from packed_chunks import packed
from reports import make_report, with_bin_search, with_scores, with_search

from shapeviz_report.pages import PAGES
from shapeviz_report.writing import write_site
from shapeviz_report.writing.packing import pack
from shapeviz_report.writing.resources import site_folder, templates_folder


@cache
def whole_report(classes, per_class=3):
    return with_bin_search(with_scores(with_search(make_report(classes, per_class))))


def test_names_and_files_are_unique():
    assert len({page.name for page in PAGES}) == len(PAGES), "two of PAGES in pages/__init__.py share a name"
    assert len({page.file for page in PAGES}) == len(PAGES), "two of PAGES in pages/__init__.py share a file"
    assert PAGES[0].file == "index.html", "the first of PAGES is where a site opens"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
class TestPage:
    def test_it_has_a_template_that_extends_the_base(self, page):
        path = templates_folder() / f"{page.name}.html"
        assert path.is_file(), f"write templates/{path.name}"
        source = path.read_text(encoding="utf-8")
        jinja2.Environment(autoescape=True).parse(source)
        assert '{% extends "base.html" %}' in source, f"begin templates/{path.name} so"

    def test_its_script_watches_the_theme(self, page):
        path = site_folder() / "scripts" / "pages" / f"{page.name}.js"
        assert path.is_file(), f"write site/scripts/pages/{path.name}"
        source = path.read_text(encoding="utf-8")
        # A page that is opened as all are follows the theme from when it is ready.
        opened = ("openPage(" in source and " ready(" in source) or "watchTheme(" in source
        assert opened, f"site/scripts/pages/{path.name}: open it by openPage({{ ..., ready() }})"

    @pytest.mark.slow
    def test_its_content_is_the_same_every_time(self, page):
        report = whole_report(("ant", "bird"))
        one, other = page.content(report), page.content(report)
        assert one.context == other.context
        assert packed(one.chunks) == packed(other.chunks)
        for name, parts in one.parts.items():
            assert [pack(part) for part in parts] == [pack(part) for part in other.parts[name]]


@cache
def numbered_report():
    """Classes and shapes with numbers for names, of which text would sort 10 before 2."""
    report = whole_report(("1", "2", "10"), 12)
    shapes = tuple(
        replace(
            shape,
            id=f"{label}/chair_{place % 12 + 1}",
            name=f"chair_{place % 12 + 1}",
            metadata={"lot": str(place % 12 + 1)},
        )
        for place, (shape, label) in enumerate(zip(report.shapes, report.labels))
    )
    features = replace(report.features, shape_ids=tuple(shape.id for shape in shapes))
    return replace(report, shapes=shapes, features=features, database=replace(report.database, shapes=shapes))


def names_within(content):
    """Every list of texts, or of the names of things, in what a page shows; with the keys of mappings."""
    if isinstance(content, Mapping):
        yield [key for key in content if isinstance(key, str)]
        for value in content.values():
            yield from names_within(value)
    elif isinstance(content, list | tuple):
        yield [
            str(item.get("name", item.get("label"))) if isinstance(item, Mapping) else item
            for item in content
        ]
        for item in content:
            yield from names_within(item)


NUMBERED = ["1", "2", "10"]


class TestNumbersInNames:
    @pytest.mark.slow
    @pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
    def test_what_a_page_lists_by_name_stands_as_people_count(self, page):
        content = page.content(numbered_report())
        lots = [str(number) for number in range(1, 13)]
        told = {**content.chunks, **content.context}
        # The hardest class first.
        told.pop("separation", None)
        for names in names_within(told):
            for known in (NUMBERED, lots):
                if all(isinstance(name, str) for name in names) and sorted(names) == sorted(known):
                    assert names == known

    @pytest.mark.slow
    def test_classes_are_numbered_alike_everywhere(self, tmp_path):
        report = numbered_report()
        write_site(report, tmp_path)
        fields = next(page for page in PAGES if page.name == "shapes").content(report).chunks["fields"]
        assert [report.shapes[row].name for row in fields["byName"][::3]] == [
            f"chair_{i}" for i in range(1, 13)
        ]
        assert fields["fields"][0]["names"] == NUMBERED
        assert list(report.scores.classes) == NUMBERED
        assert json.loads((tmp_path / "data/summary.json").read_text())["classes"] == 3
        with (tmp_path / "data/shapes.csv").open(encoding="utf-8", newline="") as file:
            assert [row["id"] for row in csv.DictReader(file)] == [
                f"{label}/chair_{i}" for label in NUMBERED for i in range(1, 13)
            ]
