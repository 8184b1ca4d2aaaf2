"""What the command says: lines on standard output and standard error, log records, and how far it is."""

from __future__ import annotations

import io
import logging
import re
import sys
import time
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Any, TextIO

from tqdm import tqdm

from shapeviz_report.building.progress import TimeLeft, in_words

LINES_EVERY = 30.0
"""Seconds between two lines of progress where there is no terminal."""

_LINE_BREAK = re.compile(r"[\n-\r\x1c-\x1e\x85\u2028\u2029]")
"""What ends a line, for one program or another."""


class OutputError(Exception):
    """Standard output takes no more, and why."""


def say(*lines: str, file: TextIO | None = None) -> None:
    """Print each text as one line: all that people are told goes this way, for it may hold names of strangers."""
    _print(map(one_line, lines), file or sys.stdout)


def _print(lines: Iterable[str], file: TextIO) -> None:
    encoding = file.encoding or "utf-8"
    try:
        for line in lines:
            print(line.encode(encoding, "replace").decode(encoding), file=file)
        file.flush()
    except OSError as error:
        raise OutputError(error.strerror) from error


def complain(*lines: str) -> None:
    """Say something on standard error, if it takes it."""
    with suppress(OutputError):
        say(*lines, file=sys.stderr)


def one_line(text: str) -> str:
    """Text of a database as the terminal may show it: no line breaks, no control characters, none that turn the
    direction of writing, and no bytes that are no text. Spaces of other kinds, as our own texts have, are spaces.
    """
    return "".join(c if c.isprintable() else " " if unicodedata.category(c) == "Zs" else "?" for c in text)


def hand_over(texts: Sequence[str]) -> None:
    """Print names of strangers for other programs: each as it is, in UTF-8, on a line of its own, for which a line
    break in it becomes ``?``. A terminal gets them as :func:`say` has them. How many are not as they are is told.
    """
    if sys.stdout.isatty():
        shown = [one_line(text) for text in texts]
    else:
        shown = ["?".join(_LINE_BREAK.split(text)) for text in texts]
        if isinstance(sys.stdout, io.TextIOWrapper):
            sys.stdout.reconfigure(encoding="utf-8")
    _print(shown, sys.stdout)
    if changed := sum(text != own for text, own in zip(shown, texts)):
        complain(
            f"{changed:,} of {len(texts):,} are not printed as they are: ? or a space stands for letters that a line "
            "here cannot hold. --json has them all."
        )


class LogFormatter(logging.Formatter):
    """Log records as :func:`say` prints: the message as one line, a traceback line by line."""

    def formatMessage(self, record: logging.LogRecord) -> str:
        return one_line(super().formatMessage(record))

    def formatException(self, ei: Any) -> str:
        return "\n".join(map(one_line, super().formatException(ei).splitlines()))


class Patient:
    """A stream for what may get lost: that its disk is full, or its reader gone, stops nobody's work."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> None:
        with suppress(OSError):
            self._stream.write(text)

    def flush(self) -> None:
        with suppress(OSError):
            self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


class TerminalProgress:
    """A bar with the time left on a terminal; on anything else a line every half a minute.

    Parameters
    ----------
    verbose : bool
        Whether it is told how long every stage took.
    """

    def __init__(self, *, verbose: bool = False) -> None:
        self._verbose = verbose

    @contextmanager
    def stage(self, doing: str, total: int) -> Iterator[Callable[[], None]]:
        """See :class:`shapeviz_report.building.progress.Progress`."""
        begun = time.monotonic()
        with self._told(doing, total) as advance:
            yield advance
        if self._verbose:
            complain(f"{doing}: {time.monotonic() - begun:.1f} s")

    @contextmanager
    def _told(self, doing: str, total: int) -> Iterator[Callable[[], None]]:
        if total == 0:
            complain(doing)
            yield lambda: None
            return
        left = TimeLeft(total)
        with (
            self._bar(doing, total, left) if sys.stderr.isatty() else self._lines(doing, total, left) as tell
        ):

            def advance() -> None:
                left.step(time.monotonic())
                tell()

            yield advance

    @contextmanager
    def _bar(self, doing: str, total: int, left: TimeLeft) -> Iterator[Callable[[], None]]:
        with tqdm(
            total=total,
            desc=f"{doing:<22}",
            bar_format="{desc} {bar:24} {n_fmt:>6} of {total_fmt}  {elapsed} gone{postfix}",
            mininterval=0.2,
            file=Patient(sys.stderr),
            dynamic_ncols=True,
        ) as bar:

            def tell() -> None:
                seconds = left.estimate(time.monotonic())
                bar.set_postfix_str("" if not seconds else f"about {in_words(seconds)} left", refresh=False)
                bar.update()

            yield tell

    @contextmanager
    def _lines(self, doing: str, total: int, left: TimeLeft) -> Iterator[Callable[[], None]]:
        begun = told = time.monotonic()
        done = 0
        complain(f"{doing}: {total:,}")

        def tell() -> None:
            nonlocal told, done
            done += 1
            now = time.monotonic()
            if now - told < LINES_EVERY or done == total:
                return
            told, seconds = now, left.estimate(now)
            rest = "" if not seconds else f", about {in_words(seconds)} left"
            complain(f"{doing}: {done:,} of {total:,}, {in_words(now - begun)} gone{rest}")

        yield tell
