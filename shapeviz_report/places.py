"""Where something lies, and whether something can be written there: found out by trying."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from shapeviz_report.writing import created, leftovers

_TRIAL = ".shapeviz-trial-"

TRIAL_BYTES = 65_536
"""Written to see that a disk is not full: enough for a system to give it a block of its own."""


def holds(folder: Path, path: Path) -> bool:
    """Whether a path is a folder or lies in it, links resolved."""
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def is_mount_point(path: Path) -> bool:
    """Whether something is mounted at a path, a part of the same file system (a bind mount) too where Linux tells."""
    try:
        lines = Path("/proc/self/mountinfo").read_bytes().splitlines()
    except OSError:
        return os.path.ismount(path)
    # blanks and backslashes stand as octal numbers
    points = (re.sub(rb"\\(\d{3})", lambda m: bytes([int(m[1], 8)]), line.split()[4]) for line in lines)
    return os.fsencode(os.path.abspath(path)) in points


@contextmanager
def tried(folder: Path) -> Iterator[Path]:
    """A new hidden folder with a file in it, in ``folder`` or what there is of its path; removed afterwards.

    Folders that are missing are made inside it, so that their names are tried too and none is left behind.

    Parameters
    ----------
    folder : Path
        Need not exist.

    Yields
    ------
    Path
        Nothing that anybody wants to keep may be put there.

    Raises
    ------
    OSError
        Nothing can be written there.
    """
    existing = Path(os.path.realpath(folder))
    missing: list[str] = []
    while not os.path.lexists(existing):
        missing.insert(0, existing.name)
        existing = existing.parent
    for left in leftovers(existing, _TRIAL):
        shutil.rmtree(left, ignore_errors=True)
    with created(existing, _TRIAL, Path.mkdir) as trial:
        try:
            inside = trial.joinpath(*missing)
            inside.mkdir(parents=True, exist_ok=True)
            (trial / "full").write_bytes(bytes(TRIAL_BYTES))
            yield trial
        finally:
            shutil.rmtree(trial, ignore_errors=True)
