"""Results that need not be computed again, in files named by what they depend on.

An entry's name is a hash of everything that went into it: the content of the mesh, the options, the source
code that the stage reaches and the versions of the libraries behind it (``versions.py``). So entries never go stale;
they are only no longer asked for. An entry is written under another name first and renamed, so a reader never meets
half of one. It begins with a checksum over its stage, its key and its content: what a disk, a copy or a person has
changed is thrown away and computed anew. What cannot be put in its place is held until the process ends.
"""

from __future__ import annotations

import errno
import hashlib
import logging
import os
import shutil
import time
from contextlib import suppress
from pathlib import Path

from shapeviz_report.errors import CacheError
from shapeviz_report.files import read_regular
from shapeviz_report.staging import write_atomically
from shapeviz_report.system import cache_folder, open_for_reading

logger = logging.getLogger(__name__)

_MARK = b"shapeviz-report entry 1\n"
"""What every entry begins with; the number changes with the layout."""

_DIGEST_SIZE = 32

USED_EVERY = 86_400
"""Seconds after which a use is noted again: so an entry that is read often is seldom written to."""

MOST_HELD = 2**28
"""Bytes of results that are held in memory, for want of a place."""

_FULL = (errno.ENOSPC, errno.EDQUOT)
"""What a disk says that takes no more."""


def default_root() -> Path:
    """Where results are kept unless told otherwise."""
    return cache_folder() / "shapeviz-report"


def make_key(*parts: object) -> str:
    """A name for what depends on ``parts``, whose ``repr`` must tell them apart."""
    return hashlib.sha256("\0".join(map(repr, parts)).encode()).hexdigest()[:40]


class Cache:
    """A folder of entries, two levels deep by stage and the first letters of the key.

    Parameters
    ----------
    root : Path
        Made when the first entry is stored.

    Attributes
    ----------
    spoiled : int
        Entries that were met and thrown away, for they were not what was stored.
    """

    def __init__(self, root: Path) -> None:
        self.root = root
        self.spoiled = 0
        self._held: dict[tuple[str, str], bytes] = {}
        self._refusal = ""

    def path(self, stage: str, key: str) -> Path:
        """Where the entry of a stage with a key is or would be."""
        return self.root / stage / key[:2] / key[2:]

    def holds(self, stage: str, key: str) -> bool:
        """Whether there is an entry, be it whole or not."""
        return (stage, key) in self._held or os.path.isfile(self.path(stage, key))

    def load(self, stage: str, key: str) -> bytes | None:
        """The content of an entry, exactly as it was stored; None if there is none.

        Whatever else is found in its place or on the way there is thrown away, and counted as spoiled.
        """
        if (stage, key) in self._held:
            return self._held[stage, key]
        path = self.path(stage, key)
        try:
            entry = read_regular(path)
        except OSError:
            if not self._is_obstructed(path):
                return None
        else:
            head, content = entry[: len(_MARK) + _DIGEST_SIZE], entry[len(_MARK) + _DIGEST_SIZE :]
            if head == _head(stage, key, content):
                _mark_used(path)
                return content
            discard(path)
        self.spoiled += 1
        return None

    def _is_obstructed(self, path: Path) -> bool:
        """Whether something stands where an entry that could not be read would be, or a folder of it: it is removed."""
        for folder in (path.parent.parent, path.parent):
            if os.path.lexists(folder) and not os.path.isdir(folder):
                discard(folder)
                return True
        try:
            os.lstat(path)
        except FileNotFoundError:
            return False
        except OSError:
            return True
        discard(path)
        return True

    def store(self, stage: str, key: str, content: bytes) -> None:
        """Write an entry, whole or not at all. What the system does not let take its place is held in memory.

        Raises
        ------
        CacheError
            The cache takes no results at all, or more than :data:`MOST_HELD` bytes cannot be put in their places.
        """
        path = self.path(stage, key)
        if os.path.isdir(path):
            # all else is replaced by what is written
            discard(path)
        try:
            write_atomically(path, _head(stage, key, content) + content)
        except OSError as error:
            self._held[stage, key] = content
            self._refusal = f"{error.strerror or error} ({path})"
            takes_others = os.access(self.root, os.W_OK | os.X_OK) and error.errno not in _FULL
            if not takes_others or sum(map(len, self._held.values())) > MOST_HELD:
                raise CacheError(
                    f"Results cannot be kept in the cache {self.root}: {self._refusal}. Make room there, or name "
                    "another folder with --cache; what was kept before stays."
                ) from error

    def tell(self) -> None:
        """Log a warning if entries were spoiled or could not be put in their places."""
        said = []
        if self.spoiled:
            what = "result" if self.spoiled == 1 else "results"
            said.append(
                f"{self.spoiled:,} kept {what} in the cache {self.root} had been damaged; computed anew."
            )
        if self._held:
            what = "result" if len(self._held) == 1 else "results"
            said.append(
                f"{len(self._held):,} {what} could not be kept there, and will be computed again: {self._refusal}."
            )
        if said:
            logger.warning("Note: %s", " ".join(said))


def is_entry(path: Path) -> bool:
    """Whether a regular file begins as a result does, be it whole or not.

    Raises
    ------
    OSError
        It cannot be read.
    """
    with os.fdopen(open_for_reading(path, follow=False), "rb") as file:
        return file.read(len(_MARK)) == _MARK


def _mark_used(path: Path) -> None:
    """Let the time of a file tell when it was last used, to :data:`USED_EVERY` seconds."""
    # a cache that cannot be written tells nothing, and is of use all the same
    with suppress(OSError):
        if time.time() - os.stat(path).st_mtime > USED_EVERY:
            os.utime(path)


def _head(stage: str, key: str, content: bytes) -> bytes:
    digest = hashlib.blake2b(f"{stage}\0{key}\0".encode(), digest_size=_DIGEST_SIZE)
    digest.update(content)
    return _MARK + digest.digest()


def discard(path: Path) -> None:
    """Remove what stands at a path, be it a file, a link, a pipe or a folder, as far as the system allows."""
    if os.path.isdir(path) and not os.path.islink(path):
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            os.unlink(path)
