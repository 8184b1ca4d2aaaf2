"""The documents stand in their index, and their links lead somewhere."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCUMENTS = sorted(
    [*(ROOT / "docs").rglob("*.md"), *ROOT.glob("*.md"), ROOT / "benchmarks" / "README.md"],
    key=lambda path: path.relative_to(ROOT).as_posix(),
)


def _links(document: Path) -> list[str]:
    found = re.findall(r"\]\(([^)\s]+)\)", document.read_text(encoding="utf-8"))
    return [link for link in found if not re.match(r"[a-z]+:", link)]


def _anchors(document: Path) -> set[str]:
    """The places of a document as renderers of Markdown name them."""
    headings = re.findall(r"^#+ (.+)$", document.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_links_lead_somewhere(document) -> None:
    for link in _links(document):
        path, _, place = link.partition("#")
        target = document.parent / path if path else document
        where = f"{document.relative_to(ROOT)}: mend the link {link}"
        assert target.exists(), f"{where}: there is no such file"
        assert not place or place in _anchors(target), f"{where}: {target.name} has no such heading"


def test_the_index_has_all() -> None:
    index = ROOT / "docs" / "README.md"
    listed = {(index.parent / link).resolve() for link in _links(index)}
    there = {path for path in (ROOT / "docs").rglob("*.md") if path != index}
    for path in sorted(there - listed):
        pytest.fail(f"give {path.relative_to(ROOT)} a place in docs/README.md")
    assert listed == there, "docs/README.md lists what is no document of docs/"


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
