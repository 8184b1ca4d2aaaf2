"""Whether a site can be written where it was asked for, without touching anything that is not its own."""

from __future__ import annotations

import errno
import os
from collections.abc import Mapping
from pathlib import Path

from shapeviz_report.errors import SiteError
from shapeviz_report.places import explain, holds, refuse_no_path, tried
from shapeviz_report.system import is_mount_point
from shapeviz_report.writing.record import (
    FOLDERS,
    find_own,
    is_changed,
    is_kept_beside,
    is_page,
    list_entries,
    may_be_written,
)
from shapeviz_report.writing.swap import mend

_PAGES = (".html", ".htm")
"""How a site in one file ends, and a folder hardly."""


def check_destination(
    destination: Path, *, single_file: bool = False, kept: Mapping[str, Path] | None = None
) -> None:
    """Refuse a place where a site cannot be written, or would take the place of something that is not its own.

    Parameters
    ----------
    destination : Path
    single_file : bool
        Whether the site is to be one file, and not a folder.
    kept : mapping of str to Path, optional
        What the build reads or keeps, by what people call it: none of it may lie in the site.

    Raises
    ------
    SiteError
        The message says what is in the way, and what to do.
    """
    try:
        refuse_no_path(destination)
        if _is_loop(destination):
            raise SiteError(
                f"{destination} is a link that leads to itself: choose another place for the site"
            )
        for what, path in (kept or {}).items():
            if holds(destination, path):
                raise SiteError(
                    f"{destination} cannot be the site's place, for it is or holds {what} ({path}): choose another"
                )
        if single_file:
            _check_file(destination)
        else:
            _check_folder(destination)
    except OSError as error:
        raise SiteError(f"the site cannot be written to {destination}: {explain(error)}") from error


def _is_loop(path: Path) -> bool:
    try:
        os.stat(path)
    except OSError as error:
        return error.errno == errno.ELOOP
    return False


def _check_file(destination: Path) -> None:
    if destination.suffix.lower() not in _PAGES:
        raise SiteError(f"a site in a single file needs a name that ends in .html, unlike {destination}")
    if os.path.isdir(destination):
        raise SiteError(f"{destination} is a folder: name a file for a site in a single file")
    if os.path.exists(destination) and not is_page(destination):
        raise SiteError(
            f"{destination} is not a site of shapeviz-report, and would be replaced: choose another name"
        )
    if os.path.exists(destination) and is_changed(destination.read_bytes()):
        raise SiteError(
            f"{destination} was changed since it was written, and would be replaced: move it, or choose another name"
        )
    _check_parents(destination)
    real = Path(os.path.realpath(destination))
    _refuse_mount_point(real)
    with tried(real.parent) as trial:
        # the name itself, which the system may find too long or refuse
        (trial / real.name).write_bytes(b"")


def _check_folder(destination: Path) -> None:
    if os.path.exists(destination) and not os.path.isdir(destination):
        raise SiteError(f"{destination} is a file: choose a folder for the site")
    if destination.suffix.lower() in _PAGES and not os.path.exists(destination):
        raise SiteError(
            f"{destination} would be a folder: add --single-file for a site in one file, or choose another name"
        )
    real = Path(os.path.realpath(destination))
    if holds(real, Path()):
        raise SiteError(
            f"{destination} is the current folder or holds it, and would be exchanged for another one under your "
            "feet: go elsewhere and name it from there, or choose another folder"
        )
    _check_parents(destination)
    _refuse_mount_point(real)
    if not real.exists():
        with tried(real):
            return
    with tried(real.parent), tried(real):
        pass
    mend(real, find_own)
    own = find_own(real)
    foreign = [name for name in list_entries(real) if name not in own]
    if not own and not all(map(is_kept_beside, foreign)):
        raise SiteError(
            f"{destination} holds files that are not a site of shapeviz-report, and would be replaced: "
            "choose another folder, or empty this one"
        )
    taken = [name for name in foreign if may_be_written(name) or name in FOLDERS]
    if taken:
        some = ", ".join(map(repr, taken[:5])) + (f" and {len(taken) - 5} more" if len(taken) > 5 else "")
        raise SiteError(
            f"{destination} holds files that the site would replace, and that it did not write, or that were "
            f"changed since: {some}. Move or remove them, or choose another folder"
        )
    for name in foreign:
        _check_movable(real / name)


def _check_parents(destination: Path) -> None:
    """Refuse a path through a file."""
    ancestor = Path(os.path.realpath(destination)).parent
    while not os.path.lexists(ancestor):
        ancestor = ancestor.parent
    if not ancestor.is_dir():
        raise SiteError(f"{destination} cannot be made: {ancestor} is not a folder that you may write to")


def _refuse_mount_point(path: Path) -> None:
    if is_mount_point(path):
        raise SiteError(
            f"{path} is a mount point, which the system neither moves nor exchanges for another folder: choose a "
            "folder inside it for the site, or unmount it"
        )


def _check_movable(path: Path) -> None:
    """Refuse an entry of a publisher that could not move along. None is moved to find out: that could go wrong."""
    _refuse_mount_point(path)
    if path.is_dir() and not path.is_symlink() and not os.access(path, os.W_OK):
        raise SiteError(
            f"{path} is a folder that you may not write to, so that it cannot move into the new site: make it "
            "writable, or choose another folder for the site"
        )
