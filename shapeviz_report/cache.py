"""Results that need not be computed again, in files named by what they depend on.

An entry's name is a hash of everything that went into it: the content of the mesh, the options, the source
code that the stage reaches and the versions of the libraries behind it (``versions.py``). So entries never go stale;
they are only no longer asked for. An entry is written under another name first and renamed, so a reader never meets
half of one. It begins with a checksum over its stage, its key and its content: what a disk, a copy or a person has
changed is thrown away and computed anew.
"""

from __future__ import annotations

import hashlib
import logging
import os
import shutil
import tempfile
from pathlib import Path

from shapeviz_report.errors import CacheError
from shapeviz_report.files import read_regular

logger = logging.getLogger(__name__)

_MARK = b"shapeviz-report entry 1\n"
"""What every entry begins with; the number changes with the layout."""

_DIGEST_SIZE = 32


def default_root() -> Path:
    """Where results are kept unless told otherwise: below ``$XDG_CACHE_HOME`` or ``~/.cache``."""
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "shapeviz-report"


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

    def path(self, stage: str, key: str) -> Path:
        """Where the entry of a stage with a key is or would be."""
        return self.root / stage / key[:2] / key[2:]

    def load(self, stage: str, key: str) -> bytes | None:
        """The content of an entry, exactly as it was stored; None if there is none.

        Whatever else is found in its place is thrown away, and counted as spoiled.
        """
        path = self.path(stage, key)
        try:
            entry: bytes | None = read_regular(path)
        except (FileNotFoundError, NotADirectoryError):
            # A link to nowhere is not found either, and is in the way all the same.
            entry = b"" if path.is_symlink() else None
        except OSError:
            entry = b""
        if entry is None:
            return None
        head, content = entry[: len(_MARK) + _DIGEST_SIZE], entry[len(_MARK) + _DIGEST_SIZE :]
        if head == _head(stage, key, content):
            return content
        self.spoiled += 1
        discard(path)
        return None

    def store(self, stage: str, key: str, content: bytes) -> None:
        """Write an entry, whole or not at all. Raises :class:`CacheError` if that cannot be done."""
        try:
            write_atomically(self.path(stage, key), _head(stage, key, content) + content)
        except OSError as error:
            raise CacheError(
                f"Results cannot be kept in the cache {self.root}: {error.strerror}. Make room there, or name another "
                "folder with --cache; what was kept before stays."
            ) from error

    def tell_spoiled(self) -> None:
        """Log a warning if entries were spoiled."""
        if self.spoiled:
            logger.warning(
                "Note: %d kept %s in the cache %s had been damaged; computed anew.",
                self.spoiled,
                "result" if self.spoiled == 1 else "results",
                self.root,
            )


def _head(stage: str, key: str, content: bytes) -> bytes:
    digest = hashlib.blake2b(f"{stage}\0{key}\0".encode(), digest_size=_DIGEST_SIZE)
    digest.update(content)
    return _MARK + digest.digest()


def discard(path: Path) -> None:
    """Remove what stands at a path, be it a file, a link, a pipe or a folder; another process may be faster."""
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file so that at no moment anything but its old or its whole new content is there."""
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, temporary = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=".tmp")
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(content)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise
