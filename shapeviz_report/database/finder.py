"""Where files are that other files name, in spite of what systems and programs do to names."""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

from shapeviz_report.places import holds

_COUNTED = re.compile(r"^0*(0|[1-9]\d*)(?:\.0+)?(\.[a-z]\w*)?$", re.ASCII)
"""A name that is a whole number, with or without a suffix."""
_LISTINGS = 256
"""Folders whose names are remembered."""


class Finder:
    """Where named files are; it looks into each folder once.

    Parameters
    ----------
    root : Path
        Where names start.
    within : Path, optional
        A folder beyond which nothing is looked at, links resolved; by default names may lead anywhere.
    suffixes : sequence of str
        What a name may lack at its end.
    """

    def __init__(self, root: Path, within: Path | None = None, suffixes: Sequence[str] = ()) -> None:
        self.root = os.fspath(root)
        self.within = within
        self.suffixes = suffixes
        self.found: dict[str, Path | None] = {}

    def find(self, file: str) -> Path | None:
        """The file, or the folder, that is meant; None if nothing is there, or it cannot be said which.

        A path that does not exist as written is also tried with Windows' separators turned, then in other Unicode
        normal forms, which programs and file systems exchange behind their users' backs, then in another case, then as
        a number that a spreadsheet has written its own way; each also with the suffixes.
        """
        if file not in self.found:
            self.found[file] = self._find(file)
        return self.found[file]

    def _find(self, file: str) -> Path | None:
        written = spellings(file)
        for spelling in written:
            path = os.path.normpath(os.path.join(self.root, spelling))
            if not self._may_be(path):
                continue
            for suffix in ("", *self.suffixes):
                if os.path.isfile(path + suffix):
                    return self._allowed(path + suffix)
            if os.path.lexists(path):
                return Path(path)
        for like in (composed, any_case, _as_number):
            for spelling in written:
                if found := self._find_like(spelling, like):
                    return self._allowed(found)
        return None

    def _may_be(self, path: str) -> bool:
        return self.within is None or holds(self.within, Path(path))

    def _allowed(self, path: str) -> Path | None:
        return Path(path) if self._may_be(path) else None

    def _find_like(self, file: str, like: Callable[[str], str]) -> str | None:
        normal = Path(os.path.normpath(file))
        path = normal.anchor or self.root
        *folders, name = normal.parts[1:] if normal.anchor else normal.parts or ("",)
        for folder in folders:
            exact = os.path.normpath(os.path.join(path, folder))
            if not os.path.isdir(exact):
                alike = self._list(path, like).get(like(folder), ())
                if len(alike) != 1:
                    return None
                exact = os.path.join(path, alike[0])
            path = exact
        for names in ({like(name)}, {like(name + suffix) for suffix in self.suffixes}):
            alike = tuple(entry for known in names for entry in self._list(path, like).get(known, ()))
            if alike:
                return os.path.join(path, alike[0]) if len(alike) == 1 else None
        return None

    def _list(self, folder: str, like: Callable[[str], str]) -> Mapping[str, Sequence[str]]:
        """The names in a folder by what they are like; none if it cannot be opened."""
        try:
            if self._may_be(folder):
                # the many meshes of one folder name files in it
                return _list_names(folder, os.stat(folder).st_mtime_ns, like)
        except (OSError, ValueError):
            pass
        return {}


@lru_cache(_LISTINGS)
def _list_names(folder: str, changed: int, like: Callable[[str], str]) -> dict[str, list[str]]:
    """The names in a folder, as it is since it was last changed, by what they are like."""
    listing: dict[str, list[str]] = {}
    for name in os.listdir(folder):
        listing.setdefault(like(name), []).append(name)
    return listing


def spellings(file: str) -> list[str]:
    """A path as it stands in a file, and with Windows' separators turned; none if it leads to another machine.

    Windows would ask that machine for the file, and tell it who asks.
    """
    turned = file.replace("\\", "/")
    return [] if turned.startswith("//") else list(dict.fromkeys((file, turned)))


def composed(name: str) -> str:
    """A name in Unicode's normal form."""
    return unicodedata.normalize("NFC", name)


def any_case(name: str) -> str:
    """What a name has in common with all that differ in the case of letters only, or in their normal form."""
    return composed(composed(name).casefold())


def _as_number(name: str) -> str:
    """The name without what spreadsheets add to a number, ``.0``, and what they take away, zeros in front."""
    return _COUNTED.sub(r"\1\2", any_case(name))
