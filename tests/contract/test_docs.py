"""The documents stand in the navigation, and their links lead somewhere."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from links import DOCUMENTS, faults_of_document, faults_of_site, links_of  # noqa: E402

INDEXES = [path for path in DOCUMENTS if "{toctree}" in path.read_text(encoding="utf-8")]


def named(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def navigation_of(index: Path) -> list[Path]:
    """The documents that Sphinx puts below one in the navigation."""
    (names,) = re.findall(
        r"^```\{toctree\}\n(?::.*\n)*\n(.*?)```", index.read_text("utf-8"), re.MULTILINE | re.DOTALL
    )
    documents = (re.sub(r".* <(.*)>", r"\1", line) for line in names.splitlines())
    return [(index.parent / f"{name}.md").resolve() for name in documents]


@pytest.mark.parametrize("document", DOCUMENTS, ids=named)
def test_links_lead_somewhere(document) -> None:
    assert list(faults_of_document(document)) == []


def test_the_navigation_has_all() -> None:
    index = ROOT / "docs" / "index.md"
    found = [index, *(document for index in INDEXES for document in navigation_of(index))]
    assert sorted(found) == sorted((ROOT / "docs").rglob("*.md")), "each document once, in an index of docs/"


@pytest.mark.parametrize("index", INDEXES, ids=named)
def test_an_index_says_what_each_of_its_documents_is(index) -> None:
    rows = "\n".join(line for line in index.read_text("utf-8").splitlines() if line.startswith("| "))
    told = [(index.parent / link).resolve() for link in re.findall(r"\]\(([^)\s]+)\)", rows)]
    assert told == navigation_of(index)


def test_documents_that_are_spoken_of_are_there() -> None:
    sources = [
        *(
            path
            for folder in ("shapeviz_report", "tests", "benchmarks")
            for path in (ROOT / folder).rglob("*.py")
        ),
        *(ROOT / "site" / "scripts").rglob("*.js"),
    ]
    for source in sources:
        for name in re.findall(r"docs/[\w/-]+\.(?:md|yml)", source.read_text(encoding="utf-8")):
            assert (ROOT / name).exists(), f"{source.relative_to(ROOT)} speaks of {name}, which is not there"


@pytest.mark.parametrize(
    ("page", "said"),
    [
        ('<a href="other.html#there">', None),
        ('<a href="other.html#view=three">', None),
        ('<a href="https://example.org/">', None),
        ('<a href="folder">', None),
        ('<img src="data:image/gif;base64,R0lGODlhAQABAAAAACw=">', None),
        ('<a href="gone.html">', "gone.html leads to no file"),
        ('<a href="other.html#gone">', "other.html#gone leads to no place of that page"),
        ('<a href="#gone">', "#gone leads to no place of that page"),
        ('<img src="gone.png">', "gone.png leads to no file"),
        (
            '<script src="https://example.org/x.js"></script>',
            "https://example.org/x.js would be asked of the network",
        ),
        ('<link href="//example.org/x.css">', "//example.org/x.css would be asked of the network"),
        ('<html data-single-file><a href="inside.html">', None),
        (
            '<html data-single-file><script src="http://example.org/x.js">',
            "http://example.org/x.js would be asked of the network",
        ),
    ],
)
def test_faults_of_pages_are_found(page, said, tmp_path) -> None:
    (tmp_path / "index.html").write_text(page)
    (tmp_path / "other.html").write_text('<p id="there">')
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "index.html").write_text("")
    assert list(faults_of_site(tmp_path)) == ([] if said is None else [f"index.html: {said}"])


@pytest.mark.parametrize(
    "rule", ["@import 'https://example.org/x.css'", "a { background: url(//example.org/x.png) }"]
)
def test_styles_ask_for_nothing_elsewhere(rule, tmp_path) -> None:
    (tmp_path / "page.css").write_text(rule)
    (fault,) = faults_of_site(tmp_path)
    assert fault.startswith("page.css: ")
    assert fault.endswith(" would be asked of the network")


def test_links_of_a_document_are_those_to_files() -> None:
    links = links_of(ROOT / "CONTRIBUTING.md")
    assert "README.md#how-it-works" in links
