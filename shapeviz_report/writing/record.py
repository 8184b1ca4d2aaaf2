"""Which files of a folder the site wrote: what a rebuild may remove, and nothing else.

A site keeps a record of its files with their hashes. A file is the site's own while its content is what was recorded;
whatever else lies in the folder, a file of the site that somebody has edited too, belongs to the publisher. A site in
one file has its hash at its end.
"""

from __future__ import annotations

import json
import os
import re
import stat
from collections.abc import Iterator, Mapping
from hashlib import file_digest, sha256
from pathlib import Path
from typing import Any

from shapeviz_report.pages import PAGES
from shapeviz_report.writing.data import DATA_NAMES, GENERATOR

RECORD = "data/files.json"
"""Where a site keeps the record."""

SUMMARY = "data/summary.json"
"""What tells a site that has no record."""

FOLDERS = ("assets", "chunks", "data", "gltf", "models", "paintings", "sheets", "thumbnails")
"""The folders of a site; none has folders in it."""

PAGE_MARK = f'<meta name="generator" content="{GENERATOR} '.encode()
"""Tells a page that this package wrote from any other; it stands among its first bytes."""

PAGE_MARK_WITHIN = 8192

_PAGES = "|".join(re.escape(page.file) for page in PAGES)
_SCRIPTS = "|".join(re.escape(page.name) for page in PAGES)
_NAME = re.compile(
    rf"{_PAGES}|preview\.png|ro-crate-metadata\.json|assets/(first|shared|vega|{_SCRIPTS}|chunk-[\w-]+)\.js"
    r"|assets/(style\.css|icon\.svg|vega-licenses\.txt|logo\.(svg|png|webp))"
    rf"|data/({DATA_NAMES}|files\.json|catalogue\.jsonld|croissant\.json)"
    r"|chunks/[a-z]+-\d+\.js"
    r"|gltf/[0-9a-f]{20}\.glb|models/[0-9a-f]{20}\.js|(paintings|sheets|thumbnails)/[0-9a-f]{20}\.webp"
)

_SEAL = b"<!-- shapeviz-report sha256 "

_KEPT = re.compile(
    r"\..+|CNAME|_config\.yml|_headers|_redirects|404\.html|(ads|humans|robots|security)\.txt|sitemap\.(txt|xml)"
    r"|favicon\.(ico|png|svg)|(LICEN[CS]E|COPYING|README)(\.\w+)?|google[0-9a-f]+\.html|BingSiteAuth\.xml"
)


def is_kept_beside(name: str) -> bool:
    """Whether publishers keep an entry of this name in the folder of any site, before there is one."""
    return _KEPT.fullmatch(name) is not None


def may_be_written(name: str) -> bool:
    """Whether a site may have a file of this name (its path in the folder, ``/`` between)."""
    return _NAME.fullmatch(name) is not None


def record_text(hashes: Mapping[str, str]) -> bytes:
    """The record of files by name, as a file."""
    return (
        json.dumps({"generator": GENERATOR, "sha256": dict(sorted(hashes.items()))}, indent=0) + "\n"
    ).encode()


def list_entries(folder: Path) -> Iterator[str]:
    """The names of everything in a site's folder and, one level down, in the folders that a site has.

    Links are not followed: a link is an entry, and so is a folder that no site has.
    """
    for entry in sorted(os.listdir(folder)):
        if entry in FOLDERS and stat.S_ISDIR(os.lstat(folder / entry).st_mode):
            yield from (f"{entry}/{inner}" for inner in sorted(os.listdir(folder / entry)))
        else:
            yield entry


def find_own(folder: Path) -> frozenset[str]:
    """The names of the files that a site wrote into a folder and nobody has changed since.

    A site without a record (an earlier version wrote none) is told by its summary. Of its files those are its own that
    have a name that only a site gives, and of pages those that say who made them.
    """
    recorded = _read_record(folder)
    if recorded is None and _read_ours(folder / SUMMARY) is None:
        return frozenset()
    own = {name for name in list_entries(folder) if _is_own(folder, name, recorded)}
    return frozenset(own if recorded is None else own | {RECORD})


def _read_record(folder: Path) -> dict[str, str] | None:
    hashes = (_read_ours(folder / RECORD) or {}).get("sha256")
    return hashes if isinstance(hashes, dict) else None


def _read_ours(file: Path) -> dict[str, Any] | None:
    """The content of a JSON file of a site; None if it is none."""
    try:
        if not stat.S_ISREG(os.lstat(file).st_mode):
            return None
        content = json.loads(file.read_bytes())
    except (OSError, ValueError):
        return None
    return content if isinstance(content, dict) and content.get("generator") == GENERATOR else None


def _is_own(folder: Path, name: str, recorded: Mapping[str, str] | None) -> bool:
    path = folder / name
    if not stat.S_ISREG(os.lstat(path).st_mode):
        return False
    if recorded is None:
        return may_be_written(name) and name != RECORD and (not name.endswith(".html") or is_page(path))
    if name not in recorded:
        return False
    try:
        with path.open("rb") as file:
            return file_digest(file, "sha256").hexdigest() == recorded[name]
    except PermissionError:
        return False


def sealed(page: bytes) -> bytes:
    """A page with its hash at its end, by which a later change of it is seen."""
    return page + _SEAL + sha256(page).hexdigest().encode() + b" -->\n"


def is_changed(page: bytes) -> bool:
    """Whether a page is another one than was sealed. One of an earlier version has no seal."""
    before, seal, _ = page.rpartition(_SEAL)
    return bool(seal) and page != sealed(before)


def is_page(path: Path) -> bool:
    """Whether this package wrote a page. What is no regular file is none."""
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return PAGE_MARK in file.read(PAGE_MARK_WITHIN)
