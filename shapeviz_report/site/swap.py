"""A folder that appears at once: written beside its place, then exchanged with what is there."""

from __future__ import annotations

import ctypes
import fcntl
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_AT_FDCWD = -100
_RENAME_EXCHANGE = 2


@contextmanager
def replaced_folder(destination: Path) -> Iterator[Path]:
    """A new empty folder that takes the place of ``destination`` when the block ends without an error.

    The folder is a hidden sibling, so the exchange stays on one file system. It is locked while its writer
    lives; a writer that was killed leaves it behind unlocked, and the next one removes it. Where the system can
    exchange two folders (Linux), there is no instant without one; elsewhere two renames leave a very short one.

    Parameters
    ----------
    destination : Path
        A folder, or nothing yet. Its parents are made.

    Yields
    ------
    Path
        Where to write.
    """
    destination = destination.resolve()
    destination.parent.mkdir(parents=True, exist_ok=True)
    prefix = f".{destination.name}.writing-"
    _remove_stale(destination.parent, prefix)
    folder = destination.parent / (prefix + secrets.token_hex(6))
    folder.mkdir()
    lock = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield folder
        if not destination.exists():
            folder.rename(destination)
        elif not _exchange(folder, destination):
            old = destination.parent / (prefix + secrets.token_hex(6))
            destination.rename(old)
            folder.rename(destination)
            folder = old
    finally:
        os.close(lock)
        shutil.rmtree(folder, ignore_errors=True)


def _remove_stale(parent: Path, prefix: str) -> None:
    """Remove what killed writers left. A folder whose writer lives is locked and stays."""
    for folder in parent.iterdir():
        if not folder.name.startswith(prefix):
            continue
        with suppress(OSError):
            handle = os.open(folder, os.O_RDONLY | os.O_NOFOLLOW)
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
                shutil.rmtree(folder)
            finally:
                os.close(handle)


def _exchange(one: Path, other: Path) -> bool:
    """Exchange two folders in one step; False where the system or the file system cannot."""
    renameat2 = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)
    if renameat2 is None:
        return False
    return renameat2(_AT_FDCWD, os.fsencode(one), _AT_FDCWD, os.fsencode(other), _RENAME_EXCHANGE) == 0
