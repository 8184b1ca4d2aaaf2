"""How much memory a worker process may take.

The bound is the kernel's, on private writable memory (``RLIMIT_DATA``): it holds within native code, at once, and
for memory that is asked for and not yet touched, while address space that libraries merely reserve is free. Where
there is no such bound, as on macOS, nothing holds a worker but the system.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from pathlib import Path

SHARE = 0.8
"""Of the memory that is free, what all workers together may take."""

LEAST = 2**30
"""Bytes that a worker may take at least: without a mesh it takes a third of it."""


def memory_share(processes: int) -> int:
    """Bytes that each of some worker processes may take, by what is free on this machine now."""
    return max(LEAST, int(SHARE * free_memory() / processes))


def free_memory(root: Path = Path("/")) -> int:
    """Bytes that this process and its children can still take: free on the machine, and in every control group.

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


def bound(process: int, limit: int) -> None:
    """Let a process take so many bytes of memory and no more."""
    if sys.platform == "linux":
        import resource

        # A process that has ended needs no bound.
        with suppress(ProcessLookupError):
            _, hard = resource.prlimit(process, resource.RLIMIT_DATA)
            soft = limit if hard == resource.RLIM_INFINITY else min(limit, hard)
            resource.prlimit(process, resource.RLIMIT_DATA, (soft, hard))


def _read(file: Path) -> str:
    try:
        return file.read_text()
    except OSError:
        return ""
