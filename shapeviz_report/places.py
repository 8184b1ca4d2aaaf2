"""Where something lies, and whether something can be written there: found out by trying."""

from __future__ import annotations

import errno
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from shapeviz_report.staging import created, leftovers

_TRIAL = ".shapeviz-trial-"

TRIAL_BYTES = 65_536
"""Written to see that a disk is not full: enough for a system to give it a block of its own."""


_ADVICE = {
    errno.ENAMETOOLONG: "choose a shorter name",
    errno.ENOSPC: "make room there, or choose another place",
    errno.EDQUOT: "make room there, or choose another place",
    errno.EINVAL: "choose a name that the system takes",
    errno.EILSEQ: "choose a name that the system takes",
}
_IN_USE = 32
"""What Windows says of a file that a program has open."""


def explain(error: OSError) -> str:
    """Why nothing can be written somewhere, where, and what to do about it."""
    where = (
        f" ({os.fsdecode(error.filename)})" if isinstance(error.filename, str | bytes | os.PathLike) else ""
    )
    advice = _ADVICE.get(error.errno or 0, "choose another place, or make this one writable")
    if getattr(error, "winerror", None) == _IN_USE:
        advice = "close the program that has it open, or choose another place"
    return f"{error.strerror or error}{where}; {advice}"


def refuse_no_path(path: Path) -> None:
    """Refuse text that no file can be called. Raises ``OSError``, as the system does for other names."""
    try:
        encoded = os.fsencode(path)
    except UnicodeEncodeError:
        encoded = b"\0"
    if b"\0" in encoded:
        raise OSError(errno.EINVAL, "it is no name of a file", ascii(os.fspath(path)))


def holds(folder: Path, path: Path) -> bool:
    """Whether a path is a folder or lies in it, links resolved. What no file can be called lies nowhere."""
    try:
        return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))
    except ValueError:
        return False


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
    refuse_no_path(folder)
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
