"""The data of a site is of the types that ``pages/chunks.py`` gives it, on both ends."""

from __future__ import annotations

from functools import cache
from typing import get_type_hints

import pytest
from chunk_types import DECLARATIONS, misfits, typescript
from packed_chunks import read_script, unpack
from reports import (
    make_report,
    with_best,
    with_bin_search,
    with_clusters,
    with_copies,
    with_exported,
    with_external,
    with_models,
    with_own_map,
    with_paintings,
    with_retrieval,
    with_scores,
    with_search,
)

from shapeviz_report.pages import PAGES, base
from shapeviz_report.pages.chunks import Chunks, Parts
from shapeviz_report.writing import write_site
from shapeviz_report.writing.packing import pack

TYPES = get_type_hints(Chunks)
PARTS = get_type_hints(Parts)

#: What only sites of very many shapes have.
OF_LARGE = {"levels", "rows", "columns", "components", "classes"}

MEND = "give it its type in pages/chunks.py, and run `make chunks`"


@cache
def everything():
    """A report with all that one may hold."""
    report = with_clusters(
        with_copies(with_external(with_own_map(make_report(("ant", "bird", None)))), [(0, 1)])
    )
    report = with_bin_search(with_retrieval(with_scores(with_best(with_search(report)))))
    return with_exported(with_models(with_paintings(report)))


@cache
def plain(*classes):
    return make_report(classes, 3)


def test_the_browser_s_types_are_made_of_these():
    assert DECLARATIONS.read_text(encoding="utf-8") == typescript(), "run `make chunks`"


@pytest.mark.slow
@pytest.mark.parametrize("large", [False, True])
def test_a_site_holds_every_chunk_and_each_is_of_its_type(large, tmp_path, monkeypatch):
    if large:
        monkeypatch.setattr(base, "MOST_IN_FULL", 10)
    of_large = set() if large else OF_LARGE
    write_site(everything(), tmp_path)
    held = dict(read_script(path) for path in (tmp_path / "assets").glob("chunk-*.js"))
    parts = dict(read_script(path) for path in (tmp_path / "chunks").glob("*.js"))
    assert {name.partition("-")[0] for name in parts} == PARTS.keys() - of_large
    assert held.keys() == TYPES.keys() - of_large, (
        "name every chunk in Chunks of pages/chunks.py, and run `make chunks`"
    )
    wrong = [where for name, value in held.items() for where in misfits(value, TYPES[name], name)]
    wrong += [
        where
        for name, value in parts.items()
        for where in misfits(value, PARTS[name.partition("-")[0]], name)
    ]
    assert wrong == [], MEND


@pytest.mark.parametrize("classes", [("ant", "bird"), (None,), ("ant", None)])
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_what_is_missing_from_a_report_is_missing_by_type(page, classes):
    for name, chunk in page.content(plain(*classes)).chunks.items():
        assert list(misfits(unpack(*pack(chunk)), TYPES[name], name)) == [], MEND


@pytest.mark.parametrize(
    ("change", "found"),
    [
        (lambda held: held["shapes"].pop("ids"), "overview.shapes.ids is missing"),
        (lambda held: held.update(title="Ants"), "overview.title is not declared"),
        (lambda held: held["shapes"].update(groups=[0]), "overview.shapes.groups is no array of int32"),
        (lambda held: held["classes"].append(None), "is None, no str"),
        (lambda held: held["marks"]["themes"].update(blue=None), "overview.marks.themes 'blue' is 'blue'"),
        (lambda held: held["methods"][0].update(hitOfAll="0.5"), "overview.methods[0].hitOfAll is '0.5'"),
    ],
)
def test_what_does_not_fit_is_found(change, found):
    held = unpack(*pack(PAGES[0].content(plain("ant", "bird")).chunks["overview"]))
    change(held)
    assert any(found in where for where in misfits(held, TYPES["overview"], "overview"))
