"""What a worker does once for all its tasks, and no task's time limit counts."""

from __future__ import annotations

from collections.abc import Callable

Tell = Callable[[bool], object]

_tell: Tell | None = None


def tell_pauses(tell: Tell) -> None:
    """Have a function told of every pause: True when it begins, False when it ends."""
    global _tell
    _tell = tell


def pause(begins: bool) -> None:
    """A pause begins or ends; in a process that is no worker, nothing happens."""
    if _tell is not None:
        _tell(begins)
