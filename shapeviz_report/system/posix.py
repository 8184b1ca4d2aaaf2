"""Linux, macOS and their like."""

from __future__ import annotations

import sys

assert sys.platform != "win32"

import ctypes
import fcntl
import os
import re
import resource
import select
import signal
import subprocess
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection as PipeEnd
from pathlib import Path
from typing import Any

from shapeviz_report.ending import ASKING

LACKING_MEMORY = (-signal.SIGABRT, -signal.SIGKILL, -signal.SIGSEGV)
"""Exit codes of processes that got no memory: C++ aborts, C uses what it did not get, and the system kills."""

_AT_FDCWD = -100
_RENAME_EXCHANGE = 2


def core_count() -> int:
    """How many cores this process may use."""
    if sys.platform == "linux":
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def cache_folder() -> Path:
    """Where programs of this user keep what they can make again."""
    if base := os.environ.get("XDG_CACHE_HOME"):
        return Path(base)
    return Path.home() / ("Library/Caches" if sys.platform == "darwin" else ".cache")


def free_memory(root: Path = Path("/")) -> int:
    """Bytes that this process and its children can still take: free on the machine, and in every control group. Of a
    machine that does not tell, all that it has.

    Parameters
    ----------
    root : Path
        Where ``proc`` and ``sys`` are.
    """
    found = []
    for line in _read(root / "proc/meminfo").splitlines():
        if line.startswith("MemAvailable:"):
            found.append(int(line.split()[1]) * 1024)
    for line in _read(root / "proc/self/cgroup").splitlines():
        _, controllers, place = line.split(":", 2)
        if controllers == "":
            base, most, used = root / "sys/fs/cgroup", "memory.max", "memory.current"
        elif "memory" in controllers.split(","):
            base = root / "sys/fs/cgroup/memory"
            most, used = "memory.limit_in_bytes", "memory.usage_in_bytes"
        else:
            continue
        # In a container the group's own folder is the base, whatever the path says.
        group = base / place.lstrip("/")
        for folder in (group, *(parent for parent in group.parents if parent.is_relative_to(base))):
            limit, taken = _read(folder / most).strip(), _read(folder / used).strip()
            if limit.isdigit() and taken.isdigit():
                found.append(max(0, int(limit) - int(taken)))
    return min(found, default=os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))


def _read(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def bound_memory(process: int, limit: int) -> None:
    """Let a process take so many bytes of private writable memory and no more (``RLIMIT_DATA``).

    That holds within native code, at once, and for memory that is asked for and not yet touched, while address space
    that libraries merely reserve is free. macOS has no such bound.
    """
    if sys.platform == "linux":
        # A process that has ended needs no bound.
        with suppress(ProcessLookupError):
            _, hard = resource.prlimit(process, resource.RLIMIT_DATA)
            soft = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
            resource.prlimit(process, resource.RLIMIT_DATA, (soft, hard))


def open_for_reading(path: Path, *, follow: bool = True) -> int:
    """A descriptor of a file, which is not waited for: a pipe would be, until somebody writes into it.

    Raises
    ------
    OSError
        It cannot be opened, or is a link that is not to be followed.
    """
    return os.open(path, os.O_RDONLY | os.O_NONBLOCK | (0 if follow else os.O_NOFOLLOW))


@contextmanager
def held(path: Path) -> Iterator[None]:
    """Hold a file or a folder, whatever it is renamed to, as long as this process lives; see :func:`claimed`.

    Raises
    ------
    FileNotFoundError
        It is not there, or was claimed in this instant.
    """
    descriptor = os.open(path, os.O_RDONLY)
    try:
        with suppress(OSError):  # a file system without locks has no leftovers either
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        if not os.path.lexists(path):
            raise FileNotFoundError(path)
        yield
    finally:
        os.close(descriptor)


@contextmanager
def claimed(path: Path) -> Iterator[None]:
    """Hold a file or a folder that nobody else holds.

    Raises
    ------
    OSError
        Somebody does, or it is a link.
    """
    descriptor = open_for_reading(path, follow=False)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    finally:
        os.close(descriptor)


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Wait until no other process is inside this block for the folder, and keep others out."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # not every file system has locks
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def exchange(one: Path, other: Path) -> bool:
    """Exchange two folders in one step; False where the system or the file system cannot."""
    renameat2 = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)
    if renameat2 is None:
        return False
    return renameat2(_AT_FDCWD, os.fsencode(one), _AT_FDCWD, os.fsencode(other), _RENAME_EXCHANGE) == 0


def is_link(entry: os.DirEntry[str]) -> bool:
    """Whether an entry of a folder may lead out of it."""
    return entry.is_symlink()


def is_mount_point(path: Path) -> bool:
    """Whether something is mounted at a path, a part of the same file system (a bind mount) too where Linux tells."""
    try:
        lines = Path("/proc/self/mountinfo").read_bytes().splitlines()
    except OSError:
        return os.path.ismount(path)
    # blanks and backslashes stand as octal numbers
    points = (re.sub(rb"\\(\d{3})", lambda m: bytes([int(m[1], 8)]), line.split()[4]) for line in lines)
    return os.fsencode(os.path.abspath(path)) in points


def start_process(command: Sequence[str], handed: PipeEnd, **options: Any) -> subprocess.Popen[bytes]:
    """Start a process that inherits one end of a pipe, which :class:`PipeEnd` makes of its last argument, a number.

    Signals that come meanwhile wait until it calls :func:`start_listening`.

    Raises
    ------
    OSError
        It cannot be started.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ASKING)
    try:
        return subprocess.Popen([*command, str(handed.fileno())], pass_fds=[handed.fileno()], **options)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def start_listening() -> None:
    """Have the signals come that waited since :func:`start_process`."""
    signal.pthread_sigmask(signal.SIG_UNBLOCK, ASKING)


def end_with_parent() -> None:
    """End this process as soon as its standard input closes, for then its parent has ended.

    On Linux the kernel does it, by a signal that ends a process also in the middle of native code; elsewhere a
    thread, which waits while native code holds the interpreter.
    """
    if sys.platform == "linux":
        signal.signal(signal.SIGIO, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGIO])
        fcntl.fcntl(0, fcntl.F_SETOWN, os.getpid())
        fcntl.fcntl(0, fcntl.F_SETFL, fcntl.fcntl(0, fcntl.F_GETFL) | os.O_ASYNC)
        # It may have closed before.
        if select.select([0], [], [], 0)[0]:
            os._exit(1)
    else:
        threading.Thread(target=lambda: (os.read(0, 1), os._exit(1)), daemon=True).start()


def fate(code: int) -> str:
    """How a process ended, by its exit code."""
    return f"signal {-code}" if code < 0 else f"exit code {code}"
