"""What a cache holds, and what of it may go.

Results of other versions of the code, of meshes that have changed and of options that are no longer used are never
asked for again, and nothing removes them unasked. The time at which a file of the cache was changed is that of its last
use (:meth:`shapeviz_report.cache.Cache.load`), to a day.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from shapeviz_report.cache import is_entry
from shapeviz_report.errors import CacheError

DAY = 86_400.0
"""Seconds."""

_STAGE = re.compile(r"[a-z][a-z-]*")
_FOLDER = re.compile(r"[0-9a-f]{2}")
_NAME = re.compile(r"[0-9a-f]{38}")


@dataclass(frozen=True, order=True)
class Entry:
    """A result that is kept; the one longest unused comes first.

    Attributes
    ----------
    used : float
        When it was last asked for, to a day; seconds since 1970.
    path : str
    size : int
        Bytes.
    stage : str
        The folder of its stage.
    """

    used: float
    path: str
    size: int
    stage: str


def list_entries(root: Path) -> Iterator[Entry]:
    """Everything in a cache that has the name of a result, in no order; links are not followed.

    Raises
    ------
    CacheError
        The folder cannot be read.
    """
    try:
        stages = [one for one in os.scandir(root) if _is_folder(one, _STAGE)]
    except FileNotFoundError:
        return
    except OSError as error:
        raise CacheError(f"The cache {root} cannot be read: {error.strerror}.") from error
    for stage in stages:
        for folder in (one for one in _scan(stage.path) if _is_folder(one, _FOLDER)):
            for file in _scan(folder.path):
                with suppress(OSError):
                    if _NAME.fullmatch(file.name) and file.is_file(follow_symlinks=False):
                        status = file.stat(follow_symlinks=False)
                        yield Entry(status.st_mtime, file.path, status.st_size, stage.name)


def choose_unused(
    entries: Iterable[Entry], now: float, *, days: float | None = None, most: int | None = None
) -> list[Entry]:
    """What is to go, the longest unused first.

    Parameters
    ----------
    entries : iterable of Entry
    now : float
        Seconds since 1970.
    days : float, optional
        What was not used for so long goes.
    most : int, optional
        Bytes that may stay; of more, the longest unused goes.
    """
    ordered = sorted(entries)
    size = sum(entry.size for entry in ordered)
    chosen = []
    for entry in ordered:
        old = days is not None and now - entry.used > days * DAY
        if not old and (most is None or size <= most):
            break
        chosen.append(entry)
        size -= entry.size
    return chosen


def remove(entries: Iterable[Entry]) -> tuple[int, int]:
    """Remove results, and folders that this leaves empty; a build that is running computes anew what it misses.

    A file that does not begin as a result does is not ours and stays.

    Returns
    -------
    count, size : int
        What was removed, in files and in bytes.
    """
    count = size = 0
    for entry in entries:
        with suppress(OSError):
            if not is_entry(Path(entry.path)):
                continue
            os.unlink(entry.path)
            count, size = count + 1, size + entry.size
            os.rmdir(os.path.dirname(entry.path))
    return count, size


def _scan(folder: str) -> Iterator[os.DirEntry[str]]:
    with suppress(OSError), os.scandir(folder) as found:
        yield from found


def _is_folder(entry: os.DirEntry[str], name: re.Pattern[str]) -> bool:
    return name.fullmatch(entry.name) is not None and entry.is_dir(follow_symlinks=False)
