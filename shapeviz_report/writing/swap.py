"""A folder that appears at once: written beside its place, then exchanged with what is there.

Two hidden siblings may stand beside a folder. One *being written* holds nothing but new files. One *being placed*
also holds, for an instant, entries that its owner keeps in the folder: these are moved by renaming, never copied,
before the exchange and, should a writer be killed between two moves, given back by the next one.
"""

from __future__ import annotations

import errno
import logging
import os
import shutil
from collections.abc import Callable, Iterator, Set
from contextlib import contextmanager, suppress
from pathlib import Path

from shapeviz_report.staging import created, hidden_prefix, leftovers, new_path
from shapeviz_report.system import alone_in, exchange
from shapeviz_report.writing.record import FOLDERS, RECORD, SUMMARY, list_entries

logger = logging.getLogger(__name__)

_WRITING, _PLACING = "writing", "placing"

FindOwn = Callable[[Path], Set[str]]
"""Says which entries of a folder may be removed; see :func:`~shapeviz_report.writing.record.find_own`."""


@contextmanager
def replaced_folder(destination: Path, find_own: FindOwn) -> Iterator[Path]:
    """A new empty folder that takes the place of ``destination`` when the block ends without an error.

    The folder is a hidden sibling, so the exchange stays on one file system. It is locked while its writer
    lives; what a killed writer leaves is mended by the next one. Where the system can exchange two folders
    (Linux), there is no instant without one; elsewhere two renames leave a very short one.

    Parameters
    ----------
    destination : Path
        A folder, or nothing yet. Its parents are made.
    find_own : callable
        Which entries of the folder that is there go; all others move into the new one.

    Yields
    ------
    Path
        Where to write.

    Raises
    ------
    FileExistsError
        The new folder has an entry where its owner keeps another; all is as before.
    OSError
    """
    destination = destination.resolve()
    destination.parent.mkdir(parents=True, exist_ok=True)
    mend(destination, find_own)
    with created(destination.parent, hidden_prefix(destination.name, _WRITING), Path.mkdir) as folder:
        try:
            yield folder
            # two who place at once would take each other's files for their owner's
            with alone_in(destination.parent):
                _place(folder, destination, find_own)
        finally:
            shutil.rmtree(folder, ignore_errors=True)


def _place(folder: Path, destination: Path, find_own: FindOwn) -> None:
    """Put a folder that was written into its place, and take out of there what is not its owner's."""
    placed = new_path(destination.parent, hidden_prefix(destination.name, _PLACING))
    folder.rename(placed)
    if not destination.exists():
        placed.rename(destination)
        return
    try:
        _carry(destination, placed, find_own(destination))
        if not exchange(placed, destination):
            old = new_path(destination.parent, hidden_prefix(destination.name, _PLACING))
            destination.rename(old)
            placed.rename(destination)
            placed = old
    finally:
        try:
            if destination.exists():
                _settle(placed, destination, find_own)
        except OSError as error:
            logger.warning("%s stays, until the next build can clear it: %s", placed, error)


def mend(destination: Path, find_own: FindOwn) -> None:
    """Remove what killed writers left beside a folder, and give back what belongs into it. A folder whose writer
    lives is locked and stays."""
    with alone_in(destination.parent):
        for folder in leftovers(destination.parent, hidden_prefix(destination.name, _PLACING)):
            with suppress(OSError):
                if destination.exists():
                    _settle(folder, destination, find_own)
                else:
                    # killed between the two renames of a system that cannot exchange
                    folder.rename(destination)
    for folder in leftovers(destination.parent, hidden_prefix(destination.name, _WRITING)):
        shutil.rmtree(folder, ignore_errors=True)


def _carry(source: Path, target: Path, own: Set[str]) -> None:
    """Move every entry that is not ``own`` from one folder into another: all of them, or as far as an error allows."""
    moves = [name for name in list_entries(source) if name not in own]
    for name in moves:
        if os.path.lexists(target / name):
            raise FileExistsError(
                errno.EEXIST, "the site has a file of this name, and so has its folder", name
            )
    for name in moves:
        (target / name).parent.mkdir(exist_ok=True)
        os.rename(source / name, target / name)


def _settle(folder: Path, destination: Path, find_own: FindOwn) -> None:
    """Give back what is the owner's in a folder that was placed or was to be, and remove the rest of it."""
    own = find_own(folder)
    for name in list_entries(folder):
        if name in own:
            continue
        if os.path.lexists(destination / name):
            logger.warning("%s was kept: %s has another file of this name", folder / name, destination)
            continue
        (destination / name).parent.mkdir(exist_ok=True)
        os.rename(folder / name, destination / name)
    # what tells whose the rest is goes last
    for name in sorted(own, key=lambda name: (name == RECORD, name == SUMMARY)):
        (folder / name).unlink(missing_ok=True)
    for inner in (*(folder / name for name in FOLDERS), folder):
        with suppress(OSError):
            inner.rmdir()
