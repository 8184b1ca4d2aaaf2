"""How the command ends when it is asked to: by Ctrl-C, by a terminal that closes, or by a termination signal."""

from __future__ import annotations

import atexit
import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

ASKING: tuple[signal.Signals, ...] = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK") if hasattr(signal, name)
)
"""The signals that ask a program to end: the third on POSIX, the fourth on Windows."""

STOPPED = "Stopped. What was computed is kept: the same command continues from here."


class _Asked(BaseException):
    """Of exceptions that a signal raised, and not what it interrupted."""


class _Interrupted(_Asked, KeyboardInterrupt):
    pass


class _Terminated(_Asked, SystemExit):
    pass


def is_asked(error: BaseException) -> bool:
    """Whether an exception came because the program is to end, and not from the code that it left."""
    return isinstance(error, _Asked) or (
        isinstance(error, KeyboardInterrupt) and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    )


def end_at_once(number: int, frame: FrameType | None = None) -> None:
    """End now: there is nothing to put away yet, or somebody has asked a second time.

    Workers end with this process, and what it was writing is cleared by the next build.
    """
    try:
        # past Python's buffers, for this may come in the middle of another message
        os.write(2, f"\n{STOPPED}\n".encode())
    finally:
        os._exit(128 + number)


def end_in_order(number: int, frame: FrameType | None = None) -> None:
    """End by an exception, so that what is under way is put away; asked again, at once."""
    listen(end_at_once)
    if number == signal.SIGINT:
        raise _Interrupted
    raise _Terminated(128 + number)


def listen(handler: Callable[[int, FrameType | None], None] | signal.Handlers) -> None:
    """Have these signals handled so, but for those that are switched off, as by ``nohup``."""
    for number in ASKING:
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, handler)


@contextmanager
def listening() -> Iterator[None]:
    """Inside, a program ends at once when it is asked to, unless :func:`listen` says otherwise; afterwards as before.

    At the very end, where Python forgets how signals are handled, they are ignored: its exit code is settled.
    """
    before = {number: signal.getsignal(number) for number in ASKING}
    atexit.register(listen, signal.SIG_IGN)
    listen(end_at_once)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
