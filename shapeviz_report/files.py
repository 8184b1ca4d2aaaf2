"""Reading files of strangers: regular ones only, and no larger than expected."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

from shapeviz_report.system import open_for_reading

MOST_BYTES = 1024**3
"""Size of the largest file that is read, in bytes: ten million triangles as text take this much or less."""


class TooLargeError(OSError):
    """A file has more bytes than its reader takes."""

    def __init__(self, path: Path, most: int) -> None:
        size = f"{most / 2**20:,.0f} MiB" if most >= 2**20 else f"{most / 2**10:,.0f} KiB"
        super().__init__(0, f"it is larger than {size}", str(path))


def read_regular(path: Path, most: int = MOST_BYTES) -> bytes:
    """The content of a regular file.

    A pipe or a device may never end, or never begin; it is not opened for more than a look.

    Parameters
    ----------
    path : Path
        Links are followed.
    most : int
        Bytes that the file may have.

    Raises
    ------
    OSError
        It cannot be opened, is no regular file, or is larger. ``strerror`` says which, in words for its owner.
    """
    try:
        descriptor = open_for_reading(path)
    except ValueError as error:
        raise OSError(errno.EINVAL, "it is no name of a file", ascii(os.fspath(path))) from error
    with os.fdopen(descriptor, "rb") as file:
        status = os.fstat(descriptor)
        if stat.S_ISDIR(status.st_mode):
            raise IsADirectoryError(0, "Is a directory", str(path))
        if not stat.S_ISREG(status.st_mode):
            raise OSError(0, "it is not a regular file but a pipe, a socket or a device", str(path))
        # Python allocates what it is asked for, before it reads; and the size need not be true.
        content = file.read(status.st_size + 1) if status.st_size <= most else b""
    if max(len(content), status.st_size) > most:
        raise TooLargeError(path, most)
    return content


def decode_text(content: bytes) -> str:
    """The text of a file that somebody brings along, in UTF-8 with or without its mark. Raises ``ValueError``."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise ValueError("it is not UTF-8; save it so (spreadsheets call it CSV UTF-8)") from error
