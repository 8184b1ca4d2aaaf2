"""Windows.

What a lock is on the other systems is here what an open file lets others do with it meanwhile: whoever holds a file or
a folder has it open for writing, and whoever claims it opens it so that nobody may write. Both let it be renamed and
removed. Such a hold ends with its process.
"""

from __future__ import annotations

import sys

assert sys.platform == "win32"

import _winapi  # CreateFile, which `os.open` reaches only for files and without what others may do
import ctypes
import os
import subprocess
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from multiprocessing.connection import PipeConnection as PipeEnd
from pathlib import Path
from typing import Any

LACKING_MEMORY = (3, 0xC0000005, 0xC0000017, 0xC000012D)
"""Exit codes of processes that got no memory: C++ aborts, C uses what it did not get, and the system refuses."""

_WRITE_DATA = 0x2
_DELETE = 0x10000
_SHARE_READ, _SHARE_WRITE, _SHARE_DELETE = 1, 2, 4
_CREATE_IF_MISSING = 4
_DELETE_ON_CLOSE = 0x04000000
_FOLDERS_TOO = 0x02000000
_LINKS_THEMSELVES = 0x00200000
_SHARING_VIOLATION = 32
_DELETE_PENDING = 5
_BETWEEN_TRIES = 0.05


class _MemoryStatus(ctypes.Structure):
    _fields_ = (
        ("length", ctypes.c_uint32),
        ("load", ctypes.c_uint32),
        ("total_physical", ctypes.c_uint64),
        ("available_physical", ctypes.c_uint64),
        ("total_paged", ctypes.c_uint64),
        ("available_paged", ctypes.c_uint64),
        ("total_virtual", ctypes.c_uint64),
        ("available_virtual", ctypes.c_uint64),
        ("available_extended", ctypes.c_uint64),
    )


def core_count() -> int:
    """How many cores this process may use."""
    return os.cpu_count() or 1


def cache_folder() -> Path:
    """Where programs of this user keep what they can make again."""
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return Path(base) if base else Path.home() / "AppData" / "Local"


def free_memory() -> int:
    """Bytes that this process and its children can still take."""
    status = _MemoryStatus(length=ctypes.sizeof(_MemoryStatus))
    if not ctypes.WinDLL("kernel32", use_last_error=True).GlobalMemoryStatusEx(ctypes.byref(status)):
        raise ctypes.WinError(ctypes.get_last_error())
    return int(status.available_physical)


def bound_memory(process: int, limit: int) -> None:
    """Nothing: here nothing holds a process but the system."""


def open_for_reading(path: Path, *, follow: bool = True) -> int:
    """A descriptor of a file.

    Raises
    ------
    OSError
        It cannot be opened, is a folder, or is a link that is not to be followed.
    """
    if os.path.isdir(path):
        raise IsADirectoryError(0, "Is a directory", str(path))
    if not follow and os.path.islink(path):
        raise OSError(0, "it is a link", str(path))
    return os.open(path, os.O_RDONLY | os.O_BINARY)


@contextmanager
def held(path: Path) -> Iterator[None]:
    """Hold a file or a folder, whatever it is renamed to, as long as this process lives; see :func:`claimed`.

    Raises
    ------
    FileNotFoundError
        It is not there, or was claimed in this instant.
    """
    try:
        handle = _open(path, _WRITE_DATA, _SHARE_READ | _SHARE_WRITE | _SHARE_DELETE)
    except PermissionError as error:
        if error.winerror == _SHARING_VIOLATION or not os.path.lexists(path):
            raise FileNotFoundError(path) from error
        raise
    try:
        yield
    finally:
        _winapi.CloseHandle(handle)


@contextmanager
def claimed(path: Path) -> Iterator[None]:
    """Hold a file or a folder that nobody else holds.

    Raises
    ------
    OSError
        Somebody does, or it is a link.
    """
    if os.path.islink(path):
        raise OSError(0, "it is a link", str(path))
    handle = _open(path, _WRITE_DATA, _SHARE_READ | _SHARE_DELETE)
    try:
        yield
    finally:
        _winapi.CloseHandle(handle)


def _open(path: Path, access: int, share: int) -> int:
    flags = _FOLDERS_TOO | _LINKS_THEMSELVES
    return _winapi.CreateFile(
        str(path), access, share, _winapi.NULL, _winapi.OPEN_EXISTING, flags, _winapi.NULL
    )


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Wait until no other process is inside this block for the folder, and keep others out.

    By a file in it, which the system removes with whoever made it: a folder that is open so could not be looked into.
    """
    path = str(folder / ".shapeviz-alone")
    while True:
        try:
            handle = _winapi.CreateFile(
                path,
                _WRITE_DATA | _DELETE,
                0,
                _winapi.NULL,
                _CREATE_IF_MISSING,
                _DELETE_ON_CLOSE,
                _winapi.NULL,
            )
            break
        except PermissionError as error:
            if error.winerror != _SHARING_VIOLATION and not (
                error.winerror == _DELETE_PENDING and os.path.lexists(path)
            ):
                raise
        time.sleep(_BETWEEN_TRIES)
    try:
        yield
    finally:
        _winapi.CloseHandle(handle)


def exchange(one: Path, other: Path) -> bool:
    """Exchange two folders in one step: no, this system cannot."""
    return False


def is_link(entry: os.DirEntry[str]) -> bool:
    """Whether an entry of a folder may lead out of it: a link, or a junction, which is none by its name."""
    try:
        os.readlink(entry.path)
    except OSError:
        return False
    return True


def is_mount_point(path: Path) -> bool:
    """Whether a path is a drive, or something is mounted there."""
    return os.path.ismount(path)


def start_process(command: Sequence[str], handed: PipeEnd, **options: Any) -> subprocess.Popen[bytes]:
    """Start a process that inherits one end of a pipe, which :class:`PipeEnd` makes of its last argument, a number.

    Raises
    ------
    OSError
        It cannot be started.
    """
    handle = handed.fileno()
    os.set_handle_inheritable(handle, True)
    return subprocess.Popen(
        [*command, str(handle)],
        startupinfo=subprocess.STARTUPINFO(lpAttributeList={"handle_list": [handle]}),
        # in a group of its own, which Ctrl-C does not reach: its parent alone decides what that means
        creationflags=subprocess.CREATE_NEW_PROCESS_GROUP,
        **options,
    )


def start_listening() -> None:
    """Nothing: no signal waited."""


def end_with_parent() -> None:
    """End this process as soon as its standard input closes, for then its parent has ended.

    By a thread, which waits while native code holds the interpreter.
    """
    threading.Thread(target=lambda: (os.read(0, 1), os._exit(1)), daemon=True).start()


def fate(code: int) -> str:
    """How a process ended, by its exit code."""
    return f"exit code {code:#x}" if code > 255 else f"exit code {code}"
