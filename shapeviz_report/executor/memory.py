"""How much memory a worker process may take."""

from __future__ import annotations

from shapeviz_report.system import free_memory

SHARE = 0.8
"""Of the memory that is free, what all workers together may take."""

LEAST = 2**30
"""Bytes that a worker may take at least: without a mesh it takes a third of it."""


def memory_share(processes: int) -> int:
    """Bytes that each of some worker processes may take, by what is free on this machine now."""
    return max(LEAST, int(SHARE * free_memory() / processes))
