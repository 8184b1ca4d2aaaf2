"""Results that need not be computed again, in files named by what they depend on.

An entry's name is a hash of everything that went into it: the content of the mesh, the options, the source
code of the stage, the versions of the libraries behind it. So entries never go stale; they are only no longer
asked for. An entry is written under another name first and renamed, so a reader never meets half of one.
"""

from __future__ import annotations

import hashlib
import importlib
import os
import tempfile
from collections.abc import Iterable
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from shapeviz_report.errors import CacheError


def default_root() -> Path:
    """Where results are kept unless told otherwise: below ``$XDG_CACHE_HOME`` or ``~/.cache``."""
    base = os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "shapeviz-report"


def make_key(*parts: object) -> str:
    """A name for what depends on ``parts``, whose ``repr`` must tell them apart."""
    return hashlib.sha256("\0".join(map(repr, parts)).encode()).hexdigest()[:40]


@cache
def code_version(packages: Iterable[str], libraries: Iterable[str]) -> str:
    """A name for the source code of some of our packages and the versions of the libraries they rest on.

    Parameters
    ----------
    packages : tuple of str
        Names of modules or packages; of a package all its modules count.
    libraries : tuple of str
        Names of distributions.
    """
    digest = hashlib.sha256()
    for package in packages:
        source = Path(str(importlib.import_module(package).__file__))
        files = sorted(source.parent.rglob("*.py")) if source.name == "__init__.py" else [source]
        for file in files:
            digest.update(f"{file.name}\0".encode() + file.read_bytes() + b"\0")
    for library in libraries:
        try:
            digest.update(f"{library} {version(library)}\0".encode())
        except PackageNotFoundError:
            digest.update(f"{library}\0".encode())
    return digest.hexdigest()[:16]


class Cache:
    """A folder of entries, two levels deep by stage and the first letters of the key.

    Parameters
    ----------
    root : Path
        Made when the first entry is stored.
    """

    def __init__(self, root: Path) -> None:
        self.root = root

    def path(self, stage: str, key: str) -> Path:
        """Where the entry of a stage with a key is or would be."""
        return self.root / stage / key[:2] / key[2:]

    def load(self, stage: str, key: str) -> bytes | None:
        """The content of an entry; None if there is none."""
        try:
            return self.path(stage, key).read_bytes()
        except FileNotFoundError:
            return None

    def demand(self, stage: str, key: str) -> bytes:
        """The content of an entry that was there a moment ago.

        Raises
        ------
        CacheError
            It has gone.
        """
        content = self.load(stage, key)
        if content is None:
            raise CacheError(
                f"A result vanished from the cache {self.root} while it was needed. Build again; two builds can "
                "share a cache, but nobody may empty it meanwhile."
            )
        return content

    def store(self, stage: str, key: str, content: bytes) -> None:
        """Write an entry, whole or not at all."""
        write_atomically(self.path(stage, key), content)


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
