"""Finding the mesh files below a folder."""

from __future__ import annotations

import os
from collections import Counter, deque
from dataclasses import dataclass
from pathlib import Path

from shapeviz_report.database.formats import (
    PACKED,
    is_read,
    is_unread_mesh,
    split_name,
    suffix_of,
    why_not_read,
)
from shapeviz_report.database.text import readable
from shapeviz_report.errors import DatabaseError
from shapeviz_report.order import natural
from shapeviz_report.places import holds
from shapeviz_report.system import is_link
from shapeviz_report.types import Failure

MOST_WAYS = 10
"""Links that lead to one folder. Folders with links to one another have more ways through them than can be gone."""

_NEVER_SHAPES = ("__MACOSX",)

SITE_MARK = b'{\n"generator": "shapeviz-report"'
"""How the record of a site begins."""


@dataclass(frozen=True)
class MeshFile:
    """A mesh below the scanned folder; ``relative`` is its path from there as text, ``/`` between folders."""

    location: str
    relative: str

    @property
    def path(self) -> Path:
        """The file."""
        return Path(self.location)

    @property
    def folders(self) -> tuple[str, ...]:
        """The folders between the root and the file."""
        return tuple(self.relative.split("/")[:-1])

    @property
    def stem(self) -> str:
        """The file's name without suffix."""
        return split_name(self.relative.rpartition("/")[2])[0]


@dataclass(frozen=True)
class Found:
    """What a scan found, in an order that does not depend on that of the file system.

    Attributes
    ----------
    files : tuple of MeshFile
        Sorted by ``relative``.
    failures : tuple of Failure
        Meshes of formats that are not read, broken links, folders that cannot be opened. Sorted by path.
    """

    files: tuple[MeshFile, ...]
    failures: tuple[Failure, ...]

    @property
    def paths(self) -> list[str]:
        """The relative path of everything found, taken or not."""
        return [*(file.relative for file in self.files), *(failure.path for failure in self.failures)]


def _begins_with(name: str, stems: set[str]) -> bool:
    parts = name.split(".")
    return any(".".join(parts[:end]) in stems for end in range(1, len(parts)))


def _is_of_a_site(folder: str, name: str) -> bool:
    """Whether an entry of a folder is the glTF that a site which was built there offers: its shapes once more."""
    record = os.path.join(folder, "data", "files.json")
    if name != "gltf" or not os.path.isfile(record):
        return False
    try:
        with open(record, "rb") as file:
            return file.read(len(SITE_MARK)) == SITE_MARK
    except OSError:
        return False


def leads_outside(path: str | Path, folder: str | Path) -> bool:
    """Whether a path is not in a folder, links resolved."""
    return not holds(Path(folder), Path(path))


def scan_folder(root: Path, outside: bool) -> Found:
    """Every mesh below a folder, and whatever looks like one and cannot be taken.

    Links are followed, to files and to folders. Failures are a link back to a folder above it, so that a loop ends; a
    link to a folder that ``MOST_WAYS`` others have led to; and, unless ``outside`` ones are wanted, a link to a folder
    that is not below the root. Hidden files and folders, files that are no meshes, and the glTF of sites are passed
    over in silence.

    Raises
    ------
    DatabaseError
        If the root is not a folder, or cannot be opened.
    """
    files: list[MeshFile] = []
    failures: list[Failure] = []

    def fail(relative: str, reason: str) -> None:
        failures.append(Failure(relative, "read", reason))

    # a folder waits with the identities of the folders above it, by which a loop of links is seen
    ways: Counter[tuple[int, int]] = Counter()
    waiting: deque[tuple[str, str, frozenset[tuple[int, int]]]] = deque([(os.fspath(root), "", frozenset())])
    while waiting:
        # short ways first, so that it is no link that leads to a folder before its own name does
        folder, prefix, above = waiting.popleft()
        try:
            status = os.stat(folder)
            identity = (status.st_dev, status.st_ino)
            if identity in above:
                fail(
                    prefix.rstrip("/"),
                    "this folder is a link to a folder that contains it; it was not followed",
                )
                continue
            ways[identity] += 1
            if ways[identity] > MOST_WAYS:
                fail(
                    prefix.rstrip("/"), f"{MOST_WAYS} links lead to this folder already; it was not followed"
                )
                continue
            with os.scandir(folder) as listing:
                entries = sorted(listing, key=lambda entry: entry.name)
        except OSError as error:
            if not prefix:
                raise DatabaseError(f"The folder {root} cannot be opened: {error.strerror}.") from error
            fail(prefix.rstrip("/"), f"this folder cannot be opened: {error.strerror}")
            continue
        # A file that begins with the name of a mesh beside it (.step, .solid.binvox) is that mesh's companion.
        stems = {split_name(entry.name)[0] for entry in entries if is_read(entry.name)}
        names = {entry.name for entry in entries}
        for entry in entries:
            if entry.name.startswith(".") or entry.name in _NEVER_SHAPES or _is_of_a_site(folder, entry.name):
                continue
            relative = prefix + readable(entry.name)
            try:
                is_folder, is_file = entry.is_dir(), entry.is_file()
            except OSError as error:
                fail(relative, f"this link leads nowhere: {error.strerror}")
                continue
            if is_folder and not outside and is_link(entry) and leads_outside(entry.path, root):
                place = os.path.realpath(entry.path)
                fail(
                    relative,
                    f"it lies outside the database's folder, at {place}; copy it into the folder, or have such folders "
                    "read by --outside",
                )
            elif is_folder:
                waiting.append((entry.path, relative + "/", above | {identity}))
            elif not is_read(entry.name):
                if is_unread_mesh(entry.name) and not _begins_with(entry.name, stems):
                    fail(relative, why_not_read(entry.name))
            elif suffix_of(entry.name) in PACKED and os.path.splitext(entry.name)[0] in names:
                pass  # the same mesh lies beside it
            elif is_file:
                files.append(MeshFile(entry.path, relative))
            elif entry.is_symlink():
                fail(relative, "this is a link to a file that is not there")
            else:
                fail(relative, "this is not a regular file")
    files.sort(key=lambda file: (file.relative, os.fsencode(file.location)))
    failures.sort(key=lambda failure: (natural(failure.path), failure.reason))
    return Found(tuple(files), tuple(failures))
