"""Links that lead nowhere, and requests to elsewhere: in the documents of the repository, and in pages made of them.

`python docs/links.py SITE` looks through both.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parents[1]
DOCUMENTS = sorted([*(ROOT / "docs").rglob("*.md"), *ROOT.glob("*.md"), ROOT / "benchmarks" / "README.md"])

LOADED = {
    ("script", "src"),
    ("link", "href"),
    ("img", "src"),
    ("iframe", "src"),
    ("source", "src"),
    ("use", "href"),
}
"""Attributes of elements whose files a browser asks for by itself; it follows others when a reader does."""


def links_of(document: Path) -> list[str]:
    """The links of a Markdown document to files and places of the repository."""
    found = re.findall(r"\]\(([^)\s]+)\)", document.read_text(encoding="utf-8"))
    return [link for link in found if not re.match(r"[a-z]+:", link)]


def places_of(document: Path) -> set[str]:
    """The places of a Markdown document, as hosts of repositories name them."""
    headings = re.findall(r"^#+ (.+)$", document.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def faults_of_document(document: Path) -> Iterator[str]:
    """What is wrong with the links of a Markdown document."""
    for link in links_of(document):
        path, _, place = link.partition("#")
        target = document.parent / path if path else document
        where = f"{document.relative_to(ROOT)}: mend the link {link}"
        if not target.exists():
            yield f"{where}: there is no such file"
        elif place and place not in places_of(target):
            yield f"{where}: {target.name} has no such heading"


class _Page(HTMLParser):
    def __init__(self, file: Path) -> None:
        super().__init__()
        self.places: set[str] = set()
        self.single = False
        self.links: list[tuple[str, str, str]] = []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            self.single |= name == "data-single-file"
            if name in ("id", "name") and value:
                self.places.add(value)
            if name in ("href", "src") and value:
                self.links.append((tag, name, value))


_page = cache(_Page)


def faults_of_site(site: Path) -> Iterator[str]:
    """What is wrong with the links of a site's pages, and what of it would be asked for elsewhere.

    A place with a "=" or a "/" is the state of a page of the demo, which that page reads; a site of one file holds the
    pages that its links name.
    """
    for file in sorted(site.rglob("*.html")):
        where = file.relative_to(site)
        if where.parts[0] == "_static":  # templates of the theme
            continue
        for tag, name, link in _page(file).links:
            address = urlsplit(link)
            if address.scheme or address.netloc:
                if (tag, name) in LOADED and address.scheme != "data":
                    yield f"{where}: {link} would be asked of the network"
                continue
            if _page(file).single:
                continue
            target = file.parent / unquote(address.path) if address.path else file
            if target.is_dir():
                target /= "index.html"
            place = unquote(address.fragment)
            if not target.is_file():
                yield f"{where}: {link} leads to no file"
            elif (
                place
                and not {"=", "/"} & {*place}
                and target.suffix == ".html"
                and place not in _page(target).places
            ):
                yield f"{where}: {link} leads to no place of that page"
    for file in sorted(site.rglob("*.css")):
        for link in re.findall(
            r"(?:url\(|@import)\s*[\"']?((?:https?:)?//[^\"')]+)", file.read_text(encoding="utf-8")
        ):
            yield f"{file.relative_to(site)}: {link} would be asked of the network"


def main(site: Path) -> int:
    faults = [fault for document in DOCUMENTS for fault in faults_of_document(document)]
    faults += faults_of_site(site)
    print(*faults, sep="\n", end="\n" if faults else "")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
